// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gen/xml/xml_document.h"

namespace dyngen {

/// Changes of a text, all in bytes of the text as it was. What no change names stays as it is.
class TextPatches {
 public:
  /// @param range  does not overlap that of another change
  void replace(ByteRange range, std::string text);
  /// Insertions at one place stand in the order in which they were made.
  void insert(std::size_t at, std::string text) { replace({at, at}, std::move(text)); }

  /// The text with the changes.
  /// @throws InternalError  if changes overlap or lie outside
  [[nodiscard]] std::string applied(std::string_view text) const;

 private:
  struct Patch {
    ByteRange range;
    std::string text;
  };
  std::vector<Patch> patches_;
};

/// Gives an element an attribute, or another value of it. @param value  without quotes and '&<'
void set_attribute(TextPatches& patches, const XmlElement& element, std::string_view name,
                   std::string_view value);

/// Puts an element in front of an element's content, one step of indentation (two blanks) further
/// in.
void insert_child(TextPatches& patches, const XmlDocument& document, const XmlElement& element,
                  const std::string& child);

/// The element that begins there, or null.
const XmlElement* element_at(const XmlElement& root, SourcePosition position);

/// Lines as a comment behind the start tag of the root; "--", which no comment may hold, is taken
/// apart.
void insert_comment(TextPatches& patches, const XmlDocument& document,
                    const std::vector<std::string>& lines);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/diagnostic/line_table.h"

namespace dyngen {

/// Bytes [begin, end) of a text.
struct ByteRange {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  bool operator==(const ByteRange&) const = default;
};

/// An attribute as the parser understands it, and where it stands in the text.
struct XmlAttribute {
  std::string name;
  std::string value;        ///< entities replaced, blanks as XML makes them
  ByteRange name_bytes;     ///< of the name
  ByteRange value_bytes;    ///< between the quotes, as written
  SourcePosition position;  ///< of the value's first character
  int length = 1;           ///< characters of the value as written, >= 1
};

/// An element with its attributes in the order of the text.
struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::string text;           ///< character data directly in it, all pieces joined
  ByteRange start_tag;        ///< from '<' to behind '>'
  ByteRange content;          ///< between the start tag and the end tag; empty for <a/>
  ByteRange whole;            ///< from '<' of the start tag to behind '>' of the end tag
  bool self_closing = false;  ///< <a/>: there is no end tag
  SourcePosition position;    ///< of the start tag
  int length = 1;             ///< characters of "<name", for messages

  /// Null if there is no such attribute.
  [[nodiscard]] const XmlAttribute* attribute(std::string_view wanted) const;
  /// The first child of that name, or null.
  [[nodiscard]] const XmlElement* child(std::string_view wanted) const;
};

/// A text that is well-formed XML, with its one root element.
struct XmlDocument {
  std::string file_name;
  std::string text;  ///< to which all ranges refer
  XmlElement root;
  LineTable lines;

  [[nodiscard]] SourcePosition position_of(std::size_t byte) const {
    return lines.position_of(text, byte);
  }
};

/// How deep elements may stand in each other.
inline constexpr int kMaxXmlDepth = 200;

/// Whether this program can read XML: it was built with expat (Debian's libexpat1-dev).
bool has_xml_reader();

/// Reads XML: well-formed, UTF-8 or another encoding in which ASCII characters are bytes.
///
/// @throws ModelError  positioned, where the text is not well-formed, has a document type with
///         declarations of its own, or elements in each other deeper than kMaxXmlDepth; naming the
///         package if this program was built without expat
XmlDocument parse_xml(std::string text, std::string file_name);

}  // namespace dyngen

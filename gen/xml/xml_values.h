// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gen/xml/xml_document.h"

namespace dyngen {

/// Reads values of a document's attributes, and reports what is wrong with them.
class XmlValues {
 public:
  /// @param document, diagnostics  outlive this object
  XmlValues(const XmlDocument& document, Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics) {}

  void error(const XmlElement& element, const std::string& message, const std::string& hint = {});
  void error(const XmlAttribute& attribute, const std::string& message,
             const std::string& hint = {});
  void warning(const XmlElement& element, const std::string& message, const std::string& hint = {});
  void warning(const XmlAttribute& attribute, const std::string& message,
               const std::string& hint = {});

  /// Null, and reported, if there is none. @param what  whose it is, for the message
  const XmlAttribute* required(const XmlElement& element, std::string_view name,
                               const std::string& what);

  /// Numbers between blanks. None, and reported, if one is none or there are others than `least`
  /// to `most` of them.
  std::optional<std::vector<long double>> numbers(const XmlAttribute& attribute, std::size_t least,
                                                  std::size_t most);
  std::optional<std::vector<long double>> numbers(const XmlAttribute& attribute,
                                                  std::size_t count) {
    return numbers(attribute, count, count);
  }
  std::optional<long double> number(const XmlAttribute& attribute);
  /// The number of an attribute that may be missing.
  std::optional<long double> number(const XmlElement& element, std::string_view name);

  [[nodiscard]] const XmlDocument& document() const { return document_; }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }

 private:
  const XmlDocument& document_;
  Diagnostics& diagnostics_;
};

}  // namespace dyngen

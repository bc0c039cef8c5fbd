// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/xml/xml_values.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "gen/xml/decimal_number.h"

namespace dyngen {

void XmlValues::error(const XmlElement& element, const std::string& message,
                      const std::string& hint) {
  diagnostics_.error(element.position, element.length, message, hint);
}
void XmlValues::error(const XmlAttribute& attribute, const std::string& message,
                      const std::string& hint) {
  diagnostics_.error(attribute.position, attribute.length, message, hint);
}
void XmlValues::warning(const XmlElement& element, const std::string& message,
                        const std::string& hint) {
  diagnostics_.warning(element.position, element.length, message, hint);
}
void XmlValues::warning(const XmlAttribute& attribute, const std::string& message,
                        const std::string& hint) {
  diagnostics_.warning(attribute.position, attribute.length, message, hint);
}

const XmlAttribute* XmlValues::required(const XmlElement& element, std::string_view name,
                                        const std::string& what) {
  const XmlAttribute* found = element.attribute(name);
  if (found == nullptr) {
    error(element, fmt::format("{} has no attribute '{}'", what, name),
          fmt::format("expected <{} {}=\"...\">", printable(element.name), name));
  }
  return found;
}

std::optional<std::vector<long double>> XmlValues::numbers(const XmlAttribute& attribute,
                                                           std::size_t least, std::size_t most) {
  constexpr std::string_view kBlanksInValue = " \t\r\n";
  const std::string_view text = attribute.value;
  std::vector<long double> values;
  std::size_t at = text.find_first_not_of(kBlanksInValue);
  while (at != text.npos) {
    const std::size_t end = text.find_first_of(kBlanksInValue, at);
    const std::string_view word = text.substr(at, end == text.npos ? end : end - at);
    const std::optional<long double> value = read_decimal(word);
    if (!value) {
      const bool is_template = word.find("${") != word.npos || word.find("$(") != word.npos;
      error(attribute,
            fmt::format("'{}' in '{}' is not a number", printable(word), printable(attribute.name)),
            is_template
                ? "this is a xacro file: expand it first, xacro robot.urdf.xacro > robot.urdf"
            : word.find(',') != word.npos ? "a decimal point is '.'; blanks separate numbers"
                                          : "expected a decimal number");
      return std::nullopt;
    }
    constexpr long double kLargest = 1e30L, kSmallest = 1e-300L;  // of what a robot has
    if (std::fabs(*value) > kLargest) {
      error(attribute,
            fmt::format("'{}' in '{}' is larger than anything of a robot", printable(word),
                        printable(attribute.name)),
            "expected SI units");
      return std::nullopt;
    }
    values.push_back(std::fabs(*value) < kSmallest ? 0 : *value);
    at = end == text.npos ? end : text.find_first_not_of(kBlanksInValue, end);
  }
  if (values.size() < least || values.size() > most) {
    error(attribute,
          fmt::format("'{}' has {} number{}", printable(attribute.name), values.size(),
                      values.size() == 1 ? "" : "s"),
          least == most ? fmt::format("expected {}", least)
                        : fmt::format("expected {} to {}", least, most));
    return std::nullopt;
  }
  return values;
}

std::optional<long double> XmlValues::number(const XmlAttribute& attribute) {
  const std::optional<std::vector<long double>> values = numbers(attribute, 1);
  if (!values) return std::nullopt;
  return values->front();
}

std::optional<long double> XmlValues::number(const XmlElement& element, std::string_view name) {
  const XmlAttribute* attribute = element.attribute(name);
  if (attribute == nullptr) return std::nullopt;
  return number(*attribute);
}

}  // namespace dyngen

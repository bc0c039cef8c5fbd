// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "gen/xml/xml_values.h"

namespace dyngen {

/// The attributes of an element together with those that its default class gives it. The
/// attributes are the document's, so that messages have their places.
class MjcfAttributes {
 public:
  /// Null if neither the element nor its class has it.
  [[nodiscard]] const XmlAttribute* find(std::string_view name) const {
    const auto found = attributes_.find(name);
    return found == attributes_.end() ? nullptr : found->second;
  }
  /// Later attributes win.
  void take(const XmlElement& element) {
    for (const XmlAttribute& own : element.attributes) attributes_[own.name] = &own;
  }

 private:
  std::map<std::string, const XmlAttribute*, std::less<>> attributes_;
};

/// MJCF's default classes: attributes by class and kind of element; a nested class begins with
/// those of the class around it.
class MjcfDefaults {
 public:
  /// Reads <default> elements; a class that stands twice or has no name is reported.
  /// @param root  <mujoco>, which outlives this object
  MjcfDefaults(const XmlElement& root, XmlValues& values);

  [[nodiscard]] bool has(std::string_view name) const { return classes_.contains(name); }

  /// @param kind   the element's name: "joint", "geom"
  /// @param given  the class of the bodies around it; the element's own attribute `class` wins;
  ///               empty: the main class
  [[nodiscard]] MjcfAttributes of(const XmlElement& element, std::string_view kind,
                                  const std::string& given, XmlValues& values) const;

 private:
  using Class = std::map<std::string, MjcfAttributes, std::less<>>;  // by kind of element

  void read(const XmlElement& element, const std::string& name, const Class& around,
            XmlValues& values);

  std::map<std::string, Class, std::less<>> classes_;
  std::string main_ = "main";
};

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "gen/bodies/body_tree.h"
#include "gen/bodies/geometry.h"
#include "gen/xml/xml_values.h"

namespace dyngen {

inline TextPlace place_in_urdf(const XmlElement& element) {
  return {element.position, element.length};
}

template <std::size_t N>
bool stands_among(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Elements that links and joints of a URDF share: poses and vectors, each with its messages. All
/// that it is given outlives it.
class UrdfElements {
 public:
  UrdfElements(const ReadingOptions& options, XmlValues& values)
      : options_(options), values_(values) {}

  [[nodiscard]] XmlValues& values() { return values_; }

  void warn_of_unknown(const XmlElement& element, const std::string& where);

  RealVector vector(const XmlElement& element, std::string_view name, const RealVector& absent);

  /// The pose that the child <origin> gives. @param whose  for messages
  RigidPose origin(const XmlElement& element, const std::string& whose);

  /// A child that may stand once.
  const XmlElement* only_child(const XmlElement& element, std::string_view name);

 private:
  RealVector angles(const XmlElement& element, const std::string& whose);

  const ReadingOptions& options_;
  XmlValues& values_;
};

}  // namespace dyngen

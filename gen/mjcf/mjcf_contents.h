// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/bodies/body_tree.h"
#include "gen/bodies/geometry.h"
#include "gen/xml/xml_document.h"

namespace dyngen {

/// An element of a body, which stands in it or in frames in it.
struct MjcfItem {
  const XmlElement* element = nullptr;
  RigidPose around{};       ///< of the frames around it in the body
  std::string given_class;  ///< default class that they give it
};

/// What of a body stands in it or in frames in it.
struct MjcfContents {
  std::vector<MjcfItem> joints, geoms;
  const XmlElement* inertial = nullptr;
};

inline TextPlace place_in_mjcf(const XmlElement& element) {
  return {element.position, element.length};
}

}  // namespace dyngen

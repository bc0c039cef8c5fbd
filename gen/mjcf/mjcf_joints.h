// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "gen/mjcf/mjcf_contents.h"
#include "gen/mjcf/mjcf_defaults.h"
#include "gen/mjcf/mjcf_settings.h"

namespace dyngen {

/// A joint of a body, without what it connects.
struct MjcfJoint {
  TreeJoint joint;
  Real reference = 0;  ///< the position at which the body stands as it is described, rad or m
};

/// Reads the joints of a model; remembers their names. All that it is given outlives it.
class MjcfJoints {
 public:
  MjcfJoints(const MjcfSettings& settings, const MjcfDefaults& defaults, XmlValues& values)
      : settings_(settings), defaults_(defaults), values_(values) {}

  /// @param body  its name: begins the name of a joint that has none
  MjcfJoint read(const MjcfItem& item, const std::string& body);

 private:
  void read_type(const MjcfAttributes& own, const XmlElement& element, TreeJoint& joint);
  void read_axis(const MjcfAttributes& own, const XmlElement& element, const RigidPose& around,
                 TreeJoint& joint);
  /// An angle, or of a slide a length. 0 if it is missing.
  Real coordinate(const MjcfAttributes& own, std::string_view name, const TreeJoint& joint);
  void read_range(const MjcfAttributes& own, TreeJoint& joint);
  void read_dynamics(const MjcfAttributes& own, TreeJoint& joint);
  std::optional<Real> magnitude(const MjcfAttributes& own, std::string_view name, TreeJoint& joint);

  const MjcfSettings& settings_;
  const MjcfDefaults& defaults_;
  XmlValues& values_;
  std::map<std::string, int> names_;                        // lines
  std::map<std::string, std::size_t> joints_without_name_;  // of each body
};

}  // namespace dyngen

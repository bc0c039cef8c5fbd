// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"
#include "gen/posture/vec3.h"

namespace dyngen {

/// A frame as the base sees it.
struct Frame {
  Vec3 origin;  ///< m
  Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
};

/// A joint and its link where they stand, in modified frames: the joint turns about or slides along
/// z of its frame.
struct PosedLink {
  JointType type = JointType::kRevolute;
  int parent = 0;  ///< 1-based, 0 is the base
  std::string name;
  double q = 0;  ///< rad, or m if prismatic; 0 if fixed
  Vec3 foot;     ///< where x of the parent's frame meets this axis
  Frame frame;
  Frame tip;  ///< the file's own frame of the link: `frame`, unless the file is in standard frames
};

/// A number that stands for a length that is known at run time only.
struct StandIn {
  std::string name;  ///< "d3"
  double value = 0;  ///< m
};

/// An arm in numbers, at one configuration.
struct Posture {
  std::vector<PosedLink> links;  ///< links[j - 1] is link j
  std::vector<StandIn> stand_ins;
  std::optional<Vec3> weight;  ///< where weight pulls, m/s^2, in frame 0; none: a run-time one

  [[nodiscard]] const PosedLink& link(int j) const {
    return links[static_cast<std::size_t>(j - 1)];
  }
  [[nodiscard]] Frame frame(int j) const { return j == 0 ? Frame{} : link(j).frame; }
};

/// The arm where a person sees it best: q = 0, but
/// - a joint whose limits leave 0 out stands at a quarter turn near their middle, or in the middle;
/// - a prismatic joint that would have no length is drawn out, to the middle of its limits if there
///   are any;
/// - where links would lie on each other the first joint that helps is bent by 90 degrees.
/// The same robot gives the same posture.
Posture make_posture(const RobotModel& model);

/// "all joints at 0", "joint 4 at -90 deg, the others at 0".
std::string configuration_text(const Posture& posture);
/// "d3 = 0.3 m in place of a run-time length"; empty if there is none.
std::string stand_in_text(const Posture& posture);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gen/evaluate/robot_numbers.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// How two descriptions of a robot are compared.
struct ComparisonOptions {
  std::size_t samples = 1000;  ///< random states
  std::uint64_t seed = 1;
  /// Two robots are the same if no difference is larger than this share of the largest value.
  double tolerance = 1e-10;
};

/// The range of one joint's random states: what both files allow.
struct StateRange {
  double q_min = 0, q_max = 0;  ///< rad, m
  double dq = 0, ddq = 0;       ///< largest magnitude
};

/// Where a joint's torque differs most.
struct TorqueDifference {
  double difference = 0;  ///< magnitude, N m or N
  double share = 0;       ///< of the joint's largest torque in all states
  double first = 0, second = 0;
  std::vector<double> q, dq, ddq;  ///< the state
};

/// How much one part of the model differs.
struct PartDifference {
  std::string part;       ///< "mass matrix", "gravity"
  double difference = 0;  ///< largest magnitude, in the unit of the part
  double share = 0;       ///< of the largest magnitude of the part
  int joint = 0;          ///< place of the moving joint in whose torque it stands, from 0
  bool same = false;      ///< within the tolerance of the part, or of the largest torque
};

/// How much a joint's axis differs as frame 0 sees it, whatever frames the files use.
struct AxisDifference {
  double angle = 0;     ///< rad, between the directions; pi where a joint turns the other way
  double distance = 0;  ///< m, from the origin of the first's axis to the second's axis line
};

struct Comparison {
  /// Why the two cannot be compared: other joints. Empty if they can; nothing else is set then.
  std::vector<std::string> other_joints;
  std::vector<StateRange> ranges;
  std::vector<std::string> clipped;  ///< joints whose limits do not overlap: the first's are used
  std::vector<TorqueDifference> torques;  ///< of each moving joint
  std::vector<PartDifference> parts;
  double frame_distance = 0;  ///< m, largest of the last links' origins
  double frame_angle = 0;     ///< rad, largest between the last links' frames
  double reach = 0;           ///< m, largest distance of the first's last origin from frame 0
  std::vector<AxisDifference> axes;  ///< the largest of each moving joint
  bool same_torques = false;
  bool same_axes = false;
  bool same_frame = false;  ///< of the last links
};

/// A robot with the file that describes it.
struct ComparedRobot {
  RobotModel model;
  RobotFile file;
  GeneratorOptions options;  ///< its effects
};

/// Compares two robots at random states within the limits of both. A joint without limits turns by
/// +-pi or slides by +-1 m; without vmax it moves at +-2 rad/s (m/s), without amax at +-5 rad/s^2.
/// Moving joints are matched by their order; fixed joints may differ.
/// @throws ModelError  if a number of one of them is unknown
Comparison compare_robots(const ComparedRobot& first, const ComparedRobot& second,
                          const ComparisonOptions& options = {});

/// What was compared and where the two differ, in lines of at most 80 columns.
std::string comparison_text(const ComparedRobot& first, const ComparedRobot& second,
                            const Comparison& comparison, const ComparisonOptions& options = {});

}  // namespace dyngen

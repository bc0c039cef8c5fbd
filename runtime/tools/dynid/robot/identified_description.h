// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "gen/robot_input/robot_source.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// No bodies that can exist have these base parameters. what() is a sentence.
class NoBodiesError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Torque of the identified robot that a description has no field for.
struct LeftOut {
  std::string what;     ///< "rotor inertia of shoulder", "stribeck of joint 3"
  std::string reason;   ///< a phrase
  Eigen::VectorXd rms;  ///< (n) N m or N in the recordings; empty: not known
};

struct IdentifiedDescription {
  std::string text;
  std::string form;  ///< "URDF" or "MJCF"
  std::vector<LeftOut> left_out;
  std::vector<std::string> table;  ///< of left_out, lines; empty: nothing was
  std::vector<std::string> notes;  ///< sentences
};

/// A description with identified numbers, and where it is written.
struct WrittenBack {
  std::string path;         ///< of the output
  std::string description;  ///< path of what it was made of
  IdentifiedDescription result;
};

/// What an identified robot is written back into, and what is known of it.
struct WriteBackTask {
  RobotSource description;            ///< URDF or MJCF
  std::vector<std::string> comment;   ///< lines that the file shall have besides its own
  std::vector<MotionSource> motions;  ///< where torque that is left out is measured; may be empty
  RowOptions rows;
};

/// The description with the numbers of an identified robot: inertials, damping, friction, armature,
/// springs, and gain and lag of drives, where the form has fields for them. Every other byte stays.
///
/// Base parameters become bodies that can exist: those nearest to the description's
/// (realise_bodies()), whose torque is that of the robot to 1e-9 but for what is left out. The text
/// is read back and compared before it is returned.
/// @param identified  the text of a robot file, as dynid writes it
/// @throws ModelError     if the two do not describe the same arm
/// @throws NoBodiesError
IdentifiedDescription identified_description(const std::string& identified,
                                             const std::string& file_name,
                                             const WriteBackTask& task,
                                             const EffectCatalogue& catalogue);

}  // namespace dyngen::runtime

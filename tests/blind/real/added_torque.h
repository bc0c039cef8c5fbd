// SPDX-License-Identifier: MIT
// Torque that is added to a real recording, as if one more thing acted on the robot. Forms are of
// our own where they can be: those of gen/effects would only find themselves.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/blind/real/real_robot.h"
#include "tests/blind/simulation/random.h"

namespace blind {

/// What is known of a recording when something is added to it.
struct Ground {
  const RealMotion& motion;
  Eigen::MatrixXd load;       ///< torque of the fitted links, (N x joints)
  std::size_t recording = 0;  ///< fitted ones from 0, then those held out
};

struct AddedTorque {
  std::string family;  ///< as in findings
  std::string form;
  int joint = 0, other = 0;  ///< from 1; 0: the whole robot, or none
  double typical = 1;
  std::map<std::string, double> numbers;
  /// (N x joints) N m
  std::function<Eigen::MatrixXd(double size, const Ground& ground)> torque;
};

/// What a joint does in the fitted recordings.
struct JointUse {
  double low = 0, high = 0;  ///< rad
  double fast = 0;           ///< rad/s that 90 % of the samples are slower than
  double dry = 0;            ///< N m
  double largest = 0;        ///< N m
};

/// Draws the numbers of one kind of physics on a joint.
/// @param joint     from 0      @param fitted  how many recordings are fitted
/// @param duration  s of a recording
/// @throws std::invalid_argument  if there is no such family
AddedTorque draw_torque(const std::string& family, const RealRobot& robot,
                        const std::vector<JointUse>& uses, Eigen::Index joint, std::size_t fitted,
                        double duration, Random random);

}  // namespace blind

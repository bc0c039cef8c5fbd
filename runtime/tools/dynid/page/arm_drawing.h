// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gen/model/robot_model.h"
#include "runtime/report/document.h"

namespace dyngen::runtime {

/// The arm as its DH table says, in a posture.
/// @param q       (n) rad or m, of the coordinates   @param marked  coordinates, from 0
/// @param model   with numbers for all lengths
ReportArm arm_drawing(const RobotModel& model, const Eigen::VectorXd& q,
                      const std::vector<int>& marked);

}  // namespace dyngen::runtime

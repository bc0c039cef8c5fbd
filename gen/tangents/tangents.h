// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "gen/model/robot_model.h"
#include "gen/program/program.h"

namespace dyngen {

/// A linear combination of standard parameters: places 14 * (link - 1) + kind of the file's
/// parameters, in the order of chi.h.
struct ParameterSum {
  struct Term {
    int place = 0;
    double factor = 1;
  };
  std::vector<Term> terms;
};

/// Something of the rigid model that effects read, of bodies with any parameters: whatever the file
/// says of them, all ten of each link are asked for. Rotors and friction are left out.
struct TangentProgram {
  Program program;                ///< reads q, dq, ddq, chi, gravity (the base's acceleration)
  std::vector<ParameterSum> chi;  ///< what each entry of chi is
};

/// d tau_i / d q_k, dq_k, ddq_k: arrays D_q, D_dq, D_ddq, n x n, row-major.
TangentProgram motion_derivatives(const RobotModel& model);

/// tau: the torque that holds the arm still, which is linear in gravity.
TangentProgram gravity_torque(const RobotModel& model);

/// w: force and moment of the links on each joint (write_joint_wrenches()), 6 x n.
TangentProgram joint_wrenches(const RobotModel& model);

/// Y: torque of a body on a link, linear in its parameters in the file's frame. n x 10,
/// row-major; chi is not read.
struct PayloadProgram {
  Program program;  ///< Y in columns of the link's own frame
  /// Of each of those columns: what it is of the ten parameters in the file's frame.
  std::vector<ParameterSum> columns;
};
/// @param link  from 1
PayloadProgram payload_regressor(const RobotModel& model, int link);

/// J: velocity of the frame of a link, 6 x n, row-major, axes of frame 0.
Program link_jacobian(const RobotModel& model, int link);

/// The constants of a row of the DH table.
enum class DhConstant { kAlpha, kD, kTheta, kR };

/// D: d tau_i / d q_k of the robot with one joint more, which moves as the constant does and stands
/// at zero: (n + 1) x (n + 1), row-major; the last column is the derivative by the constant. Inputs
/// q, dq, ddq have n + 1 elements, the last of them 0.
TangentProgram geometry_derivative(const RobotModel& model, int link, DhConstant constant);

}  // namespace dyngen

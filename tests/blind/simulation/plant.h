// SPDX-License-Identifier: MIT
// A machine that moves: an engine's bodies, motors, dry friction that sticks, and whatever else
// acts. Coordinates are those of the tree's joints, then those of motors that a gear does not tie
// to their link.
#pragma once

#include <functional>
#include <vector>

#include "tests/blind/simulation/engine.h"

namespace blind {

/// What everything that acts may read. (n): coordinates, (j): joints.
struct Moment {
  double t = 0;              ///< s
  Eigen::VectorXd x, v;      ///< (n) rad, rad/s
  Eigen::VectorXd a;         ///< (n) rad/s^2; for what is recorded only, not for what acts
  Eigen::VectorXd z;         ///< states of what remembers
  Eigen::VectorXd command;   ///< (j) torque that the controller asks for, N m
  Eigen::VectorXd acting;    ///< (j) torque of the motor
  Eigen::VectorXd load;      ///< (j) torque through the gear: rigid bodies, gravity
  Eigen::VectorXd dry;       ///< (j) dry friction of each motor, with its sign
  Eigen::VectorXd q_error;   ///< (j) what the controller's encoder adds at t_error, rad
  Eigen::VectorXd dq_error;  ///< (j) rad/s
  Eigen::VectorXd q_error_rate, dq_error_rate;  ///< (j) each per s: what was held would act late
  double t_error = 0;                           ///< s
};

/// Dry friction against one combination of velocities. It sticks.
struct Friction {
  Eigen::VectorXd along;                          ///< (n): torque on the coordinates per N m
  std::function<double(const Moment&)> strength;  ///< N m, not negative; may read load
};

struct State {
  double start = 0;
  std::function<double(const Moment&)> rate;
};

/// Something that happens once.
struct Happening {
  double t = 0;
  std::function<void()> act;
};

struct Plant {
  Engine engine;
  Eigen::Index links = 0;             ///< coordinates of the engine's tree; motors follow
  std::vector<Eigen::Index> drive;    ///< (j) coordinate of the joint's motor and encoder
  std::vector<Eigen::Index> carried;  ///< (j) coordinate of the joint's link
  Eigen::VectorXd armature, viscous;  ///< (n) kg m^2, N m s/rad
  std::vector<Friction> friction;     ///< that of joint j stands at j; more may follow
  std::vector<std::function<void(const Moment&, Eigen::VectorXd& force)>> forces;
  std::vector<State> states;
  std::vector<Happening> happenings;
  std::function<Eigen::VectorXd(const Moment&)> command;   ///< (j); reads t, x, v, z, errors
  std::function<Eigen::VectorXd(const Moment&)> acting;    ///< (j) of the command
  std::function<Eigen::VectorXd(const Moment&)> recorded;  ///< (j) what the drive writes down

  Eigen::Index joints() const { return static_cast<Eigen::Index>(drive.size()); }
  Eigen::Index coordinates() const { return armature.size(); }
};

/// Frees the motor of a joint from its link: armature, friction, and encoder are the motor's from
/// here on, and a force has to tie the two. Returns the motor's coordinate.
Eigen::Index add_motor(Plant& plant, Eigen::Index joint);

/// What is known of a run at its samples, without noise.
struct Log {
  double rate = 0;                 ///< samples a second
  Eigen::MatrixXd q, dq, ddq;      ///< (N x j) of the motors
  Eigen::MatrixXd recorded;        ///< (N x j) N m
  Eigen::MatrixXd sign;            ///< (N x j) dry friction over its strength, -1 to 1
  Eigen::MatrixXd load;            ///< (N x j)
  std::vector<Eigen::MatrixXd> M;  ///< (j x j) armatures included, of the motors' coordinates
};

struct RunOptions {
  double duration = 0;  ///< s
  double lead = 0;      ///< s that are run before the first sample
  double rate = 250;    ///< samples a second
  double step = 1e-3;   ///< s at most
};

/// @param errors  (j) each: position and velocity error of the controller's encoder; asked for once
///                a sample. Empty: none
/// @throws std::runtime_error  where the motion leaves 1e3 rad/s
Log run(Plant& plant, const Eigen::VectorXd& x0, const Eigen::VectorXd& v0,
        const RunOptions& options,
        const std::function<void(const Eigen::VectorXd& q, Moment& moment)>& errors);

}  // namespace blind

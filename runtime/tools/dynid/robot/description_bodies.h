// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gen/robot_input/robot_input.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// A description (URDF, MJCF) as estimation sees it, with everything open.
struct DescriptionModel {
  DescribedBodies bodies;
  DescribedRobot robot;  ///< of the robot file that was made of them
};

/// @throws ModelError
DescriptionModel description_model(const RobotSource& source);

/// How base parameters of the description are made of the ten parameters of its bodies.
struct BodyGrouping {
  std::vector<int> bodies;  ///< places in BodyTree::bodies of those that move, ascending
  Eigen::MatrixXd K;        ///< (nb x 10 bodies) of the description's base parameters
  Eigen::VectorXd prior;    ///< (10 bodies) as the description has them; NaN for those without
                            ///< an inertial
};

/// @param with_massless  also bodies that have no inertial
BodyGrouping body_grouping(const DescriptionModel& description, bool with_massless);

/// A robot's torque in the base parameters of a description: beta_u with Y_u beta_u = Y beta on all
/// motions, the model's effects left aside.
/// @param standard  (14 links) of `robot`
/// @throws ModelError  naming the joint that differs most, if they are not the same arm
Eigen::VectorXd in_base_parameters_of(const DescriptionModel& description,
                                      const DescribedRobot& robot,
                                      const StandardParameters& standard);

/// Largest difference between two torques of random motions, of the largest torque of both.
double torque_difference(const LinearModel& model, const Eigen::VectorXd& one,
                         const Eigen::VectorXd& other);

/// Numbers of a robot file, 0 where it says nothing. @return (14 links)
StandardParameters numbers_of(const RobotModel& model);

}  // namespace dyngen::runtime

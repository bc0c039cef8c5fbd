// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/control/control_model.h"
#include "runtime/simulation/plant_model.h"
#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// The judge's dynamics as the doors of simulation and control; every joint must move.
runtime::PlantModel numeric_plant(const NumericRobot& robot);
runtime::ControlModel numeric_control(const NumericRobot& robot);

/// Kinetic and potential energy, J; potential energy is 0 with the bodies at the base's origin.
double energy(const NumericRobot& robot, const Eigen::VectorXd& q, const Eigen::VectorXd& dq);

/// The robot without friction and offset.
NumericRobot without_friction(NumericRobot robot);

}  // namespace dyngen::test

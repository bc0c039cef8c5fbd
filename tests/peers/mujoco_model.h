// SPDX-License-Identifier: MIT
#pragma once

#include <mujoco/mujoco.h>

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// A robot as MuJoCo's model: bodies "link1", joints "joint1" and so on; rotor inertias as armature
/// and viscous friction as damping. The caller deletes it, and calls mj_setConst once it has data.
/// @throws std::runtime_error  with MuJoCo's message
mjModel* make_mujoco_model(const NumericRobot& robot);

}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "gen/model/robot_model.h"

/// What joints are called in sentences. A robot file counts its rows, fixed ones too, and
/// recordings count moving joints: a name says which one is meant.
namespace dyngen::runtime {

/// "joint 2", with the name where the robot file gives one: "joint 2 (shoulder)".
/// @param row  of the robot file, from 1
std::string joint_words(const RobotModel& model, int row);

/// The name that the robot file gives to a moving joint, or its number among these: "shoulder",
/// "joint 1".
/// @param coordinate  from 0
std::string coordinate_words(const RobotModel& model, int coordinate);

/// "joints: 1 shoulder, 2 elbow" of moving joints; empty where the robot file gives no names.
std::string joint_legend(const RobotModel& model);

}  // namespace dyngen::runtime

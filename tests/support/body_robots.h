// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/numeric_robot.h"

/// Robots that every library accepts: their links are bodies that can exist.
namespace dyngen::test {

struct NamedRobot {
  std::string name;
  NumericRobot robot;
};

/// XX .. M of a random solid body, by construction physically consistent: its density-weighted
/// covariance is positive definite (Wensing, Kim and Slotine 2018). Half of the bodies are lined up
/// with their frame, so that products of inertia vanish.
std::array<double, 10> random_body(std::uint64_t seed);

/// 1 to 8 joints, a third of them prismatic or fixed, both conventions, right angles and others,
/// with rotor inertia and friction on every second robot.
std::vector<NamedRobot> random_chains();
std::vector<NamedRobot> random_trees();

/// robots/*.robot. What a file leaves unknown, or gives as parameters that are not those of a body
/// (base parameters, first moments without mass), becomes a random body.
std::vector<NamedRobot> robots_of_files();

}  // namespace dyngen::test

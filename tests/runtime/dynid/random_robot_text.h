// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace dyngen::test {

/// The robot file of a random arm of 1 to 5 joints: both DH conventions, revolute, prismatic and
/// fixed joints, chains and trees; every dynamic row is absent, unknown, or partly numbers and
/// zeros. Rows share lines, run on, and use `let` names, as people write them.
std::string random_robot_text(std::uint64_t seed);

}  // namespace dyngen::test

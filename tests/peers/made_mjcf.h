// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dyngen::test {

/// The MJCF of a random robot: degrees and radians, all sequences of Euler angles, all ways to
/// write a turn, default classes, inertials and geoms, several joints of a body, references,
/// springs. The same seed gives the same text.
std::string made_mjcf(unsigned seed);

}  // namespace dyngen::test

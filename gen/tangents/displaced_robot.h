// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/symbols/symbolic_robot.h"
#include "gen/tangents/tangents.h"

namespace dyngen {

/// The robot with a joint more, which moves as a constant of the DH table does. Its coordinate is
/// the last one.
///
/// Every DH constant is a displacement along or about one of two axes, so that its derivative is
/// that of a joint there. Frames on the way to the new axis are fixed and without mass.
///
/// @param robot     in modified frames
/// @param standard  the file's convention: al and d follow th and r there
SymbolicRobot displaced_robot(const SymbolicRobot& robot, int link, DhConstant constant,
                              bool standard);

}  // namespace dyngen

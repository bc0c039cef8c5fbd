// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// Checks what values mean: joint types, parents, limits in order, masses and inertias not
/// negative, angles that look like degrees or like a rounded pi/2, bodies that cannot exist.
void check_values(const RobotFile& file, Diagnostics& diagnostics);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// Reads the CAD form of bodies into the rows of first moments and of moments about the origin,
/// exactly, and takes its rows away: mX = m cX, J = R Jc R^T + m (c.c 1 - c c^T) with R =
/// Rz(irZ) Ry(irY) Rx(irX).
///
/// A link has its first moments or its centre of mass, its moments about the origin or about the
/// centre of mass; '-' stands in rows of the form that it has not. What depends on an unknown
/// number ('*') is unknown. A link with both forms or neither, and a centre of mass without a row
/// of masses, are reported.
void resolve_cad_rows(RobotFile& file, Diagnostics& diagnostics);

}  // namespace dyngen

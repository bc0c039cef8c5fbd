// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// Warns of numbers that no body has: moments of inertia that are negative, below m c^2 or more
/// than the sum of the two others, products of inertia that are too large, first moments without
/// mass, ten numbers that are no body's together. A moment that is 0 counts as not given, an
/// unknown first moment as 0. Not for files of base parameters, which are sums over bodies.
void check_bodies(const RobotFile& file, Diagnostics& diagnostics);

/// Warns of lengths, centres of mass, radii of gyration and gravity of a size that suggests another
/// unit (millimetres).
void check_sizes(const RobotFile& file, Diagnostics& diagnostics);

/// What a row that is absent is.
enum class AbsentRows {
  kZero,     ///< of generated code and simulations
  kUnknown,  ///< of estimation
};

/// Warns of joints that carry neither mass nor inertia, and of masses beside a joint's axis whose
/// link has no moment of inertia about it.
///
/// @param absent  kUnknown: only what the file writes is looked at; kZero: only what comes of
///                absent rows, so that both calls together say everything once
void check_masses(const RobotFile& file, AbsentRows absent, Diagnostics& diagnostics);

}  // namespace dyngen

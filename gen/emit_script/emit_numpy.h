// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/functions/functions.h"

namespace dyngen {

/// The functions as a Python module that needs NumPy alone: the same programs as the C text, one
/// function per name without a prefix.
///
/// Arrays of joints have the shape (n,) or (n, ...samples): the last axes of results are those of
/// the samples, matrices are (rows, columns, ...samples). Functions whose effects remember the call
/// before are left out.
std::string emit_numpy(const CodeModel& code, const std::vector<RobotFunction>& functions);

}  // namespace dyngen

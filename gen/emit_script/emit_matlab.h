// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/functions/functions.h"

namespace dyngen {

/// The functions as a MATLAB function file, which Octave reads too: the same programs as the C
/// text. The function returns a struct of function handles: `robot = arm; tau = robot.id(q, dq,
/// ddq)`.
///
/// Arrays of joints are n x 1, or n x N for N samples; matrices are rows x columns x N. Functions
/// whose effects remember the call before are left out.
/// @param name  of the function: the file's without ".m"
std::string emit_matlab(const CodeModel& code, const std::vector<RobotFunction>& functions,
                        const std::string& name);

/// Why a MATLAB function cannot have this name; empty if it can.
std::string why_no_matlab_name(const std::string& name);

/// Why a Python module of this name cannot be imported; empty if it can.
std::string why_no_python_name(const std::string& name);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/emit_c/emit_c.h"
#include "gen/functions/functions.h"

namespace dyngen {

/// A C++20 header with the functions of the C text over Eigen's types, in the namespace that the
/// prefix names: vectors and matrices of fixed size by value, poses as isometries, several outputs
/// as a struct. Nothing is computed in it.
///
/// @param options  those of emit_c()
/// @throws ModelError  if the prefix cannot name a namespace (a keyword, std, Eigen)
///
/// The text depends on nothing but the arguments: the same input gives the same bytes.
std::string emit_cpp(const CodeModel& code, const std::vector<RobotFunction>& functions,
                     const EmitOptions& options);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <set>
#include <string>

#include "gen/emit_c/emit_c.h"

namespace dyngen {

/// True for a call that the C library does not have: the code carries a function for it.
bool is_helper_call(const std::string& call);

/// "fabs" of "abs", "expf" of "exp" in single precision.
std::string c_library_name(const std::string& call, Scalar scalar);

/// The static functions <prefix>_sign, _min, _max, _phi and _dphi of one sample.
///
/// @param calls  what the emitted functions call: names of calls, with "_lanes" those of many
///               samples at once, which may need one of these; others are left out
std::string call_helpers(const std::set<std::string>& calls, const EmitOptions& options);

}  // namespace dyngen

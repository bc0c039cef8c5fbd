// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "gen/trace/trace.h"

namespace dyngen {

/// The angles whose sine or cosine a function takes, in the order in which it first does.
std::vector<GiNaC::ex> find_angles(const Trace& trace);

bool is_one_of(const std::vector<GiNaC::ex>& angles, const GiNaC::ex& symbol);

/// "sine[2]" or "cosine[2]" for a value that is the sine or cosine of one of the angles; else
/// empty.
std::string gathered_value(const GiNaC::ex& value, const std::vector<GiNaC::ex>& angles);

/// Statements that fill the arrays sine and cosine. @param angles  C names
std::string sincos_call(const std::vector<std::string>& angles, const std::string& prefix);

/// The static function <prefix>_sincos4: sine and cosine of four angles at once, without a branch
/// that depends on them, so that compilers vectorise it.
///
/// Accurate to 1 ulp for |x| < 1e5; what is larger or not finite, other processors than x86-64 and
/// AArch64, and -ffast-math (which would undo the reduction) go to the C library. Source: reduction
/// by pi/2 in three parts (Cody and Waite 1980), coefficients of the kernels from fdlibm (Sun
/// Microsystems 1993).
std::string sincos_helper(const std::string& prefix);

}  // namespace dyngen

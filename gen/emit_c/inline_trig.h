// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <set>
#include <string>
#include <vector>

#include "gen/trace/trace.h"

namespace dyngen {

/// The angles whose sine or cosine a function takes, in the order in which it first does.
std::vector<GiNaC::ex> find_angles(const Trace& trace);

bool is_one_of(const std::vector<GiNaC::ex>& angles, const GiNaC::ex& symbol);

/// "P_AT(sine1, 2)" for a value that is the sine or cosine of one of the angles; else empty.
std::string gathered_value(const GiNaC::ex& value, const std::vector<GiNaC::ex>& angles,
                           const std::string& prefix);

/// How many angles each call takes: eight at most.
std::vector<std::size_t> sincos_sizes(std::size_t angles);

/// Statements that fill the arrays sine1, cosine1, sine2 ... @param angles  C names
std::string sincos_calls(const std::vector<std::string>& angles, const std::string& prefix);

/// The static functions <prefix>_sincos<n>: sines and cosines of n angles at once, several in one
/// register, without a branch that depends on one of them. Needs doubles_helper().
///
/// Accurate to 1 ulp for |x| < 1e5; what is larger or not finite, compilers without GNU C vectors,
/// other processors than x86-64 and AArch64, and -ffast-math (which would undo the reduction) go to
/// the C library. Source: reduction by pi/2 in three parts (Cody and Waite 1980), coefficients of
/// the kernels from fdlibm (Sun Microsystems 1993).
/// @param sizes  the numbers of angles
std::string sincos_helper(const std::string& prefix, const std::set<std::size_t>& sizes);

}  // namespace dyngen

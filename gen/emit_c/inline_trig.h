// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gen/emit_c/emit_c.h"
#include "gen/trace/angles.h"

namespace dyngen {

/// A sine or cosine of one of the angles.
struct SineOf {
  std::size_t angle = 0;
  bool cosine = false;
};

/// @return none if the value is something else
std::optional<SineOf> find_sine(const GiNaC::ex& value, const std::vector<GiNaC::ex>& angles);

/// How many angles each call takes: eight at most.
std::vector<std::size_t> sincos_sizes(std::size_t angles);

/// Statements that fill the arrays sine1, cosine1, sine2 ... @param angles  C names
std::string sincos_calls(const std::vector<std::string>& angles, const EmitOptions& options);

/// "P_AT(sine1, 2)": after sincos_calls().
std::string sine_in_register(const SineOf& sine, const EmitOptions& options);

/// Statements that fill the arrays sine and cosine, in lanes. @param angles  C names
std::string sincos_lanes_calls(const std::vector<std::string>& angles, const EmitOptions& options);

/// "sine[2]": after sincos_lanes_calls().
std::string sine_in_lanes(const SineOf& sine);

/// The static functions <prefix>_sincos<n>: sines and cosines of n angles at once, several in one
/// register, without a branch that depends on one of them; <prefix>_sincos_lanes: of n angles of
/// several samples. Needs pack_helper(), the second lanes_helper() too.
///
/// Accurate to 1 ulp for |x| < 1e5; what is larger or not finite, compilers without GNU C vectors,
/// other processors than x86-64 and AArch64, and -ffast-math (which would undo the reduction) go to
/// the C library. For float everything happens in double arithmetic. Source: reduction by pi/2 in
/// three parts (Cody and Waite 1980), coefficients of the kernels from fdlibm (Sun Microsystems
/// 1993); for float from FreeBSD's libm.
/// @param sizes  the numbers of angles  @param lanes  the second function too
std::string sincos_helper(const EmitOptions& options, const std::set<std::size_t>& sizes,
                          bool lanes);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cln/real.h>
#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <vector>

#include "gen/base_parameters/numeric_regressor.h"

namespace dyngen {

/// Numbers of 60 digits that some unknowns determine; nothing where they do not exist.
using Sampler = std::function<std::optional<std::vector<cln::cl_R>>(const GiNaC::exmap&)>;

/// Finds what the numbers are as functions of the unknowns: constants or polynomials up to
/// degree 4.
///
/// The unknowns that a number depends on are found first, one by one; then the coefficients are
/// solved for at as many random points as there are, settled to short fractions where they are
/// that, and the result must hold to 40 digits at three fresh points.
/// @return  nothing if one of the numbers is no such polynomial, or has no value somewhere
std::optional<std::vector<GiNaC::ex>> interpolate(const Sampler& sampler,
                                                  const std::vector<GiNaC::symbol>& unknowns,
                                                  RandomStream& random);

}  // namespace dyngen

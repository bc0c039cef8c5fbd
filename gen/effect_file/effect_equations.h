// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gen/effect_file/effect_file.h"

namespace dyngen {

/// What stands for a variable, parameter or state of an effect: a symbol or a number.
using EffectValues = std::function<GiNaC::ex(const std::string& name)>;

/// Torque of the effect: one value, or two of a pair.
std::vector<GiNaC::ex> effect_torque(const EffectFile& effect, const EffectValues& values);

/// dz/dt of each state, without regard to its limits.
std::vector<GiNaC::ex> state_rates(const EffectFile& effect, const EffectValues& values);

/// Limits of a state, where it has them.
struct StateLimits {
  std::optional<GiNaC::ex> min, max;
};
std::vector<StateLimits> state_limits(const EffectFile& effect, const EffectValues& values);

/// The states after a step: exponential Rosenbrock-Euler, z + h phi(-h dr/dz) r, then limited.
/// Exact for a rate that is linear in the state while its inputs stay, stable for stiff ones, and
/// exact for a limited integral. States are moved in their order, each with those before it already
/// moved, so that two that swing against each other keep their energy.
///
/// @param values  variables in the middle of the step (the mean of its two ends), states before it
/// @param step    s; 0 leaves the states as they are
/// Source: Hochbruck and Ostermann, "Exponential integrators", Acta Numerica 2010, (2.60), each
/// state with its own derivative.
std::vector<GiNaC::ex> states_after(const EffectFile& effect, const EffectValues& values,
                                    const GiNaC::ex& step);

}  // namespace dyngen

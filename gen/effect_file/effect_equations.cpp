// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_equations.h"

#include <algorithm>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/calls.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// The expression with rows `let` worked in.
ex with_lets(const EffectFile& effect, const EffectExpression& expression,
             const EffectValues& values) {
  const EffectValues resolved = [&](const std::string& name) {
    const auto let = std::find_if(effect.lets.begin(), effect.lets.end(),
                                  [&](const auto& entry) { return entry.first == name; });
    return let == effect.lets.end() ? values(name) : with_lets(effect, let->second, values);
  };
  return to_algebra(expression, resolved);
}

}  // namespace

std::vector<ex> effect_torque(const EffectFile& effect, const EffectValues& values) {
  std::vector<ex> torque;
  for (const EffectExpression& own : effect.torque) {
    torque.push_back(with_lets(effect, own, values));
  }
  return torque;
}

std::vector<ex> state_rates(const EffectFile& effect, const EffectValues& values) {
  std::vector<ex> rates;
  for (const EffectState& state : effect.states) {
    rates.push_back(with_lets(effect, state.rate, values));
  }
  return rates;
}

std::vector<StateLimits> state_limits(const EffectFile& effect, const EffectValues& values) {
  std::vector<StateLimits> limits;
  for (const EffectState& state : effect.states) {
    StateLimits own;
    if (state.min) own.min = with_lets(effect, *state.min, values);
    if (state.max) own.max = with_lets(effect, *state.max, values);
    limits.push_back(std::move(own));
  }
  return limits;
}

std::vector<ex> states_after(const EffectFile& effect, const EffectValues& values, const ex& step) {
  // derivatives are taken by symbols; a caller's states may be anything
  std::vector<GiNaC::symbol> symbols(effect.states.size());
  GiNaC::exmap back;
  for (std::size_t i = 0; i < symbols.size(); ++i) back[symbols[i]] = values(effect.states[i].name);
  const EffectValues with_symbols = [&](const std::string& name) {
    for (std::size_t i = 0; i < symbols.size(); ++i) {
      if (effect.states[i].name == name) return ex(symbols[i]);
    }
    return values(name);
  };
  const std::vector<ex> rates = state_rates(effect, with_symbols);
  const std::vector<StateLimits> limits = state_limits(effect, values);
  std::vector<ex> next;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const ex decay = -derivative_of(rates[i], symbols[i]);
    const ex mean = decay.is_zero() ? ex(1) : decay_mean(decay * step);
    ex moved = symbols[i] + step * mean * rates[i];
    moved = moved.subs(back, GiNaC::subs_options::no_pattern);
    if (limits[i].max) moved = real_min(moved, *limits[i].max);
    if (limits[i].min) moved = real_max(moved, *limits[i].min);
    back[symbols[i]] = moved;  // of the states below
    next.push_back(moved);
  }
  return next;
}

}  // namespace dyngen

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/effects/effect_search.h"
#include "runtime/estimation/least_squares.h"

namespace dyngen::runtime {

/// A condition of an effect that the estimate does not fulfil, or only just.
struct EffectRemark {
  enum class Kind { kAtBound, kFalsified, kNotSeen, kUnusual };
  Kind kind = Kind::kAtBound;
  int effect = -1;
  std::string text;  ///< a sentence
};

/// "stribeck of joint 2", "base_tilt"
std::string name_of(const EffectInstance& effect);

/// "f = 2.1 Hz: unusual, a slower oscillation is a liquid": of each usual range that an estimate is
/// beyond.
std::vector<std::string> unusual_values(const EffectInstance& effect, const EffectScales& scales);

/// Whether an unknown is part of a combination that the recordings do not determine.
bool is_unseen(const Estimate& all, int place);

/// Unknowns of effects that the recordings do not determine. @return one for each unknown
std::vector<bool> unseen_among(const Estimate& all, const EffectUnknowns& unknowns);

/// What speaks against effects at an estimate: parameters that cannot be told from others, bounds
/// and requirements that hold it back, falsifiers that are not fulfilled; and what is unusual.
/// @param all   the estimate of all unknowns together
/// @param held  the inequalities there
std::vector<EffectRemark> effect_remarks(const EffectRecordings& data, const ScaleTable& scales,
                                         const EffectPoint& point, const EffectUnknowns& unknowns,
                                         const Estimate& all, const EffectSearch::Held& held);

}  // namespace dyngen::runtime

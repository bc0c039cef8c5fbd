// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/competition/sought.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::test {

/// Which effects the recordings of a competition have.
struct ArmEffects {
  std::vector<runtime::EffectInstance> train, half_band, heldout;
};
inline ArmEffects everywhere(const std::vector<runtime::EffectInstance>& effects) {
  return {effects, effects, effects};
}

/// Data of a competition of the planar arm, whose noise is arm_noise(). The half-band test has
/// equations of the whole band, of recordings with noise of their own.
struct ArmCompetition {
  explicit ArmCompetition(const ArmEffects& effects, unsigned seed = 1)
      : evidence(arm_recordings(two_recordings(effects.train, seed))),
        slow(arm_recordings(two_recordings(effects.half_band, seed + 100))),
        heldout(arm_recordings(measured({sines(40, 0.01, 4.3, 0.9)}, planar_arm_values(),
                                        effects.heldout, kArmNoise, 0, seed + 200))),
        signals(evidence),
        half_band(slow),
        data{.evidence = evidence,
             .signals = signals,
             .fit = evidence,
             .half_band = half_band,
             .heldout = heldout} {
    signals.set_beta(planar_arm_values());
    signals.set_tangent_beta(planar_arm_values());
  }
  ArmCompetition(const ArmCompetition&) = delete;
  ArmCompetition& operator=(const ArmCompetition&) = delete;

  /// A hypothesis as a competition makes it.
  [[nodiscard]] runtime::Hypothesis hypothesis(const runtime::EffectInstance& effect) const {
    return runtime::hypothesis_of(effect, scales_of(effect));
  }
  /// What the model alone is before the first round.
  [[nodiscard]] runtime::CompetitionResult nothing_found() const {
    runtime::CompetitionResult result;
    result.base = result.fit = runtime::fit_effects(evidence, {});
    result.noise = arm_noise();
    return result;
  }
  /// A hypothesis beside the model with its true parameters, at the shapes of its effect.
  [[nodiscard]] runtime::NamedResult named(const runtime::Sought& sought, std::size_t place) {
    const runtime::Hypothesis& own = sought.hypotheses[place];
    runtime::NamedResult named;
    named.hypothesis = place;
    named.freest = named.best = runtime::try_hypothesis(
        evidence, signals, arm_system(evidence), own, own.effect, scales_of(own.effect), false);
    named.surprise = runtime::surprise_of(named);
    return named;
  }
  [[nodiscard]] runtime::EffectScales scales_of(const runtime::EffectInstance& effect) const {
    return runtime::ScaleTable(evidence).of(planar_arm_values(), effect);
  }

  runtime::EffectRecordings evidence, slow, heldout;
  runtime::EffectSignals signals;
  runtime::HalfBandTest half_band;
  runtime::CompetitionData data;
};

}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/diagnosis/answer/verdict.h"
#include "runtime/diagnosis/equation_sets/raw_residual.h"
#include "runtime/diagnosis/names/findings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// What is known of held-out torque besides its rms, away from reversals where nothing else is
/// said.
struct HeldoutKnowledge {
  /// (n) variance that the parameters' uncertainty adds to held-out torque, over that of what the
  /// fit leaves
  Eigen::VectorXd predicted;
  /// (n) mean square of what the findings leave of held-out equations, in units of the noise's
  /// variance; 0: no equation counts
  Eigen::VectorXd equations;
  /// (n) independent samples of what is left, of the fitted and of the held-out recordings
  Eigen::VectorXd fitted_worth, heldout_worth;
  /// (n) standard deviations by which blocks of held-out torque are predicted worse with the
  /// findings than without; 0: they are not
  Eigen::VectorXd worse;
  Eigen::VectorXd without, with;  ///< (n) rms of these samples, without and with the findings
  std::vector<bool> masked{};     ///< (n) joints that are not judged; empty: all are
  bool with_reversals = false;    ///< whether reversals are in these three: where no joint sticks
};

/// (n) The mean over blocks of the logarithm of the sum of squares with the findings over that
/// without them, in standard deviations of this mean; 0 where it is lower.
Eigen::VectorXd worsening(const EffectRecordings& heldout, const RunResiduals& before,
                          const RunResiduals& after);

/// Recordings are not explained where held-out equations of a joint are further above the noise
/// than the uncertainty of its parameters tells (Fisher's F, and the ratio heldout_excess), where
/// its held-out torque is far above the noise (the ratio heldout_far), or where findings predict it
/// worse. Equations are what the joint state's band lets through; torque at full rate also has what
/// the band leaves out of the motion. Where nothing was found and held-out motion goes beyond the
/// fitted one, it is the recordings that cannot tell.
/// @return  none: nothing speaks against what was concluded
std::optional<Conclusion> contradicted(const HeldoutResidual& rms, const HeldoutKnowledge& known,
                                       bool found_nothing, const std::vector<bool>& revolute,
                                       const AnswerRules& rules = {});

}  // namespace dyngen::runtime

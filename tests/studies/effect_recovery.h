// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::test {

/// How an effect came back from its own noisy recordings.
struct EffectRecovery {
  std::string name;
  int recordings = 0;
  int unseen = 0;              ///< recordings in which some parameter was not seen: named as such
  int not_converged = 0;       ///< of those in which all were seen
  std::vector<double> errors;  ///< |estimate - truth| in stated standard deviations, of what was
                               ///< estimated, over all recordings
  std::string failure;         ///< what the fit threw; empty: nothing

  /// Part of the errors below a number of standard deviations.
  [[nodiscard]] double within(double deviations) const;
  [[nodiscard]] double worst() const;
};

/// What the study does.
struct EffectStudyPlan {
  int recordings = 10;
  unsigned first_seed = 1;
  double seconds = 20;
  bool each = false;  ///< print every estimate
};

/// Recordings of a three-joint arm with one effect at its typical size, on motions of eight
/// harmonics, with torque noise half of which is correlated in time; each fitted for all base
/// parameters and all parameters of the effect. Shapes begin where the effect's file says; scanned
/// parameters are held at the truth.
EffectRecovery recover(const runtime::DescribedRobot& robot, const EffectFile& effect,
                       const EffectStudyPlan& plan);

/// The arm of the study.
runtime::DescribedRobot effect_study_robot();

}  // namespace dyngen::test

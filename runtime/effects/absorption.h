// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

/// Noise of the torque of every joint.
struct AtlasNoise {
  std::vector<AutoregressiveNoise> joints;
};

/// White noise of given standard deviations. @param deviation  (n) N m or N, positive
AtlasNoise white_noise(const Eigen::VectorXd& deviation);
/// What is left of the recorded torque after the fit of the model alone: its deviation and its
/// autocorrelation.
AtlasNoise residual_noise(const EffectRecordings& data, const Eigen::VectorXd& beta);

/// How much of an absorbed effect is a matter of the motion.
enum class Absorbed {
  kPartly,
  kByThisMotion,  ///< all of it (1 - 1e-9 or more), on this motion
  kOnAnyData      ///< all of it, and the effect's file says that the model has the same columns
};

/// What a refit of the model leaves of an effect.
struct AtlasEntry {
  EffectInstance effect;  ///< at its typical size
  std::string name;       ///< "stribeck 2", "motor_coupling 6<-5", "base_tilt"
  std::string missing;    ///< why there are no numbers, in words; empty: there are
  double absorbed = 0;    ///< part of the whitened sum of squares that the model absorbs, 0 .. 1
  Absorbed kind = Absorbed::kPartly;
  double enr_before = 0;  ///< rms over the noise, of the joints on which it acts
  double enr_left = 0;    ///< the same of what a refit leaves
  double lambda = 0;   ///< noncentrality: whitened sum of squares after the refit; N_eff ENR_left^2
  double worth = 0;    ///< N_eff: how many independent samples that is
  int parameter = -1;  ///< by which the size is given
  double typical = 0;  ///< of this parameter
  double detectable = 0;  ///< the change of it that is found nine times in ten; inf if never
};

/// What a robot's motion says of every effect, together with all parameters of the model.
struct AbsorptionAtlas {
  std::vector<AtlasEntry> entries;
  /// |cos| of the angle between what is left of two effects: (entries x entries), 0 where nothing
  /// is left or there are no numbers.
  Eigen::MatrixXd likeness;

  /// Places of the entries most alike to one, falling. @param most  how many
  [[nodiscard]] std::vector<std::size_t> nearest(std::size_t entry, std::size_t most) const;
};

/// Which effects to look at: each law on each joint it can be on; of scope pair on neighbouring
/// joints and on the given pairs, both ways; of scope robot once.
std::vector<EffectInstance> atlas_effects(const LinearModel& model,
                                          const std::vector<EffectLaw>& laws,
                                          const std::vector<std::pair<int, int>>& pairs = {});

/// The noncentrality at which a test of one parameter finds an effect nine times in ten, at one
/// false alarm in a hundred among 200 tests.
constexpr double kDetectableLambda = 28;

/// Told which effect is next: its name, its place and how many there are.
using AtlasProgress =
    std::function<void(const std::string& effect, std::size_t place, std::size_t count)>;

/// Every effect at its typical size, projected off the regressor; equations whitened by the noise.
///
/// Numbers are to first order: shapes, and what is given or scanned, stand at their typical values.
/// The detectable size scales the distance of the parameter from the value at which there is no
/// effect.
/// @param beta  (nb) at which tau_load and friction are taken
/// @throws std::invalid_argument  if a size is wrong
AbsorptionAtlas absorption_atlas(const EffectRecordings& data, const Eigen::VectorXd& beta,
                                 const AtlasNoise& noise, std::vector<EffectInstance> effects,
                                 const AtlasProgress& progress = {});

}  // namespace dyngen::runtime

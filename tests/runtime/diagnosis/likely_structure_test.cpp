// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/likely_structure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What the model leaves of recordings that do not repeat, and the likeliest structure in it.
struct Left {
  explicit Left(const EffectRecordings& data)
      : signals(data), structures(generic_structures(data.joints())) {
    result.base = result.fit = fit_effects(data, {});
    result.noise = torque_noise_model(
        data, rests_of(data, beside_white_noise(data, signals, {}, result, {}), result.fit.rms),
        std::vector<double>(data.runs.size(), 0.0), true);
    ScreeningData screened(data);
    const ScaleTable scales(data);
    const EvidenceSystem white = beside_white_noise(data, signals, {}, result, {});
    const EvidenceSystem beside =
        system_beside(data, signals, {}, result, result.fit.point, result.noise, {});
    const VectorXd& beta = result.fit.point.beta;
    first = screen(screened, beside, scales, beta, {}, structures, nullptr);
    const Screening plain = screen(screened, white, scales, beta, {}, structures, &first);
    likely = likeliest_structure(data, signals, structures, result, {white, plain});
  }

  [[nodiscard]] const GenericStructure& structure() const {
    return structures[likely->generic.structure];
  }
  [[nodiscard]] double family_wise() const {
    return likely ? first.family_wise(likely->generic.surprise) : 1;
  }

  EffectSignals signals;
  std::vector<GenericStructure> structures;
  CompetitionResult result;
  Screening first;
  std::optional<LikelyStructure> likely;
};

/// A slow function of the position that changes sign with the velocity, ten times the noise.
EffectInstance slow_structure() {
  const EffectLaw law =
      test::algebraic_law("foreign", {"q", "sign_qd"}, {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
                          [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0] * v[1]; });
  return test::known(law, 1, {1});
}

TEST(LikeliestStructure, SeesWhatIsMostOfWhatIsLeft) {
  const EffectRecordings data = test::arm_recordings(test::two_recordings({slow_structure()}, 4));
  const Left left(data);
  ASSERT_TRUE(left.likely);
  EXPECT_LT(left.family_wise(), 1e-10);
  EXPECT_EQ(left.structure().joint, 1);
  EXPECT_EQ(left.structure().names(), (std::vector<std::string>{"q2", "qd2"}));
  // with it taken out the noise is what it was
  const TorqueNoiseModel noise = torque_noise_model(data, left.likely->residuals, {0.0, 0.0}, true);
  EXPECT_GT(left.result.noise.joints[1].deviation(), 3 * test::kArmNoise);
  EXPECT_NEAR(noise.joints[1].deviation(), test::kArmNoise, 0.02 * test::kArmNoise);
}

TEST(LikeliestStructure, SlowNoiseIsHardlyEverStructure) {
  constexpr int kDraws = 10;
  constexpr double kPole = 0.95;
  int accused = 0;
  for (unsigned seed = 1; seed <= kDraws; ++seed) {
    EffectRecordings data = test::arm_recordings(test::two_recordings({}, seed));
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (EffectRun& run : data.runs) {
      for (Index j = 0; j < data.joints(); ++j) {
        double slow = normal(random) / std::sqrt(1 - kPole * kPole);
        for (Index k = 0; k < run.rows.tau.rows(); ++k) {
          run.rows.tau(k, j) += test::kArmNoise * slow * run.rows.counted(k, j);
          slow = kPole * slow + normal(random);
        }
      }
    }
    if (Left(data).family_wise() <= 0.01) ++accused;
  }
  // of 10 at the level of 1 %, two or more have the probability 0.004
  EXPECT_LE(accused, 1);
}

}  // namespace
}  // namespace dyngen::runtime

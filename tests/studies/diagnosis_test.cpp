// SPDX-License-Identifier: MIT
// The cases of docs/explanation/studies.md are what they say they are.
#include "runtime/diagnosis/diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "runtime/diagnosis/equation_sets/equation_sets.h"
#include "runtime/effects/effect_fit.h"
#include "runtime/effects/effect_rows.h"
#include "tests/studies/diagnosis_cases.h"
#include "tests/studies/diagnosis_table.h"

namespace dyngen::test {
namespace {

using Eigen::VectorXd;

runtime::EffectRecordings equations(const DiagnosisCase& own) {
  return runtime::effect_recordings(
      own.input.model, own.input.robot, own.input.train,
      runtime::diagnosis_rows(own.input.train, 0),
      std::vector<bool>(static_cast<std::size_t>(own.robot.joints()), false));
}

TEST(Cases, HaveTheStrengthThatTheAtlasSays) {
  for (const char* family : {"quadratic_drag", "load_friction", "stribeck", "joint_elasticity"}) {
    const DiagnosisCase own = make_case({.kind = CaseKind::kSingle,
                                         .seed = 4,
                                         .lambda = 60,
                                         .noise = CaseNoise::kMixed,
                                         .family = family},
                                        false);
    ASSERT_EQ(own.truth.size(), 1U);
    runtime::EffectInstance effect = own.truth[0].effect;
    effect.law.sizes = [sizes = effect.law.sizes,
                        parameters = effect.parameters](const runtime::EffectScales& scales) {
      runtime::EffectSizes own_sizes = sizes(scales);
      own_sizes.typical = parameters;
      return own_sizes;
    };
    const runtime::AbsorptionAtlas atlas =
        runtime::absorption_atlas(equations(own), own.robot.beta, own.noise, {effect});
    std::printf("%s: lambda %.1f, the atlas says %.1f\n", family, own.truth[0].lambda,
                atlas.entries[0].lambda);
    // the atlas reads the measured motion, with the effect on it, the case the true one
    EXPECT_NEAR(atlas.entries[0].lambda, 60, 6) << family;
  }
}

TEST(Cases, ComeAgainFromTheirSeed) {
  const CaseRequest request{
      .kind = CaseKind::kPair, .seed = 3, .lambda = 80, .noise = {}, .family = ""};
  const DiagnosisCase a = make_case(request, false), b = make_case(request, false);
  EXPECT_EQ(a.truth_text(), b.truth_text());
  const auto first = [](const DiagnosisCase& own) {
    Eigen::MatrixXd tau;
    own.input.train[0].pieces([&](const runtime::StreamPiece& piece) { tau = piece.motion.tau; });
    return tau;
  };
  EXPECT_EQ(first(a), first(b));
}

/// Without effects the truth leaves noise of the size that was put in, in open and closed loop.
TEST(Nulls, LeaveTheNoiseAlone) {
  for (const CaseNoise noise : {CaseNoise::kWhite, CaseNoise::kMixed, CaseNoise::kSlow,
                                CaseNoise::kClosedLoop, CaseNoise::kRoundedLoop}) {
    const DiagnosisCase own = make_case(
        {.kind = CaseKind::kNull, .seed = 5, .robot = "planar2", .noise = noise, .family = ""});
    const runtime::EffectRecordings data = equations(own);
    const runtime::EffectFit fit = runtime::fit_effects(data, {});
    for (int j = 0; j < own.robot.joints(); ++j) {
      const double ratio = fit.rms[j] / own.noise.joints[static_cast<std::size_t>(j)].deviation;
      std::printf("%s joint %d: rms of the fit over the noise %.3f\n", case_name(noise).c_str(),
                  j + 1, ratio);
      EXPECT_NEAR(ratio, 1, 0.05);
    }
  }
}

TEST(Rates, HaveTheIntervalsOfClopperAndPearson) {
  // 0 of n: 1 - 0.025^(1/n)
  const Rate none{0, 300};
  EXPECT_EQ(none.low(), 0);
  EXPECT_NEAR(none.high(), 1 - std::pow(0.025, 1.0 / 300), 1e-9);
  // of 1 of 2: by P(X >= 1) = 1 - (1 - p)^2 = 0.025 and its mirror
  const Rate half{1, 2};
  EXPECT_NEAR(half.low(), 1 - std::sqrt(0.975), 1e-9);
  EXPECT_NEAR(half.high(), std::sqrt(0.975), 1e-9);
}

TEST(Scores, SurviveALine) {
  CaseScore score;
  score.robot = "puma3";
  score.truth = "stribeck 2";
  score.answer = "nothing";
  score.true_families = {"stribeck"};
  score.errors = {0.1, 0.2};
  score.intervals = 2;
  score.covered = 1;
  score.confident_wrong = true;
  score.baselines = {{"lasso", 3, 2, true}};
  const CaseScore back = from_line(to_line(score));
  EXPECT_EQ(to_line(back), to_line(score));
  EXPECT_EQ(back.errors, score.errors);
  EXPECT_TRUE(back.confident_wrong);
  EXPECT_THROW(from_line("single\tonly"), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::test

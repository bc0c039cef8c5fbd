// SPDX-License-Identifier: MIT
// Exciting trajectories of real robots, with small budgets: docs/howto/excitation.md has the large
// ones.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/studies/excitation_claims.h"

namespace dyngen::test {
namespace {

using runtime::Criterion;
using runtime::HeldAccelerations;
using runtime::MultistageResult;

TEST(Excitation, ConditionNumbersOfSixAndSevenJointsAreBelowSixty) {
  for (const char* robot : {"robots/panda.robot", "robots/ur10e.robot"}) {
    for (const bool inertial_only : {true, false}) {
      ConditionStudy study{.robot = robot, .inertial_only = inertial_only};
      study.options.starts = 2;
      study.options.evaluations = 400;
      const ConditionFigures figures = condition_figures(study);
      ASSERT_TRUE(figures.found);
      EXPECT_LE(figures.optimised, 60) << robot;
      EXPECT_LT(figures.optimised, 0.8 * figures.random_median) << robot;
      EXPECT_LE(figures.shares.largest(), 1) << robot;
    }
  }
}

TEST(Excitation, MultistageAlgorithmGainsWhatTheThesisSays) {
  const ThesisArm arm = thesis_arm();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const HeldAccelerations start = runtime::through_chosen_points(arm.robot.linear, arm.limits,
                                                                   arm.parameters, {.seed = seed});
    const MultistageResult result = runtime::multistage(
        arm.robot.linear, arm.limits, start, {.parameters = arm.parameters, .iterations = 400});
    EXPECT_LE(result.shares.largest(), 1);
    EXPECT_GT(result.cost.front() / result.cost.back(), 11.5833) << seed;
  }
}

TEST(Excitation, HalvesTheErrorsOfEstimates) {
  EstimateStudy study{.robot = "puma3"};
  study.options.criterion.criterion = Criterion::kDeterminant;
  study.options.starts = 3;
  study.options.evaluations = 1500;
  study.seeds = 20;
  study.samples = 500;
  const EstimateComparison comparison = compare_estimates(study);
  EXPECT_GT(comparison.median_ratio(), 2);
  // what is foretold is what happens: 100 recordings, so rms to 7 %
  for (Eigen::Index i = 0; i < comparison.predicted.size(); ++i) {
    EXPECT_NEAR(comparison.optimised_rms[i] / comparison.predicted[i], 1, 0.35) << i;
  }
}

}  // namespace
}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#include "runtime/effects/absorption.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "runtime/effects/effect_fit.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFar = std::numeric_limits<double>::infinity();

EffectRecordings recordings(const std::vector<MotionSource>& sources) {
  return effect_recordings(test::planar_arm(), test::planar_arm_tangents(), sources, {1, -1});
}

AtlasEntry entry_of(const EffectLaw& law, int joint) {
  const EffectRecordings data =
      recordings(test::measured({test::sines(20, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1));
  EffectInstance effect = test::unknown(law, joint);
  return absorption_atlas(data, test::planar_arm_values(), white_noise(VectorXd::Constant(2, 0.1)),
                          {effect})
      .entries[0];
}

EffectLaw with_alias(EffectLaw law) {
  law.aliases = {"base"};
  return law;
}

TEST(Absorption, ConstantAndSineAndScaleAreTheoremsWhereTheFileSaysSo) {
  const EffectLaw counterbalance = with_alias(test::algebraic_law(
      "sine_counterbalance", {"q"}, {{"a", EffectRole::kLinear, -kFar, kFar, 0, 20}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::sin(v[0] + 0.3); }));
  EffectLaw gain = with_alias(test::algebraic_law(
      "global_torque_gain", {"torque"}, {{"k", EffectRole::kLinear, -kFar, kFar, 0, 0.05}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0]; }));
  gain.scope = EffectScope::kRobot;
  gain.acts_on_all = true;
  const std::vector<std::pair<EffectLaw, int>> theorems = {
      {with_alias(test::coulomb_asymmetry_law()), 0},
      {counterbalance, 0},
      {with_alias(test::payload_law()), -1},
      {gain, -1}};
  for (const auto& [law, joint] : theorems) {
    const AtlasEntry entry = entry_of(law, joint);
    EXPECT_EQ(entry.missing, "") << law.name;
    EXPECT_GE(entry.absorbed, 1 - 1e-12) << law.name;
    EXPECT_EQ(entry.kind, Absorbed::kOnAnyData) << law.name;
    EXPECT_TRUE(std::isinf(entry.detectable)) << law.name;
    EXPECT_GT(entry.enr_before, 1) << law.name;
  }
  EXPECT_EQ(entry_of(test::coulomb_asymmetry_law(), 0).kind, Absorbed::kByThisMotion);
}

TEST(Absorption, WhatHappensForAWhileIsLeft) {
  EffectLaw change = with_alias(test::payload_law());
  change.sizes = [](const EffectScales& scales) {
    EffectSizes sizes;
    sizes.min = sizes.max = VectorXd::Constant(3, 0);
    sizes.start = sizes.typical = Eigen::Vector3d(1, 0.5 * scales.duration, scales.duration);
    return sizes;
  };
  const AtlasEntry entry = entry_of(change, -1);
  EXPECT_LT(entry.absorbed, 0.99);
  EXPECT_EQ(entry.kind, Absorbed::kPartly);
}

TEST(Absorption, IsWhatAFitWithTheColumnSays) {
  // against plain least squares: the gain of a column is the square of what is left of it
  const EffectRecordings data =
      recordings(test::measured({test::sines(20, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1));
  const double sigma = 0.25;
  const AtlasEntry entry =
      absorption_atlas(data, test::planar_arm_values(), white_noise(VectorXd::Constant(2, sigma)),
                       {test::unknown(test::spring_law(), 1)})
          .entries[0];
  const RowBlock& rows = data.runs[0].rows;
  const Index N = rows.tau.rows(), nb = data.model.size();
  MatrixXd W(2 * N, nb);
  W << rows.Y.leftCols(nb), rows.Y.rightCols(nb);
  VectorXd psi = VectorXd::Zero(2 * N);
  psi.tail(N) = 20 * data.runs[0].motion.q.col(1);
  const VectorXd left = psi - W * W.completeOrthogonalDecomposition().solve(psi);
  EXPECT_NEAR(entry.absorbed, 1 - left.squaredNorm() / psi.squaredNorm(), 1e-10);
  EXPECT_NEAR(entry.lambda, left.squaredNorm() / (sigma * sigma), 1e-6 * entry.lambda);
  EXPECT_NEAR(entry.worth, static_cast<double>(N), 1e-6 * static_cast<double>(N));
  EXPECT_NEAR(entry.detectable, 20 * std::sqrt(28 / entry.lambda), 1e-9);
}

TEST(Absorption, TheDetectableSizeIsFoundNineTimesInTen) {
  // a one-sided view of the claim: at that size the estimate is sqrt(28) deviations from nothing
  const std::vector<Motion> run = {test::sines(20, 0.01)};
  const VectorXd beta = test::planar_arm_values();
  const double sigma = 0.2;
  const EffectRecordings data = recordings(test::measured(run, beta, {}, sigma, 0, 1));
  const AtlasEntry entry = absorption_atlas(data, beta, white_noise(VectorXd::Constant(2, sigma)),
                                            {test::unknown(test::spring_law(), 0)})
                               .entries[0];
  const auto sources = test::measured(
      run, beta, {test::known(test::spring_law(), 0, {entry.detectable})}, sigma, 0, 11);
  const EffectFit found = fit_effects(recordings(sources), {test::unknown(test::spring_law(), 0)});
  EXPECT_NEAR(entry.detectable / found.parameters[0][0].stddev, std::sqrt(kDetectableLambda), 0.4);
}

TEST(Absorption, ColouredNoiseIsWorthFewerSamples) {
  const std::vector<Motion> run = {test::sines(60, 0.01)};
  const VectorXd beta = test::planar_arm_values();
  const EffectRecordings data = recordings(test::measured(run, beta, {}, 0.2, 0.95, 21));
  const AtlasNoise noise = residual_noise(data, beta);
  EXPECT_NEAR(noise.joints[0].deviation, 0.2, 0.05);
  const AtlasEntry entry =
      absorption_atlas(data, beta, noise, {test::unknown(test::spring_law(), 0)}).entries[0];
  // a slow effect: (1 - 0.95) / (1 + 0.95) of the samples
  EXPECT_LT(entry.worth, 0.1 * static_cast<double>(data.equations()));
  EXPECT_GT(entry.worth, 0.01 * static_cast<double>(data.equations()));
}

TEST(Absorption, AnEffectIsMostLikeItsOwnCopy) {
  const EffectRecordings data =
      recordings(test::measured({test::sines(20, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1));
  EffectLaw copy = test::spring_law();
  copy.name = "cable_bending";
  const AbsorptionAtlas atlas =
      absorption_atlas(data, test::planar_arm_values(), white_noise(VectorXd::Constant(2, 0.1)),
                       {test::unknown(test::spring_law(), 1),
                        test::unknown(test::load_friction_law(), 0), test::unknown(copy, 1)});
  EXPECT_EQ(atlas.nearest(0, 1), std::vector<std::size_t>{2});
  EXPECT_NEAR(atlas.likeness(0, 2), 1, 1e-9);
  EXPECT_LT(atlas.likeness(0, 1), 0.9);
}

TEST(Absorption, OfAForceOnEveryLink) {
  const auto effects = atlas_effects(test::planar_arm(), {test::contact_law()});
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].joint, 0);
  EXPECT_EQ(effects[1].joint, 1);
  // joints beyond the link carry nothing
  EXPECT_EQ(joints_of(effects[0], 2), std::vector<int>{0});
  EXPECT_EQ(joints_of(effects[1], 2), (std::vector<int>{0, 1}));
  EffectLaw tilt = test::tilt_law();
  EXPECT_EQ(joints_of(test::unknown(tilt, -1), 2), (std::vector<int>{0, 1}));
}

TEST(Absorption, OfPairsBothWaysAndOfRobotsOnce) {
  EffectLaw pair = test::spring_law();
  pair.scope = EffectScope::kPair;
  EffectLaw turning = test::spring_law();
  turning.revolute_only = true;
  LinearModel model = test::planar_arm();
  model.revolute[1] = false;
  const auto effects = atlas_effects(model, {pair, test::tilt_law(), turning});
  ASSERT_EQ(effects.size(), 4u);
  EXPECT_EQ(effects[0].joint, 0);
  EXPECT_EQ(effects[0].other, 1);
  EXPECT_EQ(effects[1].joint, 1);
  EXPECT_EQ(effects[2].joint, -1);
  EXPECT_EQ(effects[3].joint, 0);
  model.joint_names = {"1", "2", "3"};
  model.revolute = {true, true, true};
  EXPECT_EQ(atlas_effects(model, {pair}).size(), 4u);
  EXPECT_EQ(atlas_effects(model, {pair}, {{2, 0}, {0, 1}}).size(), 6u);
}

}  // namespace
}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/evidence/unknown_torque.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "runtime/diagnosis/equation_sets/left_out_rows.h"
#include "runtime/effects/absorption.h"
#include "runtime/evidence/evidence_system.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDeviation = 0.1;  // N m
constexpr int kJoint = 1;

EffectRecordings recordings() {
  RowOptions rows;
  rows.decimation = 4;
  rows.filter.averages = 4;
  return effect_recordings(
      test::planar_arm(), test::planar_arm_tangents(),
      test::measured({test::sines(30, 0.004)}, test::planar_arm_values(), {}, kDeviation, 0, 1),
      rows, {true, true});
}

EffectRecordings with_stiction() {
  EffectRecordings data = recordings();
  EffectRun& run = data.runs.front();
  mark_stiction(run, run.motion, VectorXd::Constant(2, 1e-3), {kJoint}, 0.01);
  return data;
}

/// AR(1), so that an impulse does not stay where it is.
TorqueNoiseModel noise() {
  TorqueNoiseModel model = {quick_noise(white_noise(VectorXd::Constant(2, kDeviation)).joints),
                            VectorXd::Constant(2, 2000), false, VectorXd::Ones(2)};
  for (JointNoise& joint : model.joints) {
    joint.quick.coefficients = VectorXd::Constant(1, 0.6);
    joint.quick.innovation = 0.8 * kDeviation;
  }
  return model;
}

RunResiduals residuals(const EffectRecordings& data) {
  return {residual(data.runs.front().rows, test::planar_arm_values())};
}

/// With slow parts beside it, after which an impulse is everywhere.
TorqueNoiseModel slow_noise() {
  TorqueNoiseModel model = noise();
  for (JointNoise& joint : model.joints) joint.slow = {{0.99, kDeviation}, {0.998, kDeviation}};
  return model;
}

/// Torque of any size where the joint sticks, behind the parallel filter.
VectorXd at_rests(const EffectRun& run) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, 100 * kDeviation);
  MatrixXd torque = MatrixXd::Zero(run.motion.samples(), 1);
  for (const SampleRange& range : run.unknown[kJoint]) {
    const double from = normal(random), to = normal(random);
    for (Index k = range.from; k < range.to; ++k) {
      const double part =
          static_cast<double>(k - range.from) / static_cast<double>(range.to - range.from);
      torque(k, 0) = (1 - part) * from + part * to;
    }
  }
  return decimate(run.decimator, torque);
}

TEST(UnknownTorque, LeavesNothingOfAnyTorqueAtRests) {
  const EffectRecordings data = with_stiction();
  const RunResiduals before = residuals(data);
  RunResiduals after = before;
  after[0].col(kJoint) += at_rests(data.runs.front());
  EffectRecordings known = data;
  known.runs.front().unknown.clear();
  for (const TorqueNoiseModel& model : {noise(), slow_noise()}) {
    const auto change = [&](const EffectRecordings& seen) {
      const EvidenceSystem quiet(seen, before, model, {}), loud(seen, after, model, {});
      return (loud.rest(kJoint) - quiet.rest(kJoint)).norm();
    };
    EXPECT_GT(change(known), 300);
    EXPECT_LT(change(data), 0.01 * change(known));  // hats are straight between their peaks
  }
}

/// A torque within the parallel filter's reach of stiction intervals is seen, which equations far
/// from them miss.
TEST(UnknownTorque, LeavesWhatIsBesideThem) {
  const EffectRecordings data = with_stiction();
  const EffectRun& run = data.runs.front();
  MatrixXd torque = MatrixXd::Zero(run.motion.samples(), 1);
  for (const SampleRange& range : run.unknown[kJoint]) {  // for 24 ms after each
    for (Index k = range.to + 1; k < std::min(range.to + 7, torque.rows()); ++k) torque(k, 0) = 1;
  }
  const JointColumns column{{kJoint}, {decimate(run.decimator, torque)}};
  const auto squares = [&](const EffectRecordings& seen) {
    const EvidenceSystem system(seen, residuals(seen), noise(), {});
    return system.products(system.whitened(column), false).left(0, 0);
  };
  EffectRecordings known = data, left_out = data;
  for (EffectRecordings* each : {&known, &left_out}) each->runs.front().unknown.clear();
  leave_out_stiction(left_out.runs.front(), VectorXd::Constant(2, 1e-3), {kJoint});
  JointColumns masked = column;
  masked.parts[0] = left_out.runs.front().rows.counted.col(kJoint).asDiagonal() * masked.parts[0];
  const EvidenceSystem without(left_out, residuals(left_out), noise(), {});
  const double far = without.products(without.whitened(masked), false).left(0, 0);
  const double beside = squares(data), all = squares(known);
  EXPECT_GT(beside, 0.3 * all);
  EXPECT_GT(beside, 2 * far);
}

/// Surrogates are what noise leaves: so much fewer squares as degrees are taken.
TEST(UnknownTorque, IsTakenOutOfSurrogatesAndCounted) {
  const EffectRecordings data = with_stiction();
  EffectRecordings known = data;
  known.runs.front().unknown.clear();
  EvidenceSystem::Options options;
  options.surrogates = 64;
  const EvidenceSystem system(data, residuals(data), noise(), options);
  const EvidenceSystem all(known, residuals(known), noise(), options);
  const double degrees = system.taken()[kJoint] - all.taken()[kJoint];
  EXPECT_GT(degrees, 20);
  const auto mean = [](const MatrixXd& rows) { return rows.squaredNorm() / 64; };
  EXPECT_NEAR(mean(all.noise(kJoint)) - mean(system.noise(kJoint)), degrees, 0.15 * degrees);
  EXPECT_NEAR(system.taken()[0], all.taken()[0], 2);
}

/// Where noise has slow parts columns are not sparse: their basis lies in several pieces, each from
/// another equation on. What they take out, taken out of equations, is all of it and nothing else.
TEST(UnknownTorque, IsTakenOutInPiecesAsAWhole) {
  const EffectRecordings data = with_stiction();
  const EffectRun& run = data.runs.front();
  const Whitener whitener(slow_noise().joints[kJoint], run.rows.counted.col(kJoint));
  const UnknownTorque unknown(run, kJoint, whitener);
  const Eigen::Index count = run.rows.tau.rows();
  ASSERT_GT(unknown.degrees(), 64);
  MatrixXd left = MatrixXd::Identity(count, count);
  unknown.take_out_of(left);
  EXPECT_LT((left - left.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  MatrixXd again = left;
  unknown.take_out_of(again);
  // points that lie close are not quite orthogonal: by what equations hardly show
  EXPECT_LT((again - left).norm(), 0.01 * static_cast<double>(unknown.degrees()));
  EXPECT_NEAR(static_cast<double>(count) - left.trace(), static_cast<double>(unknown.degrees()),
              0.05 * static_cast<double>(unknown.degrees()));
}

TEST(UnknownTorque, IsNothingWhereAllIsKnown) {
  const EffectRecordings data = recordings();
  const EffectRun& run = data.runs.front();
  const Whitener whitener(noise().joints[kJoint], run.rows.counted.col(kJoint));
  const UnknownTorque unknown(run, kJoint, whitener);
  EXPECT_EQ(unknown.degrees(), 0);
  const MatrixXd rows = MatrixXd::Random(run.rows.tau.rows(), 2);
  MatrixXd left = rows;
  unknown.take_out_of(left);
  EXPECT_EQ(left, rows);
}

}  // namespace
}  // namespace dyngen::runtime

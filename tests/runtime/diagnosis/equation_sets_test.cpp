// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/equation_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/diagnosis/competition/within_rounding.h"
#include "runtime/diagnosis/equation_sets/left_out_rows.h"
#include "runtime/diagnosis/equation_sets/repeated_motion.h"
#include "runtime/diagnosis/equation_sets/repeated_rounding.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRate = 500;      // Hz
constexpr double kDigit = 2e-4;    // rad
constexpr Index kSamples = 10000;  // five periods

/// Two joints whose encoders round, with noise of some digits before.
MotionSource rounded(double noise, double cutoff = 0) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Recording recording;
  recording.time = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) / kRate);
  recording.q.resize(kSamples, 2);
  recording.tau = Eigen::MatrixXd::Ones(kSamples, 2);
  for (Index k = 0; k < kSamples; ++k) {
    const double angle = 2 * std::numbers::pi * recording.time[k] / 4;
    recording.q.row(k) << std::sin(angle), 0.5 * std::cos(angle) + 0.2 * std::sin(2 * angle);
    for (Index j = 0; j < 2; ++j) {
      double& q = recording.q(k, j);
      q = kDigit * std::round(q / kDigit + noise * normal(random));
    }
  }
  recording.run_starts = {0};
  MotionOptions options;
  options.average_periods = false;
  options.state.cutoff_hz = cutoff;
  return motion_of(std::move(recording), options);
}

TEST(RepeatedRounding, IsSeenWherePeriodsShowTheSameDigits) {
  EXPECT_TRUE(repeats_rounding(rounded(0)));
  EXPECT_FALSE(repeats_rounding(rounded(0.5)));
  EXPECT_FALSE(repeats_rounding(part_of(rounded(0), 0, 0.25)));  // a period alone
}

TEST(WithinRounding, IsAnErrorOfThePositionBelowAQuarterOfTheStep) {
  EffectRecordings data = test::arm_recordings(test::two_recordings({}, 1));
  Hypothesis hypothesis;
  hypothesis.linear = {0, 1};
  hypothesis.shapes = {2};
  hypothesis.ordered = true;
  const auto within = [&](const std::vector<std::string>& variables, double a, double b) {
    const EffectLaw law = test::algebraic_law("error", variables,
                                              {{"a", EffectRole::kLinear, -1, 1, 0, 1},
                                               {"b", EffectRole::kLinear, -1, 1, 0, 1},
                                               {"n", EffectRole::kScanned, 1, 400, 50, 50}},
                                              [](const VectorXd&, const VectorXd&) { return 0.0; });
    hypothesis.effect = test::known(law, 1, {a, b, 80});
    return within_rounding(data, hypothesis, hypothesis.effect);
  };
  const std::vector<std::string> error = {"q", "d_qdd"};
  for (EffectRun& run : data.runs) run.position_step = VectorXd::Zero(2);
  EXPECT_FALSE(within(error, 1e-9, 0));  // nothing is known of the encoder
  data.runs[1].position_step[1] = 1e-4;
  EXPECT_TRUE(within(error, 1.5e-5, -1.5e-5));
  EXPECT_FALSE(within(error, 2e-5, -2e-5));
  EXPECT_FALSE(within({"q"}, 1.5e-5, 0));  // a torque
  hypothesis.ordered = false;
  EXPECT_FALSE(within(error, 1.5e-5, 0));
}

TEST(BesideRests, TheJointStateIsQuickUnlessRoundingRepeats) {
  const std::vector<MotionSource> noisy = {rounded(0.5)}, same = {rounded(0)};
  ASSERT_LT(noisy[0].cutoff.hz, 80);
  const EquationSetOptions options{diagnosis_rows(noisy, -1), {}};
  EXPECT_FALSE(options.quick);
  const EquationSetOptions quick = beside_stiction(options, noisy, {{1, 0, {0}}});
  EXPECT_TRUE(quick.quick);
  ASSERT_EQ(quick.sticking.size(), 1u);
  EXPECT_EQ(quick.sticking[0].joint, 1);
  EXPECT_FALSE(beside_stiction(options, same, {{1, 0, {0}}}).quick);
}

TEST(BesideRests, EquationsAreSlowerThanTheJointState) {
  const std::vector<MotionSource> noisy = {rounded(0.5)}, same = {rounded(0)};
  const auto band = [](const std::vector<MotionSource>& sources) {
    return 0.5 /
           beside_stiction({diagnosis_rows(sources, -1), {}}, sources, {{0, 0, {0}}}).rows.row_time;
  };
  EXPECT_NEAR(band(noisy), 0.5 * 80, 1e-9);
  EXPECT_NEAR(band(same), 0.4 * same[0].cutoff.hz, 1e-9);
}

TEST(MotionSource, ComesBehindAnotherLowPassUnlessItWasGiven) {
  const MotionSource source = rounded(0.5);
  ASSERT_TRUE(source.others.low_passes);
  const MotionSource quick = part_of(source, 0, 0.5).others.make({.order = 8, .hz = 50});
  EXPECT_EQ(quick.cutoff.hz, 50);
  EXPECT_EQ(quick.position_noise.size(), 2);
  Index samples = 0, all = 0;
  quick.pieces([&](const StreamPiece& piece) { samples += piece.motion.samples(); });
  source.pieces([&](const StreamPiece& piece) { all += piece.motion.samples(); });
  EXPECT_NEAR(static_cast<double>(samples), static_cast<double>(all) / 2, 200);  // edges are cut
  EXPECT_FALSE(rounded(0.5, 20).others.low_passes);
}

TEST(Rests, AreLeftOutOfTheJointsThatAreNamed) {
  EffectRecordings data = test::arm_recordings({test::source_of(test::sines(20, 0.01))});
  EffectRun& run = data.runs.front();
  const double all = run.rows.counted.col(1).sum();
  leave_out_stiction(run, VectorXd::Constant(2, 1e-4), {1});
  EXPECT_EQ(run.rows.counted.col(0).sum(), all);
  Index turns = 0;
  const Index first = first_sample(run.decimator), last = run.rows.Y.rows() - 1;
  for (Index k = 1; k < run.motion.samples(); ++k) {
    if ((run.motion.dq(k, 1) < 0) == (run.motion.dq(k - 1, 1) < 0)) continue;
    ++turns;
    const Index row = std::clamp<Index>(k - first, 0, last);
    EXPECT_EQ(run.rows.counted(row, 1), 0) << k;
    EXPECT_EQ(run.rows.tau(row, 1), 0) << k;
  }
  ASSERT_GT(turns, 4);
  const double left_out = all - run.rows.counted.col(1).sum();
  EXPECT_GE(left_out, static_cast<double>(2 * turns));
  EXPECT_LE(left_out, static_cast<double>(5 * turns));  // one equation a sample reaches one further
  EXPECT_NEAR(counted_part(data)[0], 1, 1e-12);
  EXPECT_NEAR(counted_part(data)[1], 1 - left_out / all, 1e-12);
}

TEST(Rests, TakeFewerEquationsWithAShorterFilter) {
  const auto left_out = [](int averages) {
    RowOptions rows;
    rows.decimation = 6;
    rows.filter = {.pass = 0.5, .averages = averages};
    EffectRecordings data = effect_recordings(
        test::planar_arm(), test::planar_arm_tangents(),
        test::measured({test::sines(30, 0.004)}, test::planar_arm_values(), {}, 0.1, 0, 1), rows,
        {true, true});
    EffectRun& run = data.runs.front();
    const double before = run.rows.counted.col(1).sum();
    leave_out_stiction(run, VectorXd::Constant(2, 1e-3), {1});
    return before - run.rows.counted.col(1).sum();
  };
  EXPECT_GT(left_out(4), 0);
  EXPECT_LT(left_out(4), 0.8 * left_out(0));
}

TEST(Rests, AreLeftOutOfTheRecordingsInWhichTheyAreSeen) {
  const DiagnosisInput input = test::arm_input(test::two_recordings({}, 4), {}, {});
  const Division parts{input.train, input.heldout};
  EquationSetOptions options{diagnosis_rows(parts.train, -1), {}};
  const auto counted = [](const EffectRun& run, Index joint) {
    return run.rows.counted.col(joint).mean();
  };
  const EquationSets whole = equation_sets_of(input, parts, options);
  options.sticking = {{1, 0, {1}}};
  const EquationSets sets = equation_sets_of(input, parts, options);
  ASSERT_EQ(sets.train.runs.size(), 2U);
  EXPECT_EQ(counted(sets.train.runs[0], 1), counted(whole.train.runs[0], 1));
  EXPECT_LT(counted(sets.train.runs[1], 1), 0.99 * counted(whole.train.runs[1], 1));
  EXPECT_EQ(counted(sets.train.runs[1], 0), counted(whole.train.runs[1], 0));
  EXPECT_EQ(counted(sets.slow.runs[0], 1), counted(whole.slow.runs[0], 1));
  // what is held out was not looked at: there it may rest too
  EXPECT_LT(counted(sets.heldout.runs[0], 1), 0.99 * counted(whole.heldout.runs[0], 1));
}

TEST(Rests, AreUnknownWhereEquationsStay) {
  EffectRecordings data = test::arm_recordings({test::source_of(test::sines(20, 0.01))});
  EffectRun& run = data.runs.front();
  const double all = run.rows.counted.sum();
  mark_stiction(run, run.motion, VectorXd::Constant(2, 1e-4), {1}, 0.015);
  EXPECT_EQ(run.rows.counted.sum(), all);
  ASSERT_EQ(run.unknown.size(), 2U);
  EXPECT_TRUE(run.unknown[0].empty());
  const std::vector<SampleRange> once = run.unknown[1];
  Index turns = 0, before = -1;
  for (const SampleRange& range : once) {
    EXPECT_GT(range.from, before);
    before = range.to;
    EXPECT_GE(range.to - range.from, 4);  // two samples about the turn, less where the run ends
    EXPECT_LE(range.to - range.from, 6);
    turns += run.motion.dq(range.from, 1) * run.motion.dq(range.to - 1, 1) < 0 ? 1 : 0;
  }
  EXPECT_GT(turns, 4);
  // those of another motion of the same samples join them
  Motion later = run.motion;
  later.dq.bottomRows(later.samples() - 2) = run.motion.dq.topRows(later.samples() - 2);
  mark_stiction(run, later, VectorXd::Constant(2, 1e-4), {1}, 0.015);
  ASSERT_EQ(run.unknown[1].size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_LE(run.unknown[1][i].from, once[i].from);
    EXPECT_GE(run.unknown[1][i].to, once[i].to);
  }
}

TEST(Rests, LeaveEvidenceTheEquationsBesideThem) {
  const DiagnosisInput input = test::arm_input(test::two_recordings({}, 4), {}, {});
  const Division parts{input.train, input.heldout};
  EquationSetOptions every_sample{diagnosis_rows(parts.train, 1), {{1, 0, {1}}}};
  EXPECT_FALSE(
      equation_sets_of(input, parts, every_sample).beside);  // none is both at a rest and beside it
  EquationSetOptions options{diagnosis_rows(parts.train, 4), {}};
  const EquationSets whole = equation_sets_of(input, parts, options);
  EXPECT_FALSE(whole.beside);
  EXPECT_EQ(&whole.evidence(), &whole.train);
  options.sticking = {{1, 0, {1}}};
  const EquationSets sets = equation_sets_of(input, parts, options);
  ASSERT_TRUE(sets.beside);
  const EffectRecordings& evidence = sets.evidence();
  ASSERT_EQ(evidence.runs.size(), 2U);
  for (std::size_t r = 0; r < 2; ++r) {
    EXPECT_EQ(evidence.runs[r].rows.counted.sum(), whole.train.runs[r].rows.counted.sum());
  }
  EXPECT_LT(sets.train.runs[1].rows.counted.sum(), evidence.runs[1].rows.counted.sum());
  EXPECT_TRUE(evidence.runs[0].unknown.empty());
  EXPECT_TRUE(evidence.runs[1].unknown[0].empty());
  EXPECT_GT(evidence.runs[1].unknown[1].size(), 4U);
  // where both have equations they are the same
  const RowBlock& train = sets.train.runs[1].rows;
  const RowBlock& beside = evidence.runs[1].rows;
  for (Index k = 0; k < train.tau.rows(); ++k) {
    EXPECT_NEAR(train.tau(k, 1), train.counted(k, 1) * beside.tau(k, 1), 1e-12);
  }
}

TEST(Rests, OfSeveralLooksAreJoined) {
  std::vector<StictionJoint> known = {{1, 50, {0}}};
  EXPECT_FALSE(join(known, {{1, 20, {0}}}));
  EXPECT_TRUE(join(known, {{1, 20, {2}}, {0, 30, {1}}}));
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[0].recordings, (std::vector<int>{0, 2}));
  EXPECT_TRUE(known[0].sticks_in(2));
  EXPECT_FALSE(known[0].sticks_in(1));
  EXPECT_EQ(known[1].joint, 0);
}

/// tau at the other motion is what it would be if the model left there what it leaves at the own.
TEST(RepeatedMotion, LeavesWhatTheModelLeavesAtTheOwnMotion) {
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  const auto sources = test::two_recordings({spring}, 1);
  const EffectRecordings own = test::arm_recordings(sources);
  EffectRecordings other = test::arm_recordings(sources);
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal(0, 1e-2);
  for (EffectRun& run : other.runs) {
    for (double& y : run.rows.Y.reshaped()) {
      if (y != 0) y += normal(random);
    }
  }
  leave_as_at(other, own);
  const VectorXd beta = fit_effects(other, {}).point.beta;
  for (std::size_t r = 0; r < own.runs.size(); ++r) {
    const Eigen::MatrixXd left = residual(own.runs[r].rows, beta);
    EXPECT_GT(left.norm(), 1);
    EXPECT_LT((residual(other.runs[r].rows, beta) - left).norm(), 1e-5 * left.norm());
  }
}

/// Noise of the positions that the torque does not have is both in what the model leaves and in
/// columns of the same motion, and not in columns of the motion of other periods.
TEST(EquationSets, NoiseOfPositionsIsNotInWhatColumnsAreHeldAgainst) {
  constexpr double kPositionNoise = 0.2;
  Motion exact = test::sines(40, 0.01);
  for (Index k = 0; k < exact.samples(); ++k) {
    const double w = 2 * std::numbers::pi / 4, angle = w * exact.time[k];
    exact.q.row(k) << std::sin(2 * angle), std::cos(angle) + 0.5 * std::sin(3 * angle);
    exact.dq.row(k) << 2 * std::cos(2 * angle), 1.5 * std::cos(3 * angle) - std::sin(angle);
    exact.ddq.row(k) << -4 * std::sin(2 * angle), -std::cos(angle) - 4.5 * std::sin(3 * angle);
    exact.dq.row(k) *= w;
    exact.ddq.row(k) *= w * w;
  }
  std::vector<MotionSource> sources =
      test::measured({exact}, test::planar_arm_values(), {}, 0.01, 0, 3);
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0, kPositionNoise);
  sources[0].pieces([&](const StreamPiece& piece) {
    Motion noisy = piece.motion;
    for (double& x : noisy.ddq.reshaped()) x += normal(random);
    sources[0] = test::source_of(noisy);
  });
  DiagnosisInput input = test::arm_input(sources, {}, {});
  const Division parts{sources, input.heldout};
  const auto lean = [&](const EffectRecordings& data) {
    const EffectRun& run = data.runs.front();
    const VectorXd left = residual(run.rows, fit_effects(data, {}).point.beta).col(0);
    // as an elastic joint has it
    const auto ddq = run.motion.ddq.col(0).middleRows(first_sample(run.decimator), left.size());
    VectorXd column = VectorXd::Zero(left.size());
    const Index n = left.size() - 2;
    column.segment(1, n) = ddq.head(n) - 2 * ddq.segment(1, n) + ddq.tail(n);
    return left.dot(column) / left.norm() / column.norm();
  };
  const EffectRecordings own = equations_of(input, sources, {{1, -1}, {}});
  const EquationSets sets = equation_sets_of(input, parts, {{1, -1}, {}});
  EXPECT_GT(lean(own), 0.3);
  EXPECT_LT(std::abs(lean(sets.train)), 0.03);
}

/// The planar arm at 500 Hz, its positions with noise that a quick low-pass makes large
/// accelerations of. @param repeats  in whole samples
MotionSource noisy_arm(bool repeats) {
  constexpr double kPositionNoise = 1e-4;  // rad
  constexpr double kPeriod = 6;            // s
  const Motion exact = repeats ? test::sines(30, 1 / kRate, 0.3, 20 * std::acos(-1.0) / kPeriod)
                               : test::sines(30, 1 / kRate, 0.3);
  Recording recording;
  recording.time = exact.time;
  recording.q = exact.q;
  test::measured({exact}, test::planar_arm_values(), {}, 0.01, 0, 7)
      .front()
      .pieces([&](const StreamPiece& piece) { recording.tau = piece.motion.tau; });
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  for (double& q : recording.q.reshaped()) q += kPositionNoise * normal(random);
  recording.run_starts = {0};
  MotionOptions options;
  options.average_periods = false;
  options.state.cutoff_hz = 40;
  return motion_of(std::move(recording), options);
}

TEST(TwoMotions, OfEveryOtherSampleHaveNoiseOfTheirOwn) {
  const MotionSource source = noisy_arm(false);
  ASSERT_FALSE(repeats(source));
  const TwoMotions two = two_motions(source);
  const Motion exact = test::sines(30, 1 / kRate, 0.3);
  const auto noise = [&](const MotionSource& of) {
    Eigen::MatrixXd off;
    of.pieces([&](const StreamPiece& piece) {
      const auto first = static_cast<Index>(std::llround(piece.motion.time[0] * kRate));
      off = piece.motion.ddq - exact.ddq.middleRows(first, piece.motion.samples());
    });
    return off;
  };
  const Eigen::MatrixXd all = noise(source), own = noise(two.own), other = noise(two.other);
  EXPECT_LT(std::abs((own.array() * other.array()).sum()), 0.1 * own.norm() * other.norm());
  EXPECT_NEAR(own.norm() / all.norm(), std::sqrt(2.0), 0.1);
  EXPECT_EQ(two.own.position_noise, source.position_noise);
}

TEST(TwoMotions, OfPeriodsAreTheOwnAndTheOthers) {
  const MotionSource source = noisy_arm(true);
  ASSERT_TRUE(repeats(source));
  const TwoMotions two = two_motions(source);
  const auto accelerations = [](const MotionSource& of) {
    Eigen::MatrixXd ddq;
    of.pieces([&](const StreamPiece& piece) { ddq = piece.motion.ddq; });
    return ddq;
  };
  EXPECT_EQ(accelerations(two.own), accelerations(source));
  EXPECT_EQ(accelerations(two.other), accelerations(with_repeated_motion(source)));
  EXPECT_NE(accelerations(two.other), accelerations(source));
}

TEST(TwoMotions, OfPositionsWithoutNoiseAreTheSame) {
  const Motion exact = test::sines(30, 1 / kRate, 0.3);
  Recording recording;
  recording.time = exact.time;
  recording.q = exact.q;
  recording.tau = Eigen::MatrixXd::Ones(exact.samples(), 2);
  recording.run_starts = {0};
  MotionOptions options;
  options.average_periods = false;
  options.state.cutoff_hz = 40;
  const MotionSource source = motion_of(std::move(recording), options);
  EXPECT_TRUE(noisy_arm(false).others.parities);
  EXPECT_FALSE(source.others.parities);
}

/// The inertia of the second link, where accelerations are noisy.
TEST(TwoMotions, LeaveInertiaAsItIs) {
  constexpr Index kInertia = 3;  // ZZ2
  const std::vector<MotionSource> train = {noisy_arm(false)};
  const DiagnosisInput input = test::arm_input(train, {}, {});
  const EquationSetOptions options{diagnosis_rows(train, 0), {}, false};
  const double truth = test::planar_arm_values()[kInertia];
  const auto inertia = [&](const EffectRecordings& data) {
    return fit_effects(data, {}).point.beta[kInertia];
  };
  const double plain = inertia(equations_of(input, train, options));
  const double of_two = inertia(equation_sets_of(input, {train, train}, options).train);
  EXPECT_LT(plain, 0.6 * truth);
  EXPECT_NEAR(of_two, truth, 0.07 * truth);  // rounds halve what is missing
}

}  // namespace
}  // namespace dyngen::runtime

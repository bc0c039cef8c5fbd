// SPDX-License-Identifier: MIT
/// Structure that has no name or acts for a while: sinusoids, events, forms that are ruled out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/equation_sets/left_out_rows.h"
#include "runtime/diagnosis/names/naming.h"
#include "runtime/diagnosis/scans/impulse_columns.h"
#include "runtime/diagnosis/scans/line_scan.h"
#include "runtime/diagnosis/scans/time_windows.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// a sin(2 pi f t), whatever the arm does.
EffectLaw hum_law() {
  return test::algebraic_law(
      "hum", {"t"},
      {{"a", EffectRole::kLinear, -10, 10, 0, 1}, {"f", EffectRole::kShape, 0.1, 40, 3, 3}},
      [](const VectorXd& v, const VectorXd& p) {
        return p[0] * std::sin(2 * std::numbers::pi * p[1] * v[0]);
      });
}

/// A push between two times.
EffectLaw push_law() {
  EffectLaw law = test::algebraic_law("contact", {"t"},
                                      {{"push", EffectRole::kLinear, -100, 100, 0, 1},
                                       {"t_on", EffectRole::kScanned, 0, 30, 15, 15, false, 200},
                                       {"t_off", EffectRole::kScanned, 0, 30, 16, 16, false, 200}},
                                      [](const VectorXd& v, const VectorXd& p) {
                                        return v[0] > p[1] && v[0] <= p[2] ? p[0] : 0.0;
                                      });
  law.parameters[1].unit = law.parameters[2].unit = "s";
  return law;
}

/// What is recorded where an effect acts in one recording alone.
std::vector<MotionSource> with_event_in(std::size_t place, const EffectInstance& effect,
                                        unsigned seed) {
  std::vector<MotionSource> sources = test::two_recordings({}, seed);
  sources[place] = test::two_recordings({effect}, seed)[place];
  return sources;
}

TEST(LineScan, FindsTheFrequencyOfASinusoid) {
  const EffectRecordings data =
      test::arm_recordings(test::two_recordings({test::known(hum_law(), 1, {0.05, 3.3})}, 1));
  const EvidenceSystem system = test::arm_system(data);
  const LineScan there = scan_lines(data, system, 1, true),
                 other = scan_lines(data, system, 0, true);
  EXPECT_NEAR(there.frequency, 3.3, 0.5 / 30);
  EXPECT_EQ(there.score.degrees, 4);  // a phase and a size in each of two runs
  // lambda = N a^2 / (2 sigma^2)
  const double lambda =
      static_cast<double>(data.equations()) * 0.0025 / (2 * test::kArmNoise * test::kArmNoise);
  EXPECT_NEAR(there.score.delta_chi2, lambda + 4, 4 * std::sqrt(8 + 4 * lambda));
  // noise alone does not come near, and the other joint is noise
  EXPECT_LT(there.score.surrogates.maxCoeff(), 0.5 * lambda);
  EXPECT_LT(other.score.delta_chi2, 1.5 * other.score.surrogates.maxCoeff());
  EXPECT_GT(other.score.delta_chi2, 0.5 * other.score.surrogates.minCoeff());
}

TEST(ImpulseColumns, AreFewWhereAJointStandsForLong) {
  EffectRecordings data = test::arm_recordings({test::source_of(test::sines(20, 0.01))});
  EffectRun& run = data.runs.front();
  const MatrixXd moving = impulse_columns(data, 1).parts[0];
  ASSERT_GT(moving.cols(), 20);
  // half of the time it stands, with an encoder that flickers
  const Index from = 500, to = 1500;
  for (Index k = from; k < to; ++k) run.motion.dq(k, 1) = k % 2 == 0 ? 1e-6 : -1e-6;
  leave_out_standstill(run, VectorXd::Constant(2, 1e-4));
  const MatrixXd standing = impulse_columns(data, 1).parts[0];
  EXPECT_LT(standing.cols(), moving.cols() + 10);
  EXPECT_GT(standing.colwise().squaredNorm().minCoeff(), 0);
  const auto part = [&](const MatrixXd& columns, Index first, Index last) {
    return columns.middleRows(first, last - first).cwiseAbs().sum();
  };
  EXPECT_EQ(part(standing, from + 5, to - 5), 0);
  EXPECT_NEAR(part(standing, 0, from - 20), part(moving, 0, from - 20), 1e-9);
}

/// Each is a triangle of torque about some sample, as the equations' filter passes it.
TEST(ImpulseColumns, ArePassedByTheFilter) {
  constexpr Index kFactor = 6;
  RowOptions rows;
  rows.decimation = kFactor;
  const EffectRecordings data = effect_recordings(
      test::planar_arm(), test::planar_arm_tangents(),
      test::measured({test::sines(10, 0.004)}, test::planar_arm_values(), {}, 0.1, 0, 1), rows,
      {true, true});
  const EffectRun& run = data.runs.front();
  const Index samples = run.motion.samples(), width = kFactor / 2;
  MatrixXd triangles = MatrixXd::Zero(samples, samples);
  for (Index middle = 0; middle < samples; ++middle) {
    for (Index k = std::max<Index>(0, middle - width); k < std::min(samples, middle + width); ++k) {
      triangles(k, middle) = 1 - std::abs(static_cast<double>(k - middle)) / width;
    }
  }
  const MatrixXd passed = run.rows.counted.col(1).asDiagonal() * decimate(run.decimator, triangles);
  const MatrixXd impulses = impulse_columns(data, 1).parts[0];
  ASSERT_GT(impulses.cols(), 10);
  for (Index c = 0; c < impulses.cols(); ++c) {
    const double nearest =
        (passed.colwise() - impulses.col(c)).colwise().lpNorm<Eigen::Infinity>().minCoeff();
    EXPECT_LT(nearest, 1e-14) << c;
  }
}

TEST(SquaresOfFew, RiseToThoseOfAllColumns) {
  MatrixXd C = MatrixXd::Zero(4, 3);
  C << 1, 0, 1, 0, 2, 2, 0, 0, 0, 0, 0, 0;  // the third is the sum of the others
  const VectorXd r = (VectorXd(4) << 3, 1, 5, 5).finished();
  Products products;
  products.whole = products.left = C.transpose() * C;
  products.rest = C.transpose() * r;
  const std::vector<double> squares = squares_of_few(products);
  ASSERT_EQ(squares.size(), 2U);
  EXPECT_NEAR(squares[0], 9, 1e-12);
  EXPECT_NEAR(squares[1], 10, 1e-12);
  EXPECT_NEAR(score_of(products, false).delta_chi2, 10, 1e-12);
}

TEST(WindowScan, SaysInWhichRecording) {
  const EffectRecordings data =
      test::arm_recordings(with_event_in(1, test::known(push_law(), 0, {0.3, 12, 12.8}), 2));
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  const Hypothesis hypothesis = hypothesis_of(test::unknown(push_law(), 0),
                                              ScaleTable(data).at(test::planar_arm_values(), 0));
  ASSERT_TRUE(hypothesis.windowed);
  const WindowScan scan = scan_windows(data, signals, test::arm_system(data), hypothesis, true);
  EXPECT_EQ(scan.recording, 1);
  EXPECT_NEAR(scan.begin, 12, 0.3);
  EXPECT_NEAR(scan.end, 12.8, 0.3);
  EXPECT_GT(scan.score.delta_chi2, 2 * scan.score.surrogates.maxCoeff());
  // an effect of one recording has no columns in the others
  EffectInstance event = test::known(push_law(), 0, {0.3, 12, 12.8});
  event.recording = 1;
  const JointColumns columns = effect_columns(data, signals, event, {0});
  const Index half = data.runs[0].rows.Y.rows();
  EXPECT_TRUE(columns.parts[0].topRows(half).isZero(0));
  EXPECT_NEAR(columns.parts[0].bottomRows(half).maxCoeff(), 0.3, 1e-12);
}

TEST(WindowScan, SaysHowMuchSlowNoiseThereIsElsewhere) {
  const Hypothesis hypothesis = hypothesis_of(
      test::unknown(push_law(), 0), ScaleTable(test::arm_recordings(test::two_recordings({}, 1)))
                                        .at(test::planar_arm_values(), 0));
  const auto elsewhere = [&](const std::vector<MotionSource>& sources) {
    const EffectRecordings data = test::arm_recordings(sources);
    EffectSignals signals(data);
    signals.set_beta(test::planar_arm_values());
    return scan_windows(data, signals, test::arm_system(data), hypothesis, false).elsewhere;
  };
  EXPECT_LT(elsewhere(test::two_recordings({}, 5)), 2);
  // a push that is there does not count as noise
  EXPECT_LT(elsewhere(with_event_in(1, test::known(push_law(), 0, {0.3, 12, 18}), 6)), 2);
  // an autoregressive process that the system takes for white
  const std::vector<MotionSource> slow =
      test::measured({test::sines(30, 0.01, 0.3), test::sines(30, 0.01, 2.3)},
                     test::planar_arm_values(), {}, test::kArmNoise, 0.9, 7);
  EXPECT_GT(elsewhere(slow), 4);
}

TEST(Jolt, IsWhatAFewEquationsHold) {
  for (const double length : {0.02, 0.8}) {
    // the recording has it too
    EffectInstance push = test::known(push_law(), 0, {1, 12, 12 + length});
    const EffectRecordings with = test::arm_recordings(with_event_in(0, push, 7));
    push.recording = 0;
    EffectSignals own(with);
    own.set_beta(test::planar_arm_values());
    const EvidenceSystem system = test::arm_system(with);
    const JointColumns white = system.whitened(effect_columns(with, own, push, {0}));
    EXPECT_EQ(is_jolt(system, white), length < 0.1) << length;
  }
}

TEST(HeldoutProof, WeighsAGainByWhatTheChangeIsWorth) {
  // an effect of 30 squares that is there takes 30 +- 11 away
  EXPECT_TRUE((HeldoutProof{1000, 970, 30, 0, 0}.helps()));
  EXPECT_TRUE((HeldoutProof{1000, 970, 30, 0, 0}.agrees()));
  EXPECT_TRUE((HeldoutProof{1000, 994, 30, 0, 0}.agrees()));
  EXPECT_FALSE((HeldoutProof{1000, 1001, 30, 0, 0}.agrees()));
  // one that is not adds as much
  EXPECT_FALSE((HeldoutProof{1000, 1030, 30, 0, 0}.agrees()));
  EXPECT_TRUE((HeldoutProof{1000, 1030, 30, 0, 0}.harms()));
  // five parameters that were estimated with half as much again are uncertain themselves
  EXPECT_TRUE((HeldoutProof{1000, 1001, 30, 5, 60}.agrees()));
  EXPECT_FALSE((HeldoutProof{1000, 1030, 30, 5, 60}.agrees()));
  // where it hardly shows nothing is said for it
  EXPECT_FALSE((HeldoutProof{1000, 999.5, 1, 0, 0}.agrees()));
  EXPECT_FALSE((HeldoutProof{1000, 999.5, 1, 0, 0}.helps()));
  EXPECT_FALSE((HeldoutProof{1000, 997, 3, 0, 0}.informs()));
  EXPECT_TRUE((HeldoutProof{1000, 1030, 30, 0, 0}.informs()));
}

TEST(HeldoutProof, IsOfSquaresBeforeAndAfter) {
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  const EffectRecordings data = test::arm_recordings(test::two_recordings({spring}, 8));
  const EffectPoint before = at_rest(data, test::planar_arm_values(), {}),
                    after = at_rest(data, test::planar_arm_values(), {spring});
  const HeldoutProof proof = heldout_proof(data, before, after, test::arm_noise(), {});
  const double gain = proof.before - proof.after;
  EXPECT_NEAR(gain, proof.change, 5 * 2 * std::sqrt(proof.change));
  EXPECT_NEAR(proof.after, 2.0 * static_cast<double>(data.equations()),
              5 * std::sqrt(4.0 * static_cast<double>(data.equations())));
}

TEST(HeldoutProof, AllowsForErrorsOfTheModelsParameters) {
  constexpr int kDraws = 60;
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  std::mt19937 random(20261126);
  std::normal_distribution<double> normal;
  double allowed = 0, plain = 0;  // mean squares of what should have the deviation 1
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    const EffectRecordings data = test::arm_recordings(test::two_recordings({spring}, 100 + draw));
    // parameters that a fiftieth of these recordings would give
    const Eigen::MatrixXd known = 0.02 * model_information(data, test::arm_noise());
    const Eigen::LLT<Eigen::MatrixXd> root(known);
    ASSERT_EQ(root.info(), Eigen::Success);
    const Eigen::VectorXd errors = root.matrixU().solve(
        Eigen::VectorXd::NullaryExpr(known.rows(), [&] { return normal(random); }));
    const Eigen::VectorXd beta = test::planar_arm_values() + errors;
    const auto square_of = [&](const Eigen::MatrixXd& information) {
      const HeldoutProof proof =
          heldout_proof(data, at_rest(data, beta, {}), at_rest(data, beta, {spring}),
                        test::arm_noise(), information);
      return std::pow(proof.before - proof.after - proof.change, 2) / (4 * proof.change);
    };
    allowed += square_of(known) / kDraws;
    plain += square_of({}) / kDraws;
  }
  // within three deviations of the mean of 60 squares of one
  EXPECT_NEAR(allowed, 1, 3 * std::sqrt(2.0 / kDraws));
  EXPECT_GT(plain, 4);
}

TEST(HeldoutProof, LeavesOutJoltsThatNothingExplains) {
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.4});
  EffectRecordings data = test::arm_recordings(test::two_recordings({spring}, 8));
  const EffectPoint before = at_rest(data, test::planar_arm_values(), {}),
                    after = at_rest(data, test::planar_arm_values(), {spring});
  const HeldoutProof undisturbed = heldout_proof(data, before, after, test::arm_noise(), {});
  const RunResiduals without = residuals_of(data, before), with = residuals_of(data, after);
  Eigen::Index jolts = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    for (Eigen::Index k = 0; k < without[run].rows(); k += 30, ++jolts) {
      // each against the spring
      const double change = without[run](k, 1) - with[run](k, 1);
      data.runs[run].rows.tau(k, 1) -= std::copysign(50 * test::kArmNoise, change);
    }
  }
  ASSERT_GT(jolts, 20);
  const HeldoutProof proof = heldout_proof(data, before, after, test::arm_noise(), {});
  EXPECT_NEAR(proof.change, undisturbed.change, 0.2 * undisturbed.change);
  const double gain = proof.before - proof.after;
  EXPECT_NEAR(gain, proof.change, 5 * 2 * std::sqrt(proof.change));
}

/// Friction that a held joint smooths about each reversal, of both joints.
std::vector<EffectInstance> held_at_reversals() {
  const EffectLaw held = test::algebraic_law(
      "held", {"qd", "sign_qd", "Fc"}, {{"part", EffectRole::kLinear, 0, 1, 1, 1}},
      [](const VectorXd& v, const VectorXd& p) {
        return std::abs(v[0]) < 0.02 ? -p[0] * v[2] * v[1] * (1 - std::abs(v[0]) / 0.02) : 0.0;
      });
  return {test::known(held, 0, {1}), test::known(held, 1, {1})};
}

TEST(Diagnosis, WhatFrictionHoldsAtReversalsIsNoNameAndNoStructure) {
  const std::vector<EffectInstance> held = held_at_reversals();
  DiagnosisInput input = test::arm_input(test::two_recordings(held, 9), held,
                                         {test::stribeck_law(), test::spring_law()});
  EffectInstance delay = test::unknown(test::delay_law(), -1);
  delay.law.family = "time_delay";
  input.hypotheses.push_back(delay);
  const Diagnosis diagnosis = diagnose(input, test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kClean) << diagnosis.sentence;
  EXPECT_TRUE(diagnosis.findings.empty());
  EXPECT_NE(diagnosis.noise.how.find("Joints 1, 2 stick at reversals"), std::string::npos)
      << diagnosis.noise.how;
}

TEST(Diagnosis, SaysInWhichRecordingAJointRests) {
  std::vector<MotionSource> train = test::two_recordings({}, 9);
  train[1] = test::two_recordings(held_at_reversals(), 9)[1];
  const Diagnosis diagnosis =
      diagnose(test::arm_input(train, {}, {test::spring_law()}), test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kClean) << diagnosis.sentence;
  EXPECT_NE(diagnosis.noise.how.find("stick at reversals in " + train[1].name), std::string::npos)
      << diagnosis.noise.how;
}

TEST(Competition, AnEventPaysForItsSizesWithTheEquationsInWhichItActs) {
  TorqueNoiseModel noise = test::arm_noise();
  noise.worth = VectorXd::Constant(2, 5000);
  Hypothesis hypothesis;
  hypothesis.shapes = {3, 4};
  TrialScore trial;
  trial.score.degrees = 3;
  EXPECT_NEAR(price_of(hypothesis, trial, noise), 5 * std::log(1e4), 1e-9);
  trial.part = 0.01;
  EXPECT_NEAR(price_of(hypothesis, trial, noise), 3 * std::log(1e2) + 2 * std::log(1e4), 1e-9);
}

TEST(Diagnosis, NamesAnEventOfOneRecording) {
  const EffectInstance event = test::known(push_law(), 0, {0.3, 12, 12.8});
  const Diagnosis diagnosis =
      diagnose(test::arm_input(with_event_in(1, event, 3), {}, {push_law(), test::spring_law()}),
               test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  const Finding& finding = diagnosis.findings.front();
  EXPECT_EQ(finding.effect.law.name, "contact");
  EXPECT_EQ(finding.effect.joint, 0);
  EXPECT_EQ(finding.effect.recording, 1);
  EXPECT_NEAR(finding.effect.parameters[0], 0.3, 0.06);
  EXPECT_NEAR(finding.where.t_from, 12, 0.3);
  EXPECT_NEAR(finding.where.t_to, 12.8, 0.3);
  EXPECT_FALSE(finding.where.recording.empty());
  EXPECT_NE(finding.why.find(finding.where.recording), std::string::npos) << finding.why;
  // nothing of it is in what is held out
  EXPECT_NEAR(diagnosis.heldout.after[0] / diagnosis.heldout.before[0], 1, 0.01);
}

/// A force on the second link can leave the second joint without torque. The first link's explains
/// such a torque with fewer parameters. Torque on both joints is none of a force on the first link.
TEST(Diagnosis, NamesTheLinkOnWhichAForceActs) {
  for (const int link : {1, 2}) {
    EffectInstance event = test::known(test::contact_law(), link - 1, {0, 0, 0.2, 12, 15});
    event.link = link;
    const Diagnosis diagnosis =
        diagnose(test::arm_input(with_event_in(1, event, 3), {}, {test::contact_law()}),
                 test::every_sample());
    ASSERT_EQ(diagnosis.findings.size(), 1U) << diagnosis.sentence;
    const Finding& finding = diagnosis.findings.front();
    EXPECT_EQ(finding.effect.joint, link - 1) << finding.why;
    EXPECT_EQ(finding.elsewhere, "") << finding.why;
    EXPECT_NE(finding.why.find("contact on the link of joint " + std::to_string(link)),
              std::string::npos)
        << finding.why;
  }
}

TEST(Diagnosis, ASinusoidOfItsOwnFrequencyHasNoName) {
  const EffectInstance hum = test::known(hum_law(), 1, {0.05, 3.3});
  const Diagnosis diagnosis =
      diagnose(test::arm_input(test::two_recordings({hum}, 4), {hum}, {test::spring_law()}),
               test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kUnexplainedStructure);
  ASSERT_EQ(diagnosis.unexplained.size(), 1U);
  const Unexplained& unexplained = diagnosis.unexplained.front();
  EXPECT_EQ(unexplained.joint, 1);
  EXPECT_EQ(unexplained.variables, std::vector<std::string>{"t"});
  EXPECT_NEAR(unexplained.rms, 0.05 / std::numbers::sqrt2, 0.01);
  EXPECT_NE(unexplained.description.find("3.3 Hz"), std::string::npos) << unexplained.description;
}

TEST(Diagnosis, AFormThatAConditionRulesOutIsNoName) {
  EffectLaw spring = test::spring_law();
  EffectCondition stiff;
  stiff.spelling = "k >= 2";
  stiff.slack = [](const VectorXd& p, const EffectScales&) { return p[0] - 2; };
  spring.falsifiers.push_back(stiff);
  const EffectInstance truth = test::known(test::spring_law(), 1, {0.4});
  const Diagnosis diagnosis = diagnose(
      test::arm_input(test::two_recordings({truth}, 5), {truth}, {spring, test::ripple_law()}),
      test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kUnexplainedStructure);
  EXPECT_TRUE(diagnosis.findings.empty());
  ASSERT_FALSE(diagnosis.unexplained.empty());
  const Unexplained& unexplained = diagnosis.unexplained.front();
  EXPECT_EQ(unexplained.joint, 1);
  EXPECT_EQ(unexplained.variables, std::vector<std::string>{"q2"});
  EXPECT_NE(unexplained.description.find("k >= 2 does not hold"), std::string::npos)
      << unexplained.description;
}

/// A limit below which a parameter is not, or is unusual.
EffectCondition at_least(int parameter, double least, const std::string& text) {
  EffectCondition condition;
  condition.spelling = text;
  condition.text = text;
  condition.parameters = {parameter};
  condition.slack = [=](const VectorXd& p, const EffectScales&) { return p[parameter] - least; };
  return condition;
}

TEST(Diagnosis, AValueBeyondItsUsualRangeIsNamedAndSaid) {
  EffectLaw spring = test::spring_law();
  spring.usual = {at_least(0, 2, "a softer spring is a cable")};
  const EffectInstance truth = test::known(test::spring_law(), 1, {0.4});
  const auto diagnosis_of = [&](const EffectLaw& law) {
    return diagnose(
        test::arm_input(test::two_recordings({truth}, 5), {truth}, {law, test::ripple_law()}),
        test::every_sample());
  };
  const Diagnosis diagnosis = diagnosis_of(spring);
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence;
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  const Finding& finding = diagnosis.findings.front();
  EXPECT_FALSE(finding.doubted);
  const double k = finding.effect.parameters[0];
  const std::string said = fmt::format("k = {:.3g}: unusual, a softer spring is a cable", k);
  EXPECT_EQ(finding.unusual, std::vector<std::string>{said});
  EXPECT_TRUE(finding.why.ends_with("; " + said)) << finding.why;
  // the price is paid in evidence
  const Diagnosis free = diagnosis_of(test::spring_law());
  ASSERT_EQ(free.findings.size(), 1U);
  EXPECT_TRUE(free.findings.front().unusual.empty());
  EXPECT_NEAR(finding.evidence.delta_bic,
              free.findings.front().evidence.delta_bic + PriorRules().unusual_value, 1e-6);
}

/// A pull that decays over a time, which at least must be `least`, and at most the recording.
EffectLaw decay_law(double least) {
  EffectLaw law = test::algebraic_law(
      "decay", {"t"},
      {{"a", EffectRole::kLinear, -10, 10, 0, 1}, {"T", EffectRole::kShape, least, 1e9, 10, 10}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::exp(-v[0] / p[1]); });
  law.sizes = [plain = law.sizes](const EffectScales& scales) {
    EffectSizes sizes = plain(scales);
    sizes.max[1] = scales.duration;
    return sizes;
  };
  return law;
}

TEST(Diagnosis, WhatIsSlowerThanTheRecordingsIsNotTriedAndSaid) {
  const auto diagnosis_of = [](const EffectLaw& law) {
    return diagnose(test::arm_input(test::two_recordings({}, 5), {}, {test::spring_law(), law}),
                    test::every_sample());
  };
  const auto certified = [](const Diagnosis& diagnosis) {
    return std::any_of(diagnosis.certificate.begin(), diagnosis.certificate.end(),
                       [](const CertificateLine& line) { return line.effect.law.name == "decay"; });
  };
  const Diagnosis slow = diagnosis_of(decay_law(100));
  EXPECT_EQ(slow.verdict, Verdict::kClean) << slow.sentence;
  ASSERT_EQ(slow.effort.not_searched().size(), 1U);  // once, of two joints
  EXPECT_NE(slow.effort.not_searched()[0].find("decay: no T is within its bounds in 30 s"),
            std::string::npos)
      << slow.effort.not_searched()[0];
  EXPECT_FALSE(certified(slow));
  const Diagnosis quick = diagnosis_of(decay_law(1));
  EXPECT_TRUE(quick.effort.not_searched().empty());
  EXPECT_TRUE(certified(quick));
}

/// A ripple of one order, and one with twice the order beside it.
EffectLaw ripple_of(const std::string& name, bool twice) {
  std::vector<test::LawParameter> parameters = {{"a", EffectRole::kLinear, -10, 10, 0, 0.1},
                                                {"b", EffectRole::kLinear, -10, 10, 0, 0.1}};
  if (twice) parameters.push_back({"c", EffectRole::kLinear, -10, 10, 0, 0.1});
  return test::algebraic_law(
      name, {"q"}, parameters, [twice](const VectorXd& v, const VectorXd& p) {
        const double first = p[0] * std::cos(15 * v[0]) + p[1] * std::sin(15 * v[0]);
        return first + (twice ? p[2] * std::cos(30 * v[0]) : 0);
      });
}

/// What is said of a ripple with twice its order beside it, where the form of both is ruled out.
/// Three periods of 20 s: where no motion repeats effects are found by their likelihood.
/// @param second  N m
Diagnosis diagnosis_of_two_orders(double second) {
  const EffectInstance truth = test::known(ripple_of("form", true), 1, {0.3, 0.2, second});
  EffectLaw form = ripple_of("form", true);
  form.falsifiers = {at_least(2, 5, "c >= 5")};
  const auto motion = [](double phase) { return test::sines(60, 0.01, phase, std::numbers::pi); };
  return diagnose(
      test::arm_input(test::measured({motion(0.3), motion(2.3)}, test::planar_arm_values(), {truth},
                                     test::kArmNoise, 0, 6),
                      {truth}, {ripple_of("ripple", false), form}),
      test::every_sample());
}

/// Whether what is left is said to be of the form that is ruled out.
bool says_the_form(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.unexplained.begin(), diagnosis.unexplained.end(),
                     [](const Unexplained& own) {
                       return own.description.find("c >= 5 does not hold") != std::string::npos;
                     });
}

TEST(Diagnosis, AFormThatIsRuledOutDoesNotBlockWhatExplainsMostOfIt) {
  const Diagnosis most = diagnosis_of_two_orders(0.15);
  ASSERT_EQ(most.findings.size(), 1U) << most.sentence;
  EXPECT_EQ(most.findings.front().effect.law.name, "ripple");
  EXPECT_NEAR(most.findings.front().effect.parameters[0], 0.3, 0.02);
  EXPECT_TRUE(says_the_form(most));
  // the name would explain a fourth of it: the structure is something else
  const Diagnosis little = diagnosis_of_two_orders(0.6);
  EXPECT_EQ(little.verdict, Verdict::kUnexplainedStructure) << little.sentence;
  EXPECT_TRUE(little.findings.empty());
  EXPECT_TRUE(says_the_form(little));
}

TEST(Diagnosis, NamesThatImitateOneAnotherAreASet) {
  EffectLaw twin = test::spring_law();
  twin.name = "twin";
  const EffectInstance truth = test::known(test::spring_law(), 1, {0.4});
  const Diagnosis diagnosis = diagnose(
      test::arm_input(test::two_recordings({truth}, 6), {truth}, {test::spring_law(), twin}),
      test::every_sample());
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  const Finding& finding = diagnosis.findings.front();
  EXPECT_EQ(finding.aliases.size(), 2U);
  EXPECT_NEAR(finding.probability, 0.5, 0.05);
}

}  // namespace
}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/improved_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "runtime/effects/effect_residual.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "tests/runtime/dynid/made_diagnosis.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/compiled_model.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::made_effect;

const EffectCatalogue& catalogue() {
  static const EffectCatalogue kCatalogue;
  return kCatalogue;
}

std::string written(const std::string& name, const std::string& text) {
  const std::string path = test::temporary_path(name);
  std::ofstream(path) << text;
  return path;
}

/// The puma with rotor inertias that base parameters join with the links'.
std::string geared_puma(const std::string& rows) {
  std::string text = test::content(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot");
  const std::size_t row = text.find("\nIA ");
  text.replace(row, text.find('\n', row + 1) - row, "\nIA 0.7 0.5 0.2");
  text.insert(text.rfind("stop"), rows);
  return text;
}

/// A recording of a robot and effects, and what a fit of both says: what a diagnosis ends with.
struct Diagnosed {
  DescribedRobot robot;
  MotionSource source;
  EffectRecordings data;
  DiagnosisReport report;
};

Diagnosed diagnosed(const std::string& path, std::vector<EffectInstance> effects) {
  Diagnosed result;
  result.robot = describe_robot(path, OpenParameters::kAbsentRows);
  const DescribedRobot truth = describe_robot(path, OpenParameters::kAsWritten);
  VectorXd beta = truth.grouping * truth.standard;
  Recording recording = test::multisine(truth.linear, beta, {.size = 1.5, .seed = 3});
  recording.tau = recorded_torque(truth, effects, recording);
  for (Index k = 0; k < recording.samples(); ++k) {
    recording.tau.row(k).array() += 0.3 * std::sin(13.0 * static_cast<double>(k * k % 101));
  }
  MotionOptions motion;
  motion.state.method = StateMethod::kRecorded;
  motion.average_periods = false;
  recording.file_name = "made";
  result.source = motion_of(std::move(recording), motion);
  result.data =
      effect_recordings(result.robot.linear, effect_robot(result.robot), {result.source}, {}, {});
  Diagnosis diagnosis;
  diagnosis.sentence = "two effects explain it";
  diagnosis.fit = fit_effects(result.data, effects);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    Finding finding;
    finding.effect = diagnosis.fit.point.effects[i];
    finding.parameters = diagnosis.fit.parameters[i];
    diagnosis.findings.push_back(finding);
  }
  result.report = diagnosis_report(std::move(diagnosis), result.robot, catalogue());
  return result;
}

std::vector<EffectInstance> two_effects() {
  return {made_effect("stribeck", 1, -1, {13, 0.3, 2}), made_effect("load_friction", 2, -1, {0.06}),
          made_effect("load_friction", 1, -1, {0.04})};
}

TEST(ImprovedFile, LeavesTheResidualThatTheDiagnosisSays) {
  const Diagnosed made = diagnosed(written("geared.robot", geared_puma("")), two_effects());
  const EffectFit& fit = made.report.diagnosis.fit;
  ASSERT_GT(fit.rms_without[1], 1.2 * fit.rms[1]);
  const std::string path = written("improved.robot", improved_text(made.report, made.robot));
  const DescribedRobot improved = describe_robot(path, OpenParameters::kAsWritten);
  ASSERT_TRUE(improved.standard.allFinite());
  const EffectRecordings data =
      effect_recordings(improved.linear, effect_robot(improved), {made.source}, {}, {});
  const EffectPoint point = at_rest(data, improved.grouping * improved.standard,
                                    effect_instances(improved.model, catalogue()));
  ASSERT_EQ(point.effects.size(), 3u);
  const VectorXd rms = residual_with_effects(data, point);
  for (Index j = 0; j < 3; ++j) EXPECT_NEAR(rms[j], fit.rms[j], 1e-9 * fit.rms[j]);
}

TEST(ImprovedFile, CompilesToTheModelOfTheDiagnosis) {
  const Diagnosed made = diagnosed(written("geared.robot", geared_puma("")), two_effects());
  const EffectPoint& point = made.report.diagnosis.fit.point;
  const Motion& motion = made.data.runs.front().motion;
  MatrixXd torque = made.robot.linear.torque(motion.q, motion.dq, motion.ddq, point.beta);
  EffectSignals signals(made.data);
  signals.set_beta(point.beta);
  for (const EffectInstance& effect : point.effects) {
    VectorXd state;
    torque.col(effect.joint) += effect.law
                                    .evaluate(signals.variables(0, effect, effect.joint),
                                              effect.parameters, motion.sample_time, state, {})
                                    .torque.col(0);
  }
  const RobotModel model = test::parse_model(improved_text(made.report, made.robot));
  GeneratorOptions options;
  options.functions = {"id"};
  const test::CompiledModel compiled(model, test::with_short_search(options));
  double worst = 0;
  for (Index k = 0; k < motion.samples(); k += 7) {
    const auto row = [&](const MatrixXd& values) {
      return std::vector<double>{values(k, 0), values(k, 1), values(k, 2)};
    };
    const std::vector<double> tau =
        compiled.call("id", {row(motion.q), row(motion.dq), row(motion.ddq)}, {});
    for (Index j = 0; j < 3; ++j) {
      worst = std::max(worst, std::abs(tau[static_cast<std::size_t>(j)] - torque(k, j)));
    }
  }
  EXPECT_LT(worst, 1e-9 * torque.cwiseAbs().maxCoeff());
}

TEST(ImprovedFile, KeepsWhatTheFileHas) {
  const std::string text = geared_puma("# mine\neffect quadratic_drag joint=1 b=0.5\n");
  const DescribedRobot robot =
      describe_robot(written("d.robot", text), OpenParameters::kAbsentRows);
  DiagnosisReport report = test::made_report();
  const std::string improved = improved_text(report, robot);
  EXPECT_NE(improved.find("\n# mine\neffect quadratic_drag joint=1 b=0.5\n"), std::string::npos);
  EXPECT_NE(improved.find("\neffect stribeck joint=2 Fs=13 vs=0.15 delta=2\n"), std::string::npos);
  EXPECT_NE(improved.find("\neffect viscous_coupling joint=3 other=2 F=0.5 ratio=1\n"),
            std::string::npos);
  EXPECT_NE(improved.find("# by dynid diagnose: two effects"), std::string::npos);
  EXPECT_NE(improved.find("#     Fs = 13 +- 0.49 N m\n"), std::string::npos) << improved;
  EXPECT_EQ(test::parse_model(improved).joint(2).chi[index(Chi::kIA)].value,
            test::parse_model(text).joint(2).chi[index(Chi::kIA)].value);
}

TEST(ImprovedFile, WritesNumbersThatReadBack) {
  const DescribedRobot& robot = test::made_robot();
  DiagnosisReport report = test::made_report();
  report.diagnosis.fit.point.effects[0].parameters[0] = 12.345678901234567;
  const std::string path = written("exact.robot", improved_text(report, robot));
  const DescribedRobot again = describe_robot(path, OpenParameters::kAbsentRows);
  EXPECT_EQ(effect_instances(again.model, catalogue())[0].parameters[0], 12.345678901234567);
  EXPECT_EQ(again.standard, nearest_standard(robot, report.diagnosis.fit.point.beta));
}

TEST(ImprovedFile, OfAnotherSimulatorsResidualKeepsTheParameters) {
  const DescribedRobot& robot = test::made_robot();
  DiagnosisReport report = test::made_report();
  report.residual_only = true;
  const std::string path = written("rest.robot", improved_text(report, robot));
  const DescribedRobot again = describe_robot(path, OpenParameters::kAbsentRows);
  EXPECT_EQ(again.standard, robot.standard);
  EXPECT_EQ(effect_instances(again.model, catalogue()).size(), 2u);
}

TEST(NearestStandard, HasTheBaseParametersAndTheFilesRotors) {
  const std::string path = written("n.robot", geared_puma(""));
  const DescribedRobot robot = describe_robot(path, OpenParameters::kAbsentRows);
  ASSERT_EQ(joined_rotors(robot).size(), 2u);
  VectorXd beta = robot.grouping * robot.standard;
  beta.array() *= 1.1;
  const StandardParameters standard = nearest_standard(robot, beta);
  EXPECT_LT((robot.grouping * standard - beta).norm(), 1e-12 * beta.norm());
  for (const Index place : joined_rotors(robot)) EXPECT_EQ(standard[place], robot.standard[place]);
  // of a file that leaves something open
  std::string text = geared_puma("");
  const std::size_t row = text.find("\nXX ");
  text.erase(row, text.find('\n', row + 1) - row);
  const DescribedRobot open = describe_robot(written("o.robot", text), OpenParameters::kAbsentRows);
  ASSERT_FALSE(open.standard.allFinite());
  const VectorXd other = VectorXd::LinSpaced(open.linear.size(), 1, 2);
  const StandardParameters carrying = nearest_standard(open, other);
  EXPECT_LT((open.grouping * carrying - other).norm(), 1e-12 * other.norm());
  for (const Index place : joined_rotors(open)) EXPECT_EQ(carrying[place], open.standard[place]);
}

}  // namespace
}  // namespace dyngen::runtime

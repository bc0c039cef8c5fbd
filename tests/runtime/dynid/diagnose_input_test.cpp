// SPDX-License-Identifier: MIT
// What dynid diagnose makes of its robot file, its recordings and the catalogue.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/diagnose/diagnosis_recordings.h"
#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "tests/runtime/dynid/made_diagnosis.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string robot_file(const std::string& rows, const std::string& without = "") {
  std::string text = test::content(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot");
  text.insert(text.rfind("stop"), rows);
  if (!without.empty()) {
    const std::size_t row = text.find("\n" + without + " ");
    text.erase(row, text.find('\n', row + 1) - row);
  }
  static int count = 0;
  const std::string path = test::temporary_path(std::to_string(count++) + "_input.robot");
  std::ofstream(path) << text;
  return path;
}

Recording recording_of(const DescribedRobot& robot) {
  return test::multisine(robot.linear, robot.grouping * robot.standard, {.seconds = 4});
}

MotionOptions recorded_motion() {
  MotionOptions options;
  options.state.method = StateMethod::kRecorded;
  options.average_periods = false;
  return options;
}

bool has(const std::vector<EffectInstance>& effects, const std::string& name) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const EffectInstance& effect) { return effect.law.name == name; });
}

TEST(CompetingEffects, AreTheCatalogueWithNumbersForWhatIsGiven) {
  const DescribedRobot& robot = test::made_robot();
  Recording recording = recording_of(robot);
  const MotionSource plain = motion_of(recording, recorded_motion());
  const std::vector<EffectInstance> effects = competing_effects(robot, EffectCatalogue(), {plain});
  EXPECT_GT(effects.size(), 150u);
  int given = 0;
  for (const EffectInstance& effect : effects) {
    ASSERT_EQ(effect.parameters.size(), effect.law.size()) << effect.law.name;
    EXPECT_EQ(effect.link, effect.joint + 1) << effect.law.name;
    for (Index p = 0; p < effect.law.size(); ++p) {
      const bool is_given =
          effect.law.parameters[static_cast<std::size_t>(p)].role == EffectRole::kGiven;
      EXPECT_EQ(std::isfinite(effect.parameters[p]), is_given) << effect.law.name;
      given += is_given ? 1 : 0;
    }
  }
  EXPECT_GT(given, 10);
  for (const char* name : {"stribeck", "cogging", "commutation_gain", "base_tilt", "time_delay",
                           "motor_coupling", "sine_counterbalance"}) {
    EXPECT_TRUE(has(effects, name)) << name;
  }
  // dimensions of a mechanism nobody knows, and a temperature that was not recorded
  for (const char* name : {"gas_spring", "spring_mechanism", "thermal_temperature",
                           "gain_drift_temperature", "sensor_drift_temperature"}) {
    EXPECT_FALSE(has(effects, name)) << name;
  }
  recording.temperature = MatrixXd::Constant(recording.samples(), 3, 25);
  const MotionSource warm = motion_of(recording, recorded_motion());
  EXPECT_TRUE(has(competing_effects(robot, EffectCatalogue(), {warm}), "thermal_temperature"));
  EXPECT_FALSE(
      has(competing_effects(robot, EffectCatalogue(), {warm, plain}), "thermal_temperature"));
}

TEST(CompetingEffects, BelieveAUsersMechanism) {
  const std::string folder = test::temporary_path("mine");
  fs::create_directories(folder);
  std::ofstream(folder + "/spring_mechanism.effect")
      << test::content(DYNGEN_SOURCE_DIR "/gen/effects/spring_mechanism.effect");
  EffectCatalogue catalogue;
  catalogue.add_folder(folder);
  EXPECT_TRUE(has(competing_effects(test::made_robot(), catalogue, {}), "spring_mechanism"));
  fs::remove_all(folder);
}

TEST(KnownEffects, AreTakenOffARecording) {
  const std::string path = robot_file(
      "effect quadratic_drag joint=1 b=2.5\neffect load_friction joint=3 mu=0.1\n"
      "effect dahl joint=2 F=3 zs=0.01\n");
  const KnownEffects known = known_effects(path, EffectCatalogue());
  ASSERT_EQ(known.effects.size(), 3u);
  const Recording recording = recording_of(known.robot);
  const MotionSource source = motion_of(recording, recorded_motion());
  MatrixXd taken;
  int runs = 0;
  without_effects(source, known).pieces([&](const StreamPiece& piece) {
    taken = recording.tau - piece.motion.tau;
    ++runs;
  });
  ASSERT_EQ(runs, 1);
  const VectorXd v = recording.dq.col(0);
  EXPECT_LT((taken.col(0) - 2.5 * v.cwiseAbs().cwiseProduct(v)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(taken.col(1).cwiseAbs().maxCoeff(), 1);
  VectorXd beta = known.robot.grouping * known.robot.standard;
  for (Index i = 0; i < beta.size(); ++i) {
    const auto kind = known.robot.linear.parameters[static_cast<std::size_t>(i)].kind;
    if (kind != ParameterKind::kInertial) beta[i] = 0;
  }
  const VectorXd load =
      known.robot.linear.torque(recording.q, recording.dq, recording.ddq, beta).col(2);
  const VectorXd expected = 0.1 * load.cwiseAbs().array() * recording.dq.col(2).array().sign();
  EXPECT_LT((taken.col(2) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

void expect_refused(const std::string& path, const std::string& words) {
  try {
    known_effects(path, EffectCatalogue());
    ADD_FAILURE() << "not refused: " << words;
  } catch (const ModelError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find(path + ":"), std::string::npos) << text;
    EXPECT_NE(text.find("^~"), std::string::npos) << text;
  }
}

TEST(KnownEffects, AreRefusedWithTheirPlace) {
  expect_refused(robot_file("effect stribeck joint=2 Fs=*\n"), "effect 'stribeck' has no numbers");
  expect_refused(robot_file("effect time_delay T=0.004\n"), "cannot be taken off a recording");
  expect_refused(robot_file("effect base_tilt gx=0.1 gy=0\n"), "cannot be taken off a recording");
  expect_refused(robot_file("effect load_friction joint=3 mu=0.1\n", "XX"),
                 "reads friction or load that the file leaves open");
  EXPECT_EQ(
      known_effects(robot_file("effect quadratic_drag joint=1 b=2\n", "XX"), EffectCatalogue())
          .effects.size(),
      1u);
}

TEST(UnexplainedMotion, IsWhatAnotherSimulatorLeaves) {
  Recording recording = recording_of(test::made_robot());
  const std::string path = test::temporary_path("sim.csv");
  write_recording(recording, path);
  try {
    unexplained_motion(recording_file(path), recorded_motion());
    ADD_FAILURE() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("there are no columns tausim1 .. tausim3"),
              std::string::npos)
        << error.what();
  }
  recording.tau_sim = 0.75 * recording.tau;
  write_recording(recording, path);
  unexplained_motion(recording_file(path), recorded_motion()).pieces([&](const StreamPiece& piece) {
    EXPECT_LT((piece.motion.tau - 0.25 * recording.tau).cwiseAbs().maxCoeff(), 1e-9);
  });
}

}  // namespace
}  // namespace dyngen::runtime

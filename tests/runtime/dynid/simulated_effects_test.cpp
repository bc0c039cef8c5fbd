// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "runtime/control/gains.h"
#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"
#include "tests/support/effect_names.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRate = 2000;  // Hz

/// An upright arm of two joints whose parameters are those of bodies.
std::string arm_text(const std::string& rows, const std::string& gravity = "gy 9.81") {
  return "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.4\nth 0 0\nr 0 0\n"
         "m 4 2\nmX 0.9 0.35\nmY 0.05 0.02\nXX 0.02 0.01\nYY 0.3 0.09\nZZ 0.32 0.1\n"
         "IA 0.4 0.2\nFs 2 1\nFv 3 1.5\n" +
         gravity + "\n" + rows + "stop\n";
}

class ArmFile {
 public:
  explicit ArmFile(const std::string& text)
      : path_(test::temporary_path(std::to_string(count_++) + "_effects_arm.robot")) {
    std::ofstream(path_) << text;
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  static inline int count_ = 0;
  std::string path_;
};

/// Both joints swing, through zero velocity too.
Trajectory swing() {
  Trajectory trajectory;
  const Index samples = 801;
  trajectory.time = VectorXd::LinSpaced(samples, 0, 1.6);
  for (MatrixXd* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->resize(samples, 2);
  for (Index k = 0; k < samples; ++k) {
    const double t = trajectory.time[k];
    const double a = 1.8 * std::numbers::pi, b = 4.6 * std::numbers::pi, c = 2.2 * std::numbers::pi;
    trajectory.q.row(k) << 0.5 * std::sin(a * t) + 0.1 * std::sin(b * t),
        0.4 * std::cos(c * t) + 0.2;
    trajectory.dq.row(k) << 0.5 * a * std::cos(a * t) + 0.1 * b * std::cos(b * t),
        -0.4 * c * std::sin(c * t);
    trajectory.ddq.row(k) << -0.5 * a * a * std::sin(a * t) - 0.1 * b * b * std::sin(b * t),
        -0.4 * c * c * std::cos(c * t);
  }
  return trajectory;
}

ClosedLoopRun run_of(const SimulatedRobot& robot) {
  ControllerOptions options;
  options.law = ControlLaw::kComputedTorque;
  options.gains = acceleration_gains(2, 5, 1);
  options.friction = true;
  options.friction_band = VectorXd::Constant(2, 0.02);
  options.torque_limit = VectorXd::Constant(2, 1e9);
  Controller controller(robot.control, options);
  ClosedLoopOptions loop;
  loop.continuous = true;
  loop.rate = kRate;
  return simulate(robot.plant, controller, swing(), loop);
}

/// Sizes of the arm in that motion.
EffectScales arm_scales(const SimulatedRobot& robot, int joint) {
  EffectScales scales;
  scales.Fc = joint == 1 ? 1 : 2;
  scales.Fv = joint == 1 ? 1.5 : 3;
  scales.Ia = robot.plant.effects.rotor().size() > joint ? robot.plant.effects.rotor()[joint] : 0.2;
  scales.v_max = 3;
  scales.v90 = 2.5;
  scales.q_range = 0.8;
  scales.tau_max = 20;
  scales.duration = 10;
  scales.position_step = 1e-6;
  scales.temp_range = 20;
  return scales;
}

std::string row_of(const EffectLaw& law, const VectorXd& parameters) {
  std::string row = "effect " + law.name + " joint=2";
  if (law.scope == EffectScope::kPair) row += " other=1";
  for (int k = 0; k < law.size(); ++k) {
    row += " " + law.parameters[static_cast<std::size_t>(k)].name + "=" +
           std::to_string(parameters[k]);
  }
  return row + "\n";
}

/// Typical sizes that the text of a row can hold, with nothing that is zero.
VectorXd typical(const EffectLaw& law, const EffectScales& scales) {
  const EffectSizes sizes = law.sizes(scales);
  VectorXd parameters = sizes.typical;
  for (Index k = 0; k < parameters.size(); ++k) {
    const double least = std::max(sizes.min[k], -1e30);
    if (std::abs(parameters[k]) < 1e-4) parameters[k] = std::max(least, 1e-3);
    parameters[k] = std::stod(std::to_string(parameters[k]));
  }
  return parameters;
}

const EffectCatalogue& catalogue() {
  static const EffectCatalogue kCatalogue;
  return kCatalogue;
}

class EveryActingEffect : public testing::TestWithParam<std::string> {};

TEST_P(EveryActingEffect, ActsOnTheRobotAsItsFileSays) {
  const EffectLaw law = effect_law(*catalogue().find(GetParam()));
  if (!acts_on_plant(law)) GTEST_SKIP() << "it is recorded: SimulatedEffects.OthersAreRecorded";
  const ArmFile bare(arm_text(""));
  const SimulatedRobot without = read_simulated_robot(bare.path(), RobotUse::kPlant, catalogue());
  const VectorXd parameters = typical(law, arm_scales(without, 1));
  const ArmFile file(arm_text(row_of(law, parameters)));
  const SimulatedRobot robot =
      read_simulated_robot(file.path(), RobotUse::kPlant, catalogue(), {.start = 25, .rate = 10});
  ASSERT_TRUE(robot.recorded_effects.empty());
  const ClosedLoopRun run = run_of(robot);
  const Recording& truth = run.truth;
  const Index samples = truth.samples();

  // what is left of the torque beside the rigid body and the rows of the file
  MatrixXd left(samples, 2), load(samples, 2);
  for (Index k = 0; k < samples; ++k) {
    const VectorXd q = truth.q.row(k), dq = truth.dq.row(k), ddq = truth.ddq.row(k);
    VectorXd rigid(2), friction(2);
    robot.plant.rigid(q.data(), dq.data(), ddq.data(), rigid.data());
    robot.plant.friction(dq.data(), friction.data());
    left.row(k) = truth.tau.row(k) - rigid.transpose() - friction.transpose();
    load.row(k) =
        rigid.transpose() - robot.plant.effects.rotor().transpose().cwiseProduct(truth.ddq.row(k));
  }
  MatrixXd variables(samples, static_cast<Index>(law.variables.size()));
  for (std::size_t v = 0; v < law.variables.size(); ++v) {
    const std::string& name = law.variables[v];
    const Index joint = name.ends_with("_other") ? 0 : 1;
    const std::string stem = name.substr(0, name.find("_other"));
    auto column = variables.col(static_cast<Index>(v));
    if (stem == "q") column = truth.q.col(joint);
    if (stem == "qd") column = truth.dq.col(joint);
    if (stem == "qdd") column = truth.ddq.col(joint);
    if (stem == "tau_load") column = load.col(joint);
    if (stem == "sign_qd") column = truth.dq.col(joint).array().sign();
    if (stem == "Fc") column.setConstant(1);
    if (stem == "Fv") column.setConstant(1.5);
    if (stem == "Ia") column.setConstant(robot.plant.effects.rotor()[1]);
    if (stem == "t") column = truth.time.array() - truth.time[0];
    if (stem == "temp") column = 25 + 10 * (truth.time.array() - truth.time[0]);
  }
  // a simulation begins under the load without acceleration
  MatrixXd first = variables.row(0);
  const VectorXd q = truth.q.row(0), dq = truth.dq.row(0), still = VectorXd::Zero(2);
  VectorXd standing(2);
  robot.plant.rigid(q.data(), dq.data(), still.data(), standing.data());
  for (std::size_t v = 0; v < law.variables.size(); ++v) {
    if (law.variables[v] == "tau_load") first(0, static_cast<Index>(v)) = standing[1];
  }
  VectorXd state = first_states(law, first);
  const MatrixXd expected = law.evaluate(variables, parameters, 1 / kRate, state, {}).torque;
  // States are integrated with error control there, and by steps of half a millisecond here. Signs
  // of anything but a joint's own velocity are smooth within 1e-3 there.
  const double size = expected.cwiseAbs().maxCoeff();
  ASSERT_GT(size, 0);
  const bool stateful = !law.states.empty();
  const double tolerance = (stateful ? 2e-2 : 1e-8) * size;
  int compared = 0, wrong = 0;
  for (Index k = 0; k < samples; ++k) {
    // a joint at rest is held by any torque below its dry friction; near a reversal signs differ
    if (std::abs(truth.dq(k, 1)) < 0.02 || std::abs(truth.dq(k, 0)) < 0.02) continue;
    if (law.scope == EffectScope::kPair &&
        std::abs(truth.dq(k, 1) + parameters[law.size() - 1] * truth.dq(k, 0)) < 0.02) {
      continue;
    }
    if (std::abs(load(k, 1)) < 0.05) continue;
    ++compared;
    bool fits = std::abs(left(k, 1) - expected(k, 0)) <= tolerance + 1e-9;
    if (law.outputs == 2) fits = fits && std::abs(left(k, 0) - expected(k, 1)) <= tolerance + 1e-9;
    wrong += fits ? 0 : 1;
  }
  EXPECT_GT(compared, samples / 2);
  // after a reversal a state of steps lags by less than a step
  EXPECT_LE(wrong, stateful ? compared / 50 : 0) << "of " << compared;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryActingEffect, testing::ValuesIn(test::effect_names()),
                         [](const auto& own) { return own.param; });

TEST(SimulatedEffects, OthersAreRecorded) {
  const auto& all = catalogue().all();
  int recorded = 0;
  for (const auto& effect : all) recorded += acts_on_plant(effect_law(*effect)) ? 0 : 1;
  EXPECT_GT(recorded, 15);
  EXPECT_GT(static_cast<int>(all.size()) - recorded, 40);
}

TEST(SimulatedEffects, BristlesHoldAnArmThatCoulombFrictionWouldHold) {
  // Dahl's friction in place of Coulomb's: standing, the arm hangs in its bristles
  const ArmFile file(arm_text("effect dahl joint=2 F=1 zs=0.002\n", "gy 0"));
  const SimulatedRobot robot = read_simulated_robot(file.path(), RobotUse::kPlant, catalogue());
  Plant plant(robot.plant, {}, VectorXd::Zero(2), VectorXd::Zero(2));
  const TorqueSource pull = [](double time, const double*, const double*, double* tau) {
    tau[0] = 0;
    tau[1] = 0.5 * time / 20;  // slowly, so that nothing swings
  };
  plant.advance(pull, 20);
  // F z with dz/dq = (1 - z)/zs: half of F after zs ln 2; joint 1 is held by its Fs meanwhile
  EXPECT_NEAR(plant.q()[1], 0.002 * std::numbers::ln2, 1e-5);
  EXPECT_EQ(plant.q()[0], 0);
}

TEST(SimulatedEffects, StaticFrictionHoldsMoreThanCoulombFriction) {
  const ArmFile file(arm_text("effect stribeck joint=2 Fs=1.5 vs=0.05\n", "gy 0"));
  const SimulatedRobot robot = read_simulated_robot(file.path(), RobotUse::kPlant, catalogue());
  const auto moved_by = [&](double torque) {
    Plant plant(robot.plant, {}, VectorXd::Zero(2), VectorXd::Zero(2));
    plant.advance(
        [torque](double, const double*, const double*, double* tau) {
          tau[0] = 0;
          tau[1] = torque;
        },
        0.5);
    return std::abs(plant.q()[1]);
  };
  EXPECT_EQ(moved_by(1.49), 0);
  EXPECT_EQ(moved_by(-1.49), 0);
  EXPECT_GT(moved_by(1.51), 1e-3);
}

/// Any smooth motion with torques, without noise.
Recording smooth_recording() {
  Recording recording;
  const Index samples = 500;
  recording.time = VectorXd::LinSpaced(samples, 0, 0.001 * (samples - 1));
  for (MatrixXd* part : {&recording.q, &recording.dq, &recording.ddq, &recording.tau}) {
    part->resize(samples, 2);
  }
  for (Index k = 0; k < samples; ++k) {
    const double t = recording.time[k];
    recording.q.row(k) << std::sin(3 * t), std::cos(5 * t);
    recording.dq.row(k) << 3 * std::cos(3 * t), -5 * std::sin(5 * t);
    recording.ddq.row(k) << -9 * std::sin(3 * t), -25 * std::cos(5 * t);
    recording.tau.row(k) << 10 * std::sin(20 * t), 4 * std::cos(30 * t);
  }
  recording.run_starts = {0};
  return recording;
}

MatrixXd recorded(const std::string& rows, const Recording& motion) {
  const ArmFile file(arm_text(rows));
  const DescribedRobot robot = describe_robot(file.path(), OpenParameters::kAsWritten);
  return recorded_torque(robot, effect_instances(robot.model, catalogue()), motion);
}

TEST(RecordedEffects, DelayAndLagActOnTheWholeTorque) {
  const Recording motion = smooth_recording();
  const MatrixXd late = recorded("effect time_delay T=0.004\n", motion);
  EXPECT_LT((late.bottomRows(496) - motion.tau.topRows(496)).cwiseAbs().maxCoeff(), 1e-12);
  const MatrixXd lag = recorded("effect actuator_lag joint=2 T=0.003\n", motion);
  EXPECT_EQ(lag.col(0), motion.tau.col(0));
  for (Index k = 5; k < 495; ++k) {
    const double t = motion.time[k];
    EXPECT_NEAR(lag(k, 1), 4 * std::cos(30 * t) - 0.003 * 120 * std::sin(30 * t), 1e-5);
  }
}

TEST(RecordedEffects, ATiltIsAnotherDirectionOfGravity) {
  const Recording motion = smooth_recording();
  const MatrixXd tilted = recorded("effect base_tilt gx=0.3 gy=-0.2\n", motion);
  const ArmFile level(arm_text("")), sloped(arm_text("", "gx 0.3\ngy 9.61"));
  const SimulatedRobot a = read_simulated_robot(level.path(), RobotUse::kController, catalogue());
  const SimulatedRobot b = read_simulated_robot(sloped.path(), RobotUse::kController, catalogue());
  for (Index k = 0; k < motion.samples(); k += 50) {
    const VectorXd q = motion.q.row(k);
    VectorXd before(2), after(2);
    a.control.gravity(q.data(), before.data());
    b.control.gravity(q.data(), after.data());
    const VectorXd difference = (tilted.row(k) - motion.tau.row(k)).transpose();
    EXPECT_LT((difference - after + before).cwiseAbs().maxCoeff(), 1e-10);
  }
}

}  // namespace
}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
// The simulation over the generator's own programs: energy over a minute, and two simulators that
// share nothing but the robot file.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"
#include "tests/studies/changed_file.h"
#include "tests/studies/study_robot.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_plant.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::RobotUse;
using runtime::SimulatedRobot;

VectorXd random_vector(std::mt19937_64& random, Index size, double range) {
  std::uniform_real_distribution<double> uniform(-range, range);
  return VectorXd::NullaryExpr(size, [&] { return uniform(random); });
}

TEST(SimulatedRobot, FunctionsAreThoseOfTheJudge) {
  std::mt19937_64 random(20261121);
  for (const char* file : {"robots/puma560.robot", "tests/studies/robots/panda.robot"}) {
    const SimulatedRobot robot =
        runtime::read_simulated_robot(std::string(DYNGEN_SOURCE_DIR "/") + file, RobotUse::kPlant);
    const NumericRobot numeric = numeric_robot(read_model(file));
    const runtime::PlantModel judge = numeric_plant(numeric);
    const runtime::ControlModel judge_control = numeric_control(numeric);
    const Index n = robot.joints();
    EXPECT_EQ(robot.plant.coulomb, judge.coulomb);
    for (int k = 0; k < 20; ++k) {
      const VectorXd q = random_vector(random, n, 3), dq = random_vector(random, n, 3),
                     x = random_vector(random, n, 20);
      VectorXd a(n), b(n);
      const auto close = [&](const char* what) {
        EXPECT_LT((a - b).norm(), 1e-9 * (1 + b.norm())) << what;
      };
      robot.plant.forward(q.data(), dq.data(), x.data(), a.data());
      judge.forward(q.data(), dq.data(), x.data(), b.data());
      close("forward");
      robot.plant.rigid(q.data(), dq.data(), x.data(), a.data());
      judge.rigid(q.data(), dq.data(), x.data(), b.data());
      close("rigid");
      robot.plant.friction(dq.data(), a.data());
      judge.friction(dq.data(), b.data());
      close("friction");
      robot.control.gravity(q.data(), a.data());
      judge_control.gravity(q.data(), b.data());
      close("gravity");
      MatrixXd M(n, n), judged(n, n);
      robot.plant.mass_matrix(q.data(), M.data());
      judge.mass_matrix(q.data(), judged.data());
      EXPECT_TRUE(M.isApprox(judged, 1e-10));
    }
  }
}

TEST(FreeSwing, KeepsItsEnergyForAMinute) {
  const std::vector<std::string> friction = {"Fs", "Fv", "off"};
  for (const char* file : {"robots/planar2r.robot", "tests/studies/robots/puma3.robot",
                           "tests/studies/robots/panda.robot"}) {
    const ChangedFile frictionless(file, friction);
    const SimulatedRobot robot =
        runtime::read_simulated_robot(frictionless.path(), RobotUse::kPlant);
    const NumericRobot judge = without_friction(numeric_robot(read_model(file)));
    const Index n = robot.joints();
    std::mt19937_64 random(7);
    runtime::Plant plant(robot.plant, {}, random_vector(random, n, 1.5),
                         random_vector(random, n, 1));
    const double before = energy(judge, plant.q(), plant.dq());
    double worst = 0, kinetic = 0;
    for (int second = 1; second <= 60; ++second) {
      plant.advance(
          [n](double, const double*, const double*, double* tau) { std::fill_n(tau, n, 0.0); },
          second);
      const double now = energy(judge, plant.q(), plant.dq());
      worst = std::max(worst, std::abs(now - before));
      kinetic = std::max(kinetic, now - energy(judge, plant.q(), VectorXd::Zero(n)));
    }
    // relative to the largest kinetic energy: the zero of potential energy is arbitrary
    std::printf("%s: drift %.2g of %.3g J, %ld steps\n", file, worst / kinetic, kinetic,
                plant.counts().steps);
    EXPECT_LT(worst, 1e-6 * kinetic) << file;
  }
}

/// A motion's samples from -lead_in on.
runtime::Trajectory sampled(const FourierMotion& motion, const ClosedLoopOptions& loop) {
  const Index samples = 1 + std::lround((loop.lead_in + loop.seconds) / loop.sample_time);
  runtime::Trajectory trajectory;
  trajectory.time.resize(samples);
  for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq})
    part->resize(samples, motion.centre.size());
  for (Index k = 0; k < samples; ++k) {
    trajectory.time[k] = -loop.lead_in + static_cast<double>(k) * loop.sample_time;
    const FourierMotion::State state = motion.at(trajectory.time[k]);
    trajectory.q.row(k) = state.q;
    trajectory.dq.row(k) = state.dq;
    trajectory.ddq.row(k) = state.ddq;
  }
  return trajectory;
}

TEST(TwoSimulators, Agree) {
  // The study's own simulator: fixed steps, acceleration by refinement, reversals located by a
  // straight line within a millisecond.
  for (const char* name : {"puma3", "ur10e"}) {
    const StudyRobot robot = study_robot(name);
    const Index n = robot.limits.centre.size();
    ClosedLoopOptions loop = robot.loop;
    loop.seconds = 4;
    loop.encoder_step = VectorXd::Zero(n);
    loop.torque_noise = VectorXd::Zero(n);
    loop.feedforward.reset();
    set_gains(robot.truth, robot.limits.centre, 3, loop);
    const FourierMotion motion = random_motion(robot.limits, 0.1, {1, 2, 3, 5}, 10, 3);
    const ClosedLoopRun theirs = simulate(robot.truth, motion, loop, 1);

    const SimulatedRobot plant = runtime::read_simulated_robot(
        std::string(DYNGEN_SOURCE_DIR "/tests/studies/robots/") + name + ".robot",
        RobotUse::kPlant);
    runtime::ControllerOptions chosen;
    chosen.law = runtime::ControlLaw::kPd;
    chosen.gains = {loop.stiffness, loop.damping};
    runtime::Controller controller(plant.control, chosen);
    runtime::ClosedLoopOptions options;
    options.rate = 1 / loop.sample_time;
    options.velocity_cutoff_hz = loop.velocity_hz;
    const runtime::ClosedLoopRun ours =
        runtime::simulate(plant.plant, controller, sampled(motion, loop), options);
    const Index lead = std::lround(loop.lead_in / loop.sample_time), count = theirs.truth.samples();
    const double difference =
        (ours.truth.q.middleRows(lead, count) - theirs.truth.q).cwiseAbs().maxCoeff();
    std::printf("%s: largest difference %.2g rad, tracking error %.2g rad\n", name, difference,
                runtime::tracking_of(ours).worst.maxCoeff());
    EXPECT_LT(difference, 1e-7) << name;
    EXPECT_GE(ours.counts.reversals, 5);
    EXPECT_LT((ours.truth.tau.middleRows(lead, count) - theirs.measured.tau).cwiseAbs().maxCoeff(),
              0.1);
  }
}

}  // namespace
}  // namespace dyngen::test

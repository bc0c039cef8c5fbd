// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/control/controller.h"
#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::Recording;
using runtime::Trajectory;

constexpr double kHighest = 1.9;  // Hz, of the motions

Trajectory empty_trajectory(double seconds, double rate, Index joints) {
  const auto samples = static_cast<Index>(std::lround((kLeadIn + seconds) * rate)) + 1;
  Trajectory trajectory;
  trajectory.time.resize(samples);
  for (Index k = 0; k < samples; ++k) {
    trajectory.time[k] = static_cast<double>(k) / rate - kLeadIn;
  }
  for (MatrixXd* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) {
    part->resize(samples, joints);
  }
  return trajectory;
}

Trajectory fourier_trajectory(const CaseRobot& robot, const CaseSettings& settings, double period,
                              double seconds, unsigned seed) {
  std::vector<int> harmonics;
  for (const int k : {1, 2, 3, 5, 7, 11, 13, 17, 23}) {
    if (k / period <= kHighest) harmonics.push_back(k);
  }
  const FourierMotion motion = random_motion(robot.limits, 1 / period, harmonics, period, seed);
  Trajectory trajectory = empty_trajectory(seconds, settings.rate, robot.joints());
  for (Index k = 0; k < trajectory.samples(); ++k) {
    const FourierMotion::State state = motion.at(trajectory.time[k]);
    trajectory.q.row(k) = state.q;
    trajectory.dq.row(k) = state.dq;
    trajectory.ddq.row(k) = state.ddq;
  }
  return trajectory;
}

/// From one random posture to the next along polynomials of the seventh order, whose jerk is
/// continuous as that of an elastic joint has to be; a short rest between.
Trajectory point_to_point(const CaseRobot& robot, const CaseSettings& settings,
                          std::mt19937_64& random) {
  constexpr double kRest = 0.25;  // s
  const MotionLimits& limits = robot.limits;
  const Index n = robot.joints();
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto posture = [&] {
    VectorXd q(n);
    for (Index j = 0; j < n; ++j) q[j] = limits.centre[j] + uniform(random) * limits.reach[j];
    return q;
  };
  Trajectory trajectory = empty_trajectory(settings.heldout_seconds, settings.rate, n);
  VectorXd from = posture(), to = from;
  double begin = -kLeadIn, duration = kLeadIn;
  for (Index k = 0; k < trajectory.samples(); ++k) {
    const double time = trajectory.time[k];
    if (time > begin + duration + kRest) {
      begin += duration + kRest;
      from = to;
      to = posture();
      // 2.1875 and 7.514 are the largest speed and acceleration of the polynomial of unit size
      const VectorXd way = (to - from).cwiseAbs();
      duration = std::max((2.1875 * way.cwiseQuotient(limits.speed)).maxCoeff(),
                          (7.514 * way.cwiseQuotient(limits.acceleration)).cwiseSqrt().maxCoeff());
    }
    const double s = std::clamp((time - begin) / duration, 0.0, 1.0);
    const double moving = s < 1 ? 1 : 0;
    trajectory.q.row(k) =
        from + s * s * s * s * (35 - 84 * s + 70 * s * s - 20 * s * s * s) * (to - from);
    trajectory.dq.row(k) = moving * 140 * std::pow(s * (1 - s), 3) / duration * (to - from);
    trajectory.ddq.row(k) =
        moving * 420 * std::pow(s * (1 - s), 2) * (1 - 2 * s) / (duration * duration) * (to - from);
  }
  return trajectory;
}

MatrixXd temperatures(const VectorXd& time, Index joints) {
  const double duration = time[time.size() - 1];
  return (25 + 30 / duration * time.array()).matrix().replicate(1, joints);
}

/// The recorded part of signals that begin kLeadIn earlier.
Recording recorded_part(const CaseSettings& settings, const VectorXd& time, const MatrixXd& q,
                        const MatrixXd& dq, const MatrixXd& ddq) {
  const auto lead = static_cast<Index>(std::lround(kLeadIn * settings.rate));
  const Index samples = std::min(time.size(), q.rows()) - lead;
  Recording recording;
  recording.time.resize(samples);
  for (Index k = 0; k < samples; ++k) {
    recording.time[k] = static_cast<double>(k) / settings.rate;
  }
  recording.q = q.middleRows(lead, samples);
  recording.dq = dq.middleRows(lead, samples);
  recording.ddq = ddq.middleRows(lead, samples);
  recording.run_starts = {0};
  if (settings.temperature) recording.temperature = temperatures(recording.time, q.cols());
  return recording;
}

double step_of(const CaseSettings& settings) {
  return 2 * std::numbers::pi / std::ldexp(1.0, settings.encoder_bits);
}

/// Without a loop nothing moves the position within a step of the encoder: the last digit is
/// uncertain by a step.
CaseMotion prescribed(const CaseRobot& robot, const CaseSettings& settings,
                      const Trajectory& trajectory, std::uint64_t seed) {
  CaseMotion motion;
  motion.truth =
      recorded_part(settings, trajectory.time, trajectory.q, trajectory.dq, trajectory.ddq);
  motion.truth.tau =
      robot.built.linear.torque(motion.truth.q, motion.truth.dq, motion.truth.ddq, robot.beta);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> dither(-0.5, 0.5);
  const double step = step_of(settings);
  motion.encoder = motion.truth.q.unaryExpr(
      [&](double q) { return step * std::round(q / step + dither(random)); });
  return motion;
}

VectorXd of_joints(const CaseRobot& robot, Chi kind) {
  VectorXd values(robot.joints());
  for (int j = 0; j < robot.joints(); ++j) values[j] = robot.actuator(j, kind);
  return values;
}

CaseMotion controlled(const CaseRobot& robot, const CaseSettings& settings,
                      const Trajectory& trajectory, const std::vector<EffectInstance>& acting,
                      std::uint64_t seed) {
  const int n = robot.joints();
  runtime::SimulatedRobot plant = built_plant(robot);
  const double duration = trajectory.time[trajectory.samples() - 1];
  plant.plant.effects = runtime::PlantEffects(
      acting, {of_joints(robot, Chi::kFS), of_joints(robot, Chi::kFV), of_joints(robot, Chi::kIA),
               25 - 30 / duration * kLeadIn, 30 / duration});
  const runtime::SimulatedRobot model =
      runtime::read_simulated_robot(robot.told_path, runtime::RobotUse::kController);
  MatrixXd M(n, n);
  const VectorXd posture = trajectory.q.row(0);
  plant.plant.mass_matrix(posture.data(), M.data());
  runtime::ControllerOptions chosen;
  chosen.law = runtime::ControlLaw::kFeedforward;
  chosen.gains = runtime::torque_gains(M.diagonal(), settings.bandwidth, 1);
  chosen.friction = true;
  runtime::Controller controller(model.control, chosen);
  runtime::ClosedLoopOptions loop;
  loop.rate = settings.rate;
  loop.encoder_step = VectorXd::Constant(n, step_of(settings));
  loop.encoder_noise = settings.encoder_noise;
  loop.velocity_cutoff_hz = 40;
  loop.seed = seed;
  loop.integration.tolerance = 1e-8;
  const runtime::ClosedLoopRun run = runtime::simulate(plant.plant, controller, trajectory, loop);
  CaseMotion motion;
  motion.truth = recorded_part(settings, run.truth.time, run.truth.q, run.truth.dq, run.truth.ddq);
  motion.truth.tau = run.truth.tau.bottomRows(motion.truth.samples());
  motion.encoder = run.measured.q.bottomRows(motion.truth.samples());
  return motion;
}

std::vector<EffectInstance> acting_of(const std::vector<EffectInstance>& effects, bool wanted) {
  std::vector<EffectInstance> result;
  for (const EffectInstance& effect : effects) {
    if (runtime::acts_on_plant(effect.law) == wanted) result.push_back(effect);
  }
  return result;
}

}  // namespace

std::vector<Trajectory> case_trajectories(const CaseRobot& robot, const CaseSettings& settings,
                                          std::mt19937_64& random) {
  std::vector<Trajectory> trajectories;
  const auto seed = [&] { return static_cast<unsigned>(random()); };
  for (int r = 0; r < 3; ++r) {
    trajectories.push_back(
        fourier_trajectory(robot, settings, settings.period, settings.train_seconds(), seed()));
  }
  trajectories.push_back(fourier_trajectory(robot, settings, settings.heldout_seconds,
                                            settings.heldout_seconds, seed()));
  trajectories.push_back(point_to_point(robot, settings, random));
  return trajectories;
}

CaseMotion move(const CaseRobot& robot, const CaseSettings& settings, const Trajectory& trajectory,
                const std::vector<EffectInstance>& acting, std::uint64_t seed) {
  return settings.closed_loop
             ? controlled(robot, settings, trajectory, acting_of(acting, true), seed)
             : prescribed(robot, settings, trajectory, seed);
}

MatrixXd recorded_share(const CaseRobot& robot, const CaseSettings& settings,
                        const CaseMotion& motion, const std::vector<EffectInstance>& effects) {
  const std::vector<EffectInstance> shown =
      settings.closed_loop ? acting_of(effects, false) : effects;
  if (shown.empty()) return MatrixXd::Zero(motion.truth.samples(), motion.truth.joints());
  return runtime::recorded_torque(robot.built, shown, motion.truth) - motion.truth.tau;
}

}  // namespace dyngen::test

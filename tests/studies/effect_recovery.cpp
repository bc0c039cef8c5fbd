// SPDX-License-Identifier: MIT
#include "tests/studies/effect_recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <random>

#include "runtime/effects/effect_fit.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/simulation/torque_noise.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "tests/studies/fourier_motion.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::EffectRole;
using runtime::EffectScope;
using runtime::Recording;

constexpr double kRate = 500;  // Hz

/// Motion and torque of the robot without effects, without noise.
Recording clean_recording(const runtime::DescribedRobot& robot, const EffectStudyPlan& plan,
                          unsigned seed) {
  const Index n = robot.linear.joints();
  MotionLimits limits;
  limits.centre = VectorXd::Constant(n, 0.3);
  limits.reach = VectorXd::Constant(n, 1.2);
  limits.speed = VectorXd::Constant(n, 2.5);
  limits.acceleration = VectorXd::Constant(n, 12);
  const FourierMotion motion =
      random_motion(limits, 0.1, {1, 2, 3, 5, 7, 11, 13, 17}, plan.seconds, seed);
  const auto samples = static_cast<Index>(plan.seconds * kRate) + 1;
  Recording recording;
  recording.file_name = "study";
  recording.time = VectorXd::LinSpaced(samples, 0, plan.seconds);
  for (MatrixXd* part : {&recording.q, &recording.dq, &recording.ddq}) part->resize(samples, n);
  for (Index k = 0; k < samples; ++k) {
    const FourierMotion::State state = motion.at(recording.time[k]);
    recording.q.row(k) = state.q;
    recording.dq.row(k) = state.dq;
    recording.ddq.row(k) = state.ddq;
  }
  const VectorXd beta = robot.grouping * robot.standard;
  recording.tau = robot.linear.torque(recording.q, recording.dq, recording.ddq, beta);
  recording.temperature =
      (25 + 1.5 * recording.time.array()).matrix().replicate(1, n);  // 30 degrees in 20 s
  recording.run_starts = {0};
  return recording;
}

runtime::EffectRecordings equations_of(const runtime::DescribedRobot& robot,
                                       const Recording& recording, bool remembers) {
  runtime::MotionOptions options;
  options.state.method = runtime::StateMethod::kRecorded;
  options.average_periods = false;
  const std::vector<bool> keep(static_cast<std::size_t>(robot.linear.joints()), remembers);
  return runtime::effect_recordings(robot.linear, runtime::effect_robot(robot),
                                    {runtime::motion_of(recording, options)}, {.decimation = 2},
                                    keep);
}

EffectInstance instance_of(const runtime::EffectLaw& law, const runtime::DescribedRobot& robot) {
  EffectInstance instance;
  instance.law = law;
  if (law.scope == EffectScope::kRobot) return instance;
  instance.joint = 1;
  instance.link = 2;
  if (law.scope == EffectScope::kPair) instance.other = 2;
  if (law.name == "contact") {
    instance.joint = robot.linear.joints() - 1;
    instance.link = robot.model.size();
  }
  return instance;
}

/// Of the noise of one recording of an effect: neither the motion's nor another effect's.
std::uint32_t noise_seed(const std::string& effect, unsigned seed) {
  std::vector<std::uint32_t> words(effect.begin(), effect.end());
  words.push_back(seed);
  std::seed_seq sequence(words.begin(), words.end());
  std::uint32_t result = 0;
  sequence.generate(&result, &result + 1);
  return result;
}

/// What the fit is told: numbers of what is given or scanned, nothing of the rest.
VectorXd told(const runtime::EffectLaw& law, const VectorXd& truth) {
  VectorXd parameters = truth;
  for (Index k = 0; k < parameters.size(); ++k) {
    const EffectRole role = law.parameters[static_cast<std::size_t>(k)].role;
    const bool estimated = role == EffectRole::kLinear || role == EffectRole::kShape;
    if (estimated) parameters[k] = std::numeric_limits<double>::quiet_NaN();
  }
  return parameters;
}

}  // namespace

double EffectRecovery::within(double deviations) const {
  const auto count =
      std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= deviations; });
  return errors.empty() ? 0 : static_cast<double>(count) / static_cast<double>(errors.size());
}

double EffectRecovery::worst() const {
  return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

runtime::DescribedRobot effect_study_robot() {
  return runtime::describe_robot(std::string(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot"),
                                 runtime::OpenParameters::kAsWritten);
}

EffectRecovery recover(const runtime::DescribedRobot& robot, const EffectFile& effect,
                       const EffectStudyPlan& plan) {
  EffectRecovery result;
  result.name = effect.name;
  const runtime::EffectLaw law = runtime::effect_law(effect);
  EffectInstance instance = instance_of(law, robot);
  const VectorXd beta = robot.grouping * robot.standard;
  for (int r = 0; r < plan.recordings; ++r) {
    const unsigned seed = plan.first_seed + static_cast<unsigned>(r);
    Recording recording = clean_recording(robot, plan, seed);
    const runtime::EffectScales scales =
        runtime::scales_of(equations_of(robot, recording, true), beta, instance.joint);
    const VectorXd truth = law.sizes(scales).typical;
    instance.parameters = truth;
    recording.tau = runtime::recorded_torque(robot, {instance}, recording);
    const VectorXd rms =
        recording.tau.colwise().norm() / std::sqrt(static_cast<double>(recording.samples()));
    runtime::TorqueNoise noise({.deviation = 0.01 * rms}, robot.linear.joints(),
                               noise_seed(effect.name, seed));
    for (Index k = 0; k < recording.samples(); ++k) recording.tau.row(k) += noise.next();

    EffectInstance asked = instance;
    asked.parameters = told(law, truth);
    ++result.recordings;
    try {
      const runtime::EffectFit fit =
          runtime::fit_effects(equations_of(robot, recording, !law.states.empty()), {asked});
      if (!fit.all_seen()) {
        ++result.unseen;
        continue;
      }
      result.not_converged += fit.converged ? 0 : 1;
      for (Index k = 0; k < truth.size(); ++k) {
        const runtime::EffectParameterFit& found = fit.parameters[0][static_cast<std::size_t>(k)];
        if (plan.each) {
          fmt::print("seed {:<3}{:<8} truth {:<14.6g} found {:<14.6g} +- {:<12.4g}{}{}\n", seed,
                     law.parameters[static_cast<std::size_t>(k)].name, truth[k], found.value,
                     found.stddev, found.held ? "held" : "", found.at_bound ? "at its bound" : "");
        }
        if (found.held || found.at_bound || found.stddev <= 0) continue;
        result.errors.push_back(std::abs(found.value - truth[k]) / found.stddev);
      }
    } catch (const std::exception& error) {
      result.failure = error.what();
      return result;
    }
  }
  return result;
}

}  // namespace dyngen::test

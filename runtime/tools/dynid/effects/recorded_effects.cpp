// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/recorded_effects.h"

#include <utility>

#include "runtime/effects/effect_recordings.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/recordings/spline.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The motion as effects see it; equations are not asked for.
EffectRecordings recordings_of(const DescribedRobot& robot, const Recording& motion) {
  EffectRun run;
  run.motion.sample_time = (motion.time[motion.samples() - 1] - motion.time[0]) /
                           static_cast<double>(std::max<Index>(1, motion.samples() - 1));
  run.motion.time = motion.time;
  run.motion.q = motion.q;
  run.motion.dq = motion.dq;
  run.motion.ddq = motion.ddq;
  run.motion.tau = motion.tau;
  run.motion.temperature = motion.temperature;
  run.time = motion.time.array() - motion.time[0];
  run.position_step = VectorXd::Zero(motion.joints());
  EffectRecordings recordings;
  recordings.model = robot.linear;
  recordings.robot = effect_robot(robot);
  recordings.runs.push_back(std::move(run));
  return recordings;
}

MatrixXd aligned(const EffectInstance& effect, const VectorXd& time, MatrixXd torque) {
  const double T = effect.parameters[effect.law.alignment_parameter];
  for (const int joint : joints_of(effect, static_cast<int>(torque.cols()))) {
    const VectorXd own = torque.col(joint);
    if (effect.law.alignment == AlignmentOperator::kDelay) {
      const VectorXd before = (time.array() - T).max(time[0]).min(time[time.size() - 1]);
      torque.col(joint) = interpolate_linear(time, own, before);
    } else {
      torque.col(joint) = own + T * differentiate_spline(time, own);
    }
  }
  return torque;
}

/// `torque` is what was given.
void read_torque(const EffectLaw& law, const VectorXd& given, MatrixXd& variables) {
  for (std::size_t v = 0; v < law.variables.size(); ++v) {
    if (law.variables[v] == "torque") variables.col(static_cast<Index>(v)) = given;
  }
}

}  // namespace

MatrixXd recorded_torque(const DescribedRobot& robot, const std::vector<EffectInstance>& effects,
                         const Recording& motion, TorqueOfGains gains) {
  const EffectRecordings recordings = recordings_of(robot, motion);
  EffectSignals signals(recordings);
  signals.set_beta(robot.grouping * robot.standard);
  MatrixXd torque = motion.tau;
  const double sample_time = recordings.runs.front().motion.sample_time;
  for (const EffectInstance& effect : effects) {
    if (effect.law.alignment != AlignmentOperator::kNone) continue;
    const std::vector<int> joints = joints_of(effect, motion.joints());
    const bool all = effect.law.acts_on_all;  // evaluated for each joint; else for all outputs
    for (const int target : all ? joints : std::vector<int>{joints.front()}) {
      MatrixXd variables = signals.variables(0, effect, target);
      if (gains == TorqueOfGains::kRecorded) {
        read_torque(effect.law, motion.tau.col(target), variables);
      }
      VectorXd state = first_states(effect.law, variables);
      const MatrixXd own =
          effect.law.evaluate(variables, effect.parameters, sample_time, state, {}).torque;
      for (Index o = 0; o < own.cols(); ++o) {
        torque.col(all ? target : joints[static_cast<std::size_t>(o)]) += own.col(o);
      }
    }
  }
  // what arrives late arrives with all the rest
  for (const EffectInstance& effect : effects) {
    if (effect.law.alignment != AlignmentOperator::kNone) {
      torque = aligned(effect, motion.time, std::move(torque));
    }
  }
  return torque;
}

}  // namespace dyngen::runtime

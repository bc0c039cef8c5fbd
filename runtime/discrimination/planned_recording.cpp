// SPDX-License-Identifier: MIT
#include "runtime/discrimination/planned_recording.h"

#include "runtime/diagnosis/equation_sets/left_out_rows.h"
#include "runtime/signals/decimation.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd instants(const PlannedMotion& motion, Index count) {
  return VectorXd::LinSpaced(count, 0, static_cast<double>(count - 1)) * motion.duration /
         static_cast<double>(count);
}

EffectRecordings planned_recording(const LinearModel& model, const EffectRobot& robot,
                                   const VectorXd& beta, const PlannedMotion& motion, Index samples,
                                   const VectorXd& still_speed) {
  EffectRun run;
  JointMotion joints = motion.at(instants(motion, samples));
  run.motion.sample_time = motion.duration / static_cast<double>(samples);
  run.motion.time = instants(motion, samples);
  run.time = run.motion.time;
  run.motion.q = std::move(joints.q);
  run.motion.dq = std::move(joints.dq);
  run.motion.ddq = std::move(joints.ddq);
  run.motion.tau = model.torque(run.motion.q, run.motion.dq, run.motion.ddq, beta);
  run.position_step = VectorXd::Zero(model.joints());
  run.decimator = design_decimator(1);
  model.regressor(run.motion.q, run.motion.dq, run.motion.ddq, run.rows.Y);
  run.rows.tau = run.motion.tau;
  if (model.held) {
    run.rows.tau -= model.held->torque(run.motion.q, run.motion.dq, run.motion.ddq, false);
  }
  run.rows.counted = MatrixXd::Ones(samples, model.joints());
  leave_out_standstill(run, still_speed);
  EffectRecordings data{model, robot, {}, run.motion.sample_time};
  data.runs.push_back(std::move(run));
  return data;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gen/model/chi.h"
#include "runtime/estimation/covariance.h"
#include "runtime/identification/summary.h"
#include "runtime/import/map_file.h"
#include "runtime/recordings/quantisation.h"
#include "runtime/signals/joint_state.h"
#include "runtime/tools/dynid/two_encoders/wind_up_samples.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostModelRows = 20000;  // of which the model's noise is taken: it is smooth

/// Whether the rotor of a joint is grouped with bodies.
bool rotor_is_grouped(const DescribedRobot& robot, int joint) {
  constexpr Index kPerLink = 14;
  Index link = -1;
  for (std::size_t i = 0; i < robot.model.joints.size(); ++i) {
    if (robot.model.joints[i].coordinate == joint) link = static_cast<Index>(i);
  }
  if (link < 0) return false;
  const Index column = kPerLink * link + static_cast<Index>(Chi::kIA);
  if (column >= robot.grouping.cols()) return false;
  for (const int place : load_places(robot.linear, joint)) {
    if (robot.grouping(place, column) != 0) return true;
  }
  return false;
}

/// The joint state of a recording at the cut-off that its source has.
JointStates states_of(const MotionSource& source, const ToolOptions& options) {
  JointStateOptions state = options.motion.state;
  if (source.cutoff.hz > 0) state.cutoff_hz = source.cutoff.hz;
  return joint_states(*source.recorded, state);
}

Index samples_of(const std::vector<MotionSource>& sources) {
  Index samples = 0;
  for (const MotionSource& source : sources) {
    if (source.recorded && source.recorded->q_link.size() > 0)
      samples += source.recorded->samples();
  }
  return samples;
}

/// A weighted fit of the rigid robot.
LoadModel fitted_load(const LinearModel& model, const std::vector<MotionSource>& sources,
                      const RowOptions& options) {
  RecordingSummary all = empty_summary(model.columns, model.size());
  std::vector<RowSource> rows;
  for (const MotionSource& source : sources) {
    merge(all, summarise_without_noise(model, source, options));
    rows.push_back(rows_of(model, source, options));
  }
  const Estimate fit = weighted_least_squares(all.equations);
  const NoiseFactor noise = noise_at(fit, all.equations, joined(std::move(rows)));
  return {fit.beta,
          correlated_covariance(all.equations, noise, fit.joint_weights, fit.scale, fit.unseen)};
}

/// Behind a low-pass below which links are rigid; a cut-off that was told stays.
std::vector<MotionSource> slow_enough(const std::vector<MotionSource>& sources) {
  std::vector<MotionSource> slow;
  for (const MotionSource& source : sources) {
    if (!source.others.at || !(source.cutoff.hz > kHighestLoadCutoff)) {
      slow.push_back(source);
      continue;
    }
    constexpr double kOwnTrim = -1;
    slow.push_back(source.others.at({kHighestLoadCutoff, "of rigid links"}, kOwnTrim));
    slow.back().recorded = source.recorded;
  }
  return slow;
}

/// Of both encoders of a joint, rad or m; 0: none was found.
double coarser_step(const std::vector<MotionSource>& sources, int joint) {
  double step = 0;
  for (const MotionSource& source : sources) {
    if (!source.recorded || !source.recorded->has_link(joint)) continue;
    for (const MatrixXd* positions : {&source.recorded->q, &source.recorded->q_link}) {
      step = std::max(step, find_quantisation(positions->col(joint)).step);
    }
  }
  return step;
}

}  // namespace

std::vector<int> joints_with_two_encoders(const std::vector<MotionSource>& sources) {
  std::vector<int> joints;
  for (const MotionSource& source : sources) {
    if (!source.recorded) continue;
    for (int j = 0; j < source.recorded->joints(); ++j) {
      if (!source.recorded->has_link(j)) continue;
      if (std::find(joints.begin(), joints.end(), j) == joints.end()) joints.push_back(j);
    }
  }
  std::sort(joints.begin(), joints.end());
  return joints;
}

std::vector<double> gears_of_map(const ToolOptions& options) {
  return options.map.empty() ? std::vector<double>() : read_import_map(options.map).gears;
}

TwoEncoders two_encoders_of(const DescribedRobot& robot, const std::optional<LoadModel>& given,
                            const std::vector<MotionSource>& all_sources,
                            const ToolOptions& options, const WindUpRules& rules,
                            ProgressLine& progress) {
  TwoEncoders answer;
  const std::vector<int> joints = joints_with_two_encoders(all_sources);
  if (joints.empty()) return answer;
  const LinearModel& model = robot.linear;
  progress.show("load of the gears", 0, 1);
  const std::vector<MotionSource> sources = slow_enough(all_sources);
  const LoadModel load = given ? *given : fitted_load(model, sources, options.rows);
  const Index stride = 1 + samples_of(sources) / kMostModelRows;
  WindUpSamples samples(model, load, joints, stride);
  for (const MotionSource& source : sources) {
    if (!source.recorded || source.recorded->q_link.size() == 0) continue;
    progress.show("wind-up of " + source.name, 0, 1);
    const JointStates states = states_of(source, options);
    if (states.stands || samples.add(*source.recorded, states)) continue;
    answer.remarks.push_back(fmt::format(
        "{} has another sample time than the recordings before it; its wind-up is left out.",
        source.name));
  }
  const std::vector<double> gears = gears_of_map(options);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    progress.show(fmt::format("wind-up of joint {}", joints[i] + 1), i, joints.size());
    WindUpData data = samples.data(i);
    data.revolute = model.revolute[static_cast<std::size_t>(joints[i])];
    data.position_step = coarser_step(sources, joints[i]);
    data.gear_ratio = of_joint(gears, static_cast<std::size_t>(joints[i]), 0);
    data.rotor_open = rotor_is_grouped(robot, joints[i]);
    answer.joints.push_back(analyse_wind_up(data, rules));
    answer.joints.back().joint = joints[i];
  }
  return answer;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "runtime/recordings/trajectory_file.h"
#include "runtime/tools/dynid/atlas/atlas_report.h"
#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/effect_report.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/page/page_output.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/robot/file_values.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kTrajectoryRate = 200;    // Hz: equations of a trajectory, at most
constexpr double kTrajectoryNoise = 0.01;  // of the largest torque

/// A motion as if it had been recorded with the model's torque.
MotionSource source_of(const Trajectory& trajectory, const LinearModel& model, const VectorXd& beta,
                       const std::string& name) {
  Recording recording;
  recording.file_name = name;
  recording.time = trajectory.time;
  recording.q = trajectory.q;
  recording.dq = trajectory.dq;
  recording.ddq = trajectory.ddq;
  recording.tau = model.torque(trajectory.q, trajectory.dq, trajectory.ddq, beta);
  recording.run_starts = {0};
  MotionOptions options;
  options.state.method = StateMethod::kRecorded;
  options.average_periods = false;
  MotionSource source = motion_of(std::move(recording), options);
  // a computed position has no encoder
  std::fill(source.condition.position_step.begin(), source.condition.position_step.end(), 0.0);
  return source;
}

VectorXd largest_torque(const EffectRecordings& data) {
  VectorXd largest = VectorXd::Zero(data.joints());
  for (const EffectRun& run : data.runs) {
    largest = largest.cwiseMax(run.motion.tau.cwiseAbs().colwise().maxCoeff().transpose());
  }
  return largest;
}

/// What the atlas is made of.
struct Motions {
  EffectRecordings data;
  VectorXd beta;
};

Motions of_trajectory(const ToolOptions& options, AtlasReport& report) {
  const LinearModel& model = report.robot.linear;
  const Trajectory trajectory = load_motion(options.atlas.trajectory, options.map, options.robot);
  if (trajectory.joints() != model.joints()) {
    throw std::invalid_argument(fmt::format("{}: {} joints, but {} has {} that move",
                                            options.atlas.trajectory, trajectory.joints(),
                                            model.name, model.joints()));
  }
  Motions motions;
  motions.beta = file_values(report.robot, options.robot,
                             "since a trajectory alone cannot say them: 'dynid fit' finds them, "
                             "or give recordings");
  const MotionSource source = source_of(trajectory, model, motions.beta, options.atlas.trajectory);
  RowOptions rows = options.rows;
  if (rows.decimation <= 0) {
    rows.decimation =
        std::max<Index>(1, static_cast<Index>(1 / (kTrajectoryRate * source.sample_time)));
  }
  motions.data = effect_recordings(model, effect_robot(report.robot), {source}, rows);
  report.motion = fmt::format("trajectory {}, {:.1f} s", options.atlas.trajectory,
                              trajectory.time[trajectory.samples() - 1] - trajectory.time[0]);
  return motions;
}

Motions of_recordings(const ToolOptions& options, ProgressLine& progress, AtlasReport& report) {
  const LinearModel& model = report.robot.linear;
  ToolOptions reading = options;
  reading.motion.stream_above = std::numeric_limits<std::size_t>::max();
  // effects of time and temperature are in the catalogue
  reading.motion.average_periods = false;
  const LoadedRecordings loaded = load_recordings(options.recordings, reading, false, progress);
  Motions motions;
  motions.data = effect_recordings(model, effect_robot(report.robot), loaded.sources, options.rows);
  const RowSource rows = [&](const std::function<void(const RowBlock&)>& visit) {
    for (const EffectRun& run : motions.data.runs) visit(run.rows);
  };
  motions.beta = weighted_least_squares(factor_of(rows, model.columns, model.size())).beta;
  double seconds = 0;
  for (const RecordingLine& line : loaded.lines) seconds += line.seconds;
  report.motion = fmt::format("{} recording{}, {:.1f} s", loaded.sources.size(),
                              loaded.sources.size() == 1 ? "" : "s", seconds);
  return motions;
}

AtlasNoise noise_of(const ToolOptions& options, const Motions& motions, AtlasReport& report) {
  const int n = motions.data.joints();
  const std::vector<double>& given = options.atlas.noise;
  if (!given.empty()) {
    if (static_cast<int>(given.size()) != n) {
      throw std::invalid_argument(
          fmt::format("--noise: {} numbers, expected {}, one of each joint", given.size(), n));
    }
    report.noise_from = "white, as told";
    return white_noise(Eigen::Map<const VectorXd>(given.data(), n));
  }
  if (options.atlas.trajectory.empty()) {
    report.noise_from =
        "what the fit of the model leaves of the recorded torque, with its autocorrelation";
    return residual_noise(motions.data, motions.beta);
  }
  report.noise_from = "white, 1 % of the largest torque of each joint (--noise says it better)";
  const VectorXd deviation = kTrajectoryNoise * largest_torque(motions.data);
  for (Index j = 0; j < n; ++j) {
    if (deviation[j] > 0) continue;
    throw std::invalid_argument(
        fmt::format("the torque of joint {} is 0 on this trajectory: expected --noise", j + 1));
  }
  return white_noise(deviation);
}

std::vector<std::size_t> sorted(const AtlasReport& report) {
  std::vector<std::size_t> order(report.atlas.entries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const AtlasEntry &first = report.atlas.entries[a], &second = report.atlas.entries[b];
    if (first.effect.link != second.effect.link) return first.effect.link < second.effect.link;
    // what has no numbers comes last
    const double x = first.missing.empty() ? first.absorbed : -1;
    const double y = second.missing.empty() ? second.absorbed : -1;
    return x > y;
  });
  return order;
}

}  // namespace

int run_atlas(const ToolOptions& options) {
  ProgressLine progress("dynid");
  AtlasReport report;
  const EffectCatalogue catalogue = effect_catalogue(options.effects);
  report.robot = describe_robot(options.robot, OpenParameters::kAbsentRows);
  refuse_without_parameters(report.robot);
  Motions motions = options.atlas.trajectory.empty() ? of_recordings(options, progress, report)
                                                     : of_trajectory(options, report);
  const AtlasNoise noise = noise_of(options, motions, report);
  report.noise.resize(motions.data.joints());
  for (Index j = 0; j < report.noise.size(); ++j) {
    report.noise[j] = noise.joints[static_cast<std::size_t>(j)].deviation;
  }
  report.equations = motions.data.equations();
  report.row_time = motions.data.row_time;
  const Eigen::MatrixXd& q = motions.data.runs.front().motion.q;
  report.posture = q.row(q.rows() / 2);
  report.atlas =
      absorption_atlas(motions.data, motions.beta, noise, possible_effects(report.robot, catalogue),
                       [&](const std::string& effect, std::size_t place, std::size_t count) {
                         progress.show(effect, place, count);
                       });
  std::vector<EffectInstance> effects;
  for (const AtlasEntry& entry : report.atlas.entries) effects.push_back(entry.effect);
  const auto units = effect_units(effects, catalogue, report.robot.linear);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const int parameter = report.atlas.entries[i].parameter;
    report.units.push_back(parameter < 0 ? "" : units[i][static_cast<std::size_t>(parameter)]);
  }
  report.order = sorted(report);
  progress.clear();
  std::vector<OutputFile> files;
  if (!options.json.empty()) files.push_back({options.json, atlas_json(report)});
  const std::vector<std::string> made = write_with_page(
      options.page, [&] { return atlas_document(report, options.page.command); }, progress,
      std::move(files));
  if (!options.atlas.picture.empty()) draw(atlas_picture(report), options.atlas.picture);
  std::cout << atlas_table(report);
  tell_written(made);
  return kDone;
}

}  // namespace dyngen::runtime

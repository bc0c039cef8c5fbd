// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// All pieces of a run as one motion.
std::vector<Motion> runs_of(const MotionSource& source) {
  std::vector<Motion> runs;
  source.pieces([&](const StreamPiece& piece) {
    if (piece.continues_run) {
      throw std::invalid_argument(fmt::format(
          "{}: it is too large to be in memory at once, and effects need whole runs: split it",
          source.name));
    }
    runs.push_back(piece.motion);
  });
  return runs;
}

/// One below the other.
MatrixXd stacked(const std::vector<RowBlock>& blocks, MatrixXd RowBlock::*part) {
  Index rows = 0;
  for (const RowBlock& block : blocks) rows += (block.*part).rows();
  MatrixXd all(rows, blocks.empty() ? 0 : (blocks.front().*part).cols());
  Index start = 0;
  for (const RowBlock& block : blocks) {
    all.middleRows(start, (block.*part).rows()) = block.*part;
    start += (block.*part).rows();
  }
  return all;
}

/// All rows of one run in one block; counted has a value for each equation.
RowBlock rows_of_run(const LinearModel& model, const MotionSource& recording, const Motion& motion,
                     const RowPlan& plan) {
  MotionSource run = recording;
  run.pieces = [&](const std::function<void(const StreamPiece&)>& visit) {
    StreamPiece piece{motion, false};
    if (motion.tau.size() == 0) piece.motion.tau = MatrixXd::Zero(motion.samples(), model.joints());
    visit(piece);
  };
  std::vector<RowBlock> blocks;
  planned_rows(model, run, plan)([&](const RowBlock& block) {
    blocks.push_back(block);
    MatrixXd& counted = blocks.back().counted;
    if (counted.size() == 0) counted = MatrixXd::Ones(block.tau.rows(), block.tau.cols());
  });
  RowBlock all;
  for (MatrixXd RowBlock::*part : {&RowBlock::Y, &RowBlock::tau, &RowBlock::counted}) {
    all.*part = stacked(blocks, part);
  }
  return all;
}

double value_of(const LinearModel& model, const VectorXd& beta, int joint, ParameterKind kind) {
  return std::max(0.0, parameter_value(model, beta, joint, kind));
}

/// The speed that 90 % of the samples are below.
double ninth_decile(const EffectRecordings& data, int joint) {
  std::vector<double> speeds;
  for (const EffectRun& run : data.runs) {
    const auto dq = run.motion.dq.col(joint);
    for (const double v : dq) speeds.push_back(std::abs(v));
  }
  const auto place =
      speeds.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), place, speeds.end());
  return *place;
}

std::string names_of(const std::vector<MotionSource>& sources) {
  std::string names;
  for (const MotionSource& source : sources) names += (names.empty() ? "" : ", ") + source.name;
  return names;
}

EffectScales larger(const EffectScales& a, const EffectScales& b) {
  EffectScales most;
  for (double EffectScales::*scale :
       {&EffectScales::Fc, &EffectScales::Fv, &EffectScales::Ia, &EffectScales::v_max,
        &EffectScales::v90, &EffectScales::q_range, &EffectScales::tau_max, &EffectScales::duration,
        &EffectScales::position_step}) {
    most.*scale = std::max(a.*scale, b.*scale);
  }
  return most;
}

}  // namespace

Index EffectRecordings::equations() const {
  Index count = 0;
  for (const EffectRun& run : runs) count += run.rows.Y.rows();
  return count;
}

EffectRecordings effect_recordings(LinearModel model, EffectRobot robot,
                                   const std::vector<MotionSource>& sources,
                                   const RowOptions& options,
                                   const std::vector<bool>& remembering) {
  EffectRecordings data{std::move(model), std::move(robot), {}, 0};
  double longest = 0, filter = 0;  // s
  for (std::size_t place = 0; place < sources.size(); ++place) {
    const MotionSource& source = sources[place];
    if (source.joints() != data.joints()) {
      throw std::invalid_argument(fmt::format("{}: {} joints, but {} has {} that move", source.name,
                                              source.joints(), data.model.name, data.joints()));
    }
    RowPlan plan = plan_rows(source, options);
    for (Index j = 0; j < plan.still_speed.size() && options.still_speed < 0; ++j) {
      if (!std::isfinite(plan.still_speed[j])) continue;
      if (remembering.empty() || remembering[static_cast<std::size_t>(j)]) plan.still_speed[j] = -1;
    }
    const Decimator decimator = design_decimator(plan.decimation, plan.filter);
    for (Motion& motion : runs_of(source)) {
      EffectRun run;
      run.recording = static_cast<int>(place);
      run.motion = std::move(motion);
      run.time = run.motion.time.array() - source.start;
      run.position_step = VectorXd::Zero(source.joints());
      for (std::size_t j = 0; j < source.condition.position_step.size(); ++j) {
        run.position_step[static_cast<Index>(j)] = source.condition.position_step[j];
      }
      run.decimator = decimator;
      longest = std::max(longest, run.motion.sample_time * static_cast<double>(run.time.size()));
      filter = run.motion.sample_time * static_cast<double>(decimator.taps.size());
      if (decimated_samples(decimator, run.motion.samples()) == 0) continue;
      run.rows = rows_of_run(data.model, source, run.motion, plan);
      const double count = static_cast<double>(run.rows.Y.rows());
      data.row_time += count * run.motion.sample_time * static_cast<double>(decimator.factor);
      data.runs.push_back(std::move(run));
    }
  }
  if (data.runs.empty()) {
    throw TooLittleDataError(
        fmt::format("No run{} is longer than the parallel filter: the longest has {:.3g} s, the "
                    "filter {:.3g} s.",
                    sources.empty() ? "" : " of " + names_of(sources), longest, filter));
  }
  data.row_time /= static_cast<double>(data.equations());
  return data;
}

int parameter_of(const LinearModel& model, int joint, ParameterKind kind) {
  for (const int c : model.columns[static_cast<std::size_t>(joint)]) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(c)];
    if (parameter.kind != kind) continue;
    // friction and rotors act on one joint; which one, the columns of the others say
    bool own = true;
    for (int i = 0; i < model.joints(); ++i) {
      const auto& columns = model.columns[static_cast<std::size_t>(i)];
      own = own && (i == joint || !std::binary_search(columns.begin(), columns.end(), c));
    }
    if (own) return c;
  }
  return -1;
}

double parameter_value(const LinearModel& model, const VectorXd& beta, int joint,
                       ParameterKind kind) {
  const int place = parameter_of(model, joint, kind);
  if (place >= 0) return beta[place];
  return model.held ? model.held->of(kind, joint) : 0;
}

EffectScales scales_of(const EffectRecordings& data, const VectorXd& beta, int joint) {
  if (joint < 0) {
    EffectScales most;
    for (int j = 0; j < data.joints(); ++j) most = larger(most, scales_of(data, beta, j));
    return most;
  }
  EffectScales scales;
  scales.Fc = value_of(data.model, beta, joint, ParameterKind::kCoulomb);
  scales.Fv = value_of(data.model, beta, joint, ParameterKind::kViscous);
  scales.Ia = value_of(data.model, beta, joint, ParameterKind::kRotorInertia);
  double coldest = std::numeric_limits<double>::infinity(), warmest = -coldest;
  double lowest = data.runs.front().motion.q(0, joint), highest = lowest;
  for (const EffectRun& run : data.runs) {
    const Motion& motion = run.motion;
    scales.v_max = std::max(scales.v_max, motion.dq.col(joint).cwiseAbs().maxCoeff());
    lowest = std::min(lowest, motion.q.col(joint).minCoeff());
    highest = std::max(highest, motion.q.col(joint).maxCoeff());
    const auto torque =
        motion.tau.size() > 0 ? motion.tau.col(joint).eval() : VectorXd::Zero(1).eval();
    scales.tau_max = std::max(scales.tau_max, torque.cwiseAbs().maxCoeff());
    scales.duration = std::max(scales.duration, run.time[run.time.size() - 1]);
    if (motion.temperature.size() > 0) {
      coldest = std::min(coldest, motion.temperature.col(joint).minCoeff());
      warmest = std::max(warmest, motion.temperature.col(joint).maxCoeff());
    }
    scales.position_step = std::max(scales.position_step, run.position_step[joint]);
  }
  scales.temp_range = std::max(0.0, warmest - coldest);
  scales.q_range = highest - lowest;
  scales.v90 = ninth_decile(data, joint);
  return scales;
}

}  // namespace dyngen::runtime

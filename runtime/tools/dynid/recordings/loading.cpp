// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/recordings/loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "runtime/identification/common_cutoff.h"
#include "runtime/tools/dynid/recordings/inputs.h"

namespace dyngen::runtime {

ToldRepairs::~ToldRepairs() {
  for (const Notice& notice : notices) std::cerr << notice.text() << "\n";
}

Trajectory load_motion(const std::string& path, const std::string& map, const RobotSource& robot) {
  ToldRepairs repairs;
  const RecordingInput input = motion_input(path, map, robot, repairs.notices);
  return read_trajectory(input, &repairs.notices);
}

OpenParameters opened_by(const ToolOptions& options) {
  return options.consistent ? OpenParameters::kEverything : OpenParameters::kAbsentRows;
}

RecordingLine describe(const MotionSource& source, const ToolOptions& options, bool heldout) {
  const RowPlan plan = plan_rows(source, options.rows);
  RecordingLine line;
  line.name = source.name;
  line.heldout = heldout;
  line.cutoff = source.cutoff.hz;
  line.cutoff_reason = source.cutoff.message;
  line.decimation = plan.decimation;
  line.row_time = plan.row_time;
  line.condition = source.condition;
  source.pieces([&](const StreamPiece& piece) {
    line.seconds += static_cast<double>(piece.motion.samples()) * piece.motion.sample_time;
  });
  return line;
}

LoadedRecordings load_recordings(const std::vector<std::string>& paths, const ToolOptions& options,
                                 bool heldout, ProgressLine& progress) {
  return load_recordings(recording_inputs(paths, options), options, heldout, progress);
}

LoadedRecordings load_recordings(const std::vector<RecordingInput>& inputs,
                                 const ToolOptions& options, bool heldout, ProgressLine& progress) {
  LoadedRecordings loaded;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    progress.show("reading " + inputs[i].name, i, inputs.size());
    ToldRepairs repairs;
    try {
      loaded.sources.push_back(motion_of_input(inputs[i], options.motion, &repairs.notices));
    } catch (const TooLittleDataError& error) {
      loaded.left_out.emplace_back(error.what());
      continue;
    }
    loaded.lines.push_back(describe(loaded.sources.back(), options, heldout));
  }
  if (!heldout && loaded.sources.empty() && !loaded.left_out.empty()) {
    throw TooLittleDataError(fmt::format("{}", fmt::join(loaded.left_out, "\n")));
  }
  for (const std::string& reason : loaded.left_out) {
    std::cerr << reason << "; it adds no equations\n";
  }
  return loaded;
}

namespace {

void use_cutoff(const Cutoff& cutoff, LoadedRecordings& loaded, const ToolOptions& options) {
  loaded.sources = at_cutoff(loaded.sources, cutoff);
  for (std::size_t i = 0; i < loaded.sources.size(); ++i) {
    loaded.lines[i] = describe(loaded.sources[i], options, loaded.lines[i].heldout);
  }
}

}  // namespace

void settle_cutoff(const LinearModel* model, LoadedRecordings& fitted, LoadedRecordings& heldout,
                   const ToolOptions& options, ProgressLine& progress) {
  progress.show("cut-off", 0, 1);
  const Cutoff cutoff =
      model != nullptr ? common_cutoff(*model, fitted.sources) : median_cutoff(fitted.sources);
  if (cutoff.hz == 0) return;
  use_cutoff(cutoff, fitted, options);
  use_cutoff(cutoff, heldout, options);
}

std::vector<RowSource> rows_of_all(const LinearModel& model,
                                   const std::vector<MotionSource>& sources,
                                   const ToolOptions& options) {
  std::vector<RowSource> rows;
  for (const MotionSource& source : sources) rows.push_back(rows_of(model, source, options.rows));
  return rows;
}

Eigen::VectorXd equations_of(const TorqueFactor& factor) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(factor.joints.size()));
  for (Eigen::Index j = 0; j < rows.size(); ++j) {
    rows[j] = factor.joints[static_cast<std::size_t>(j)].rows;
  }
  return rows;
}

std::string why_no_equations(const RecordingLine& line, const RowOptions& rows) {
  if (line.equations.size() == 0 || line.equations.sum() > 0) return {};
  const std::string begin = line.name + ": no equations: ";
  const RecordingCondition& condition = line.condition;
  const bool dead = !condition.torque_dead.empty() &&
                    std::all_of(condition.torque_dead.begin(), condition.torque_dead.end(),
                                [](bool joint) { return joint; });
  if (dead) return begin + "no torque was measured (each joint's is one number throughout)";
  if (condition.stands && rows.still_speed != 0) {
    return begin + "no joint moves; '--still 0' fits gravity to poses that are held";
  }
  if (rows.still_speed > 0) {
    return begin + fmt::format("no joint is as fast as '--still {:.4g}' asks", rows.still_speed);
  }
  return begin + fmt::format(
                     "no run is as long as the parallel filter of one equation every {:.3g} ms "
                     "('--decimation 1' does without it)",
                     1e3 * line.row_time);
}

RecordingSummary summarise_together(const LinearModel& model, LoadedRecordings& loaded,
                                    const ToolOptions& options, ProgressLine& progress) {
  RecordingSummary all = empty_summary(model.columns, model.size());
  const std::vector<MotionSource>& sources = loaded.sources;
  const std::vector<RowSource> rows = rows_of_all(model, sources, options);
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    progress.show("equations of " + sources[i].name, i, sources.size());
    const RecordingSummary own = summarise_without_noise(model, sources[i], options.rows);
    loaded.lines[i].equations = equations_of(own.equations);
    const std::string reason = why_no_equations(loaded.lines[i], options.rows);
    if (!reason.empty()) reasons.push_back(reason);
    merge(all, own);
  }
  if (all.equations.samples() == 0) {
    throw TooLittleDataError(fmt::format("{}", fmt::join(reasons, "\n")));
  }
  loaded.left_out.insert(loaded.left_out.end(), reasons.begin(), reasons.end());
  for (const std::string& reason : reasons) std::cerr << reason << "\n";
  progress.show("noise", 0, 1);
  const Estimate fit = weighted_least_squares(all.equations);
  all.noise = noise_at(fit, all.equations, joined(rows));
  return all;
}

TorqueFactor heldout_equations(const LinearModel& model, LoadedRecordings& loaded,
                               const ToolOptions& options) {
  TorqueFactor all = empty_factor(model.columns, model.size());
  for (std::size_t i = 0; i < loaded.sources.size(); ++i) {
    const TorqueFactor own =
        factor_of(rows_of(model, loaded.sources[i], options.rows), model.columns, model.size());
    loaded.lines[i].equations = equations_of(own);
    const std::string reason = why_no_equations(loaded.lines[i], options.rows);
    if (!reason.empty()) {
      loaded.left_out.push_back(reason);
      std::cerr << reason << "\n";
    }
    merge(all, own);
  }
  return all;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/recordings/loading.h"

#include <fmt/format.h>

#include <iostream>

namespace dyngen::runtime {
namespace {

/// Prints repairs when it goes: also where the recording is refused then.
struct PrintedAtEnd {
  explicit PrintedAtEnd(const std::vector<Notice>& notices) : repairs(notices) {}
  ~PrintedAtEnd() {
    for (const Notice& notice : repairs) std::cerr << notice.text() << "\n";
  }
  PrintedAtEnd(const PrintedAtEnd&) = delete;
  PrintedAtEnd& operator=(const PrintedAtEnd&) = delete;
  const std::vector<Notice>& repairs;
};

}  // namespace

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
  LoadedRecordings loaded;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    progress.show("reading " + paths[i], i, paths.size());
    std::vector<Notice> repairs;
    const PrintedAtEnd printed{repairs};
    loaded.sources.push_back(motion_of_file(paths[i], options.motion, &repairs));
    loaded.lines.push_back(describe(loaded.sources.back(), options, heldout));
  }
  return loaded;
}

std::vector<RowSource> rows_of_all(const LinearModel& model,
                                   const std::vector<MotionSource>& sources,
                                   const ToolOptions& options) {
  std::vector<RowSource> rows;
  for (const MotionSource& source : sources) rows.push_back(rows_of(model, source, options.rows));
  return rows;
}

RecordingSummary summarise_together(const LinearModel& model,
                                    const std::vector<MotionSource>& sources,
                                    const ToolOptions& options, ProgressLine& progress) {
  RecordingSummary all = empty_summary(model.columns, model.size());
  const std::vector<RowSource> rows = rows_of_all(model, sources, options);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    progress.show("equations of " + sources[i].name, i, sources.size());
    merge(all, summarise_without_noise(model, sources[i], options.rows));
  }
  progress.show("noise", 0, 1);
  const Estimate fit = weighted_least_squares(all.equations);
  all.noise = noise_at(fit, all.equations, joined(rows));
  return all;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/torque_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "runtime/report/thinning.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostRuns = 4;   // of fitted, and of held-out recordings
constexpr Index kMostValues = 240000;  // that are drawn of all signals
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Equations of consecutive samples.
struct Run {
  std::string name;
  MatrixXd tau, left;  ///< (N x n) NaN where an equation is left out
};

MatrixXd stacked(const std::vector<MatrixXd>& blocks) {
  Index rows = 0;
  for (const MatrixXd& block : blocks) rows += block.rows();
  MatrixXd all(rows, blocks.front().cols());
  Index at = 0;
  for (const MatrixXd& block : blocks) {
    all.middleRows(at, block.rows()) = block;
    at += block.rows();
  }
  return all;
}

/// The first runs of a source.
std::vector<Run> runs_of(const RowSource& rows, const VectorXd& beta, const std::string& name) {
  std::vector<std::vector<MatrixXd>> tau, left;  // [run][block]
  rows([&](const RowBlock& block) {
    if (block.tau.rows() == 0) return;
    if (!block.continues_run || tau.empty()) {
      tau.emplace_back();
      left.emplace_back();
    }
    if (tau.size() > kMostRuns) return;
    const MatrixXd remains = residual(block, beta);
    const auto kept = [&](const MatrixXd& values) -> MatrixXd {
      if (block.counted.size() == 0) return values;
      return (block.counted.array() > 0).select(values, kNothing);
    };
    tau.back().push_back(kept(block.tau));
    left.back().push_back(kept(remains));
  });
  std::vector<Run> runs;
  for (std::size_t i = 0; i < std::min(tau.size(), kMostRuns); ++i) {
    runs.push_back({fmt::format("{} {}", name, i + 1), stacked(tau[i]), stacked(left[i])});
  }
  return runs;
}

/// Names of recordings where each is one run.
void name_runs(std::vector<Run>& runs, const std::vector<RecordingLine>& lines, bool heldout) {
  std::vector<std::string> names;
  for (const RecordingLine& line : lines) {
    if (line.heldout == heldout) names.push_back(line.name);
  }
  if (names.size() < runs.size() || (names.size() > runs.size() && runs.size() < kMostRuns)) return;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].name = names[i] + (heldout ? " (held out)" : "");
  }
}

}  // namespace

std::vector<ReportChart> torque_charts(const FitReport& report) {
  const LinearModel& model = report.robot.linear;
  const VectorXd& beta = report.main().estimate.beta;
  std::vector<Run> runs;
  if (report.heldout_rows) {
    runs = runs_of(report.heldout_rows, beta, "held-out run");
    name_runs(runs, report.recordings, true);
  }
  if (report.data.rows) {
    std::vector<Run> fitted = runs_of(report.data.rows, beta, "fitted run");
    name_runs(fitted, report.recordings, false);
    for (Run& run : fitted) runs.push_back(std::move(run));
  }
  std::vector<ReportChart> charts;
  if (runs.empty()) return charts;
  const Index slices =
      std::max<Index>(50, kMostValues / (6 * model.joints() * static_cast<Index>(runs.size())));
  const double row_time = report.data.summary.row_time;
  for (int j = 0; j < model.joints(); ++j) {
    ReportChart chart;
    chart.id = fmt::format("torque-joint-{}", j + 1);
    chart.title = fmt::format("Torque of joint {}", j + 1);
    chart.caption =
        "Behind the filters of the fit. A gap: the joint stood still, and gave no equation. Drag "
        "to "
        "zoom; each slice of time keeps its least and largest value.";
    for (const Run& run : runs) {
      const Index rows = run.tau.rows();
      MatrixXd signals(rows, 3);
      signals << run.tau.col(j), run.tau.col(j) - run.left.col(j), run.left.col(j);
      const ThinnedSignals thin = thinned_signals(
          VectorXd::LinSpaced(rows, 0,
                              static_cast<double>(std::max<Index>(rows - 1, 1)) * row_time),
          signals, slices);
      ReportPanel torque, left;
      torque.x = left.x = thin.x;
      torque.x_label = left.x_label = "time [s]";
      torque.y_label = fmt::format("torque [{}]", torque_unit(model, j));
      left.y_label = fmt::format("residual [{}]", torque_unit(model, j));
      torque.series = {{"recorded", Role::kData, thin.y.col(0), {}, {}, false, false},
                       {"model", Role::kModel, thin.y.col(1), {}, {}, false, false}};
      left.series = {{"recorded less model", Role::kAfter, thin.y.col(2), {}, {}, false, false}};
      chart.views.push_back({run.name, {std::move(torque), std::move(left)}});
    }
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace dyngen::runtime

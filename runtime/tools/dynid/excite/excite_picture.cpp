// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_picture.h"

#include <fmt/format.h>

#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Panel panel_of(const std::string& title, const LinearModel& model, const VectorXd& time,
               const MatrixXd& values, const VectorXd& limits) {
  Panel panel;
  panel.title = title;
  panel.x_label = "time [s]";
  panel.y_label = "share of the limit";
  for (Index j = 0; j < values.cols(); ++j) {
    if (!std::isfinite(limits[j])) continue;
    Series series;
    series.name = model.joint_names[static_cast<std::size_t>(j)];
    series.x = time;
    series.y = values.col(j) / limits[j];
    panel.series.push_back(std::move(series));
  }
  panel.levels = {-1, 1};
  return panel;
}

}  // namespace

Figure motion_picture(const LinearModel& model, const MotionLimits& limits,
                      const Trajectory& trajectory, Index rows, const std::string& title) {
  const VectorXd time = trajectory.time.head(rows);
  const VectorXd half = 0.5 * (limits.upper - limits.lower);
  const VectorXd middle = 0.5 * (limits.upper + limits.lower);
  const MatrixXd q = trajectory.q.topRows(rows);
  const MatrixXd dq = trajectory.dq.topRows(rows);
  const MatrixXd ddq = trajectory.ddq.topRows(rows);
  Figure figure;
  figure.title = title;
  figure.panels = {panel_of("position", model, time, q.rowwise() - middle.transpose(), half),
                   panel_of("speed", model, time, dq, limits.speed),
                   panel_of("acceleration", model, time, ddq, limits.acceleration)};
  if (limits.limits_torque()) {
    figure.panels.push_back(
        panel_of("torque", model, time, model.torque(q, dq, ddq, limits.beta), limits.torque));
  }
  std::erase_if(figure.panels, [](const Panel& panel) { return panel.series.empty(); });
  return figure;
}

Figure picture_of(const ExciteReport& report) {
  const LinearModel& model = report.robot.linear;
  const Index rows = report.repeats ? Index{report.samples} + 1 : report.trajectory.samples();
  return motion_picture(
      model, report.limits, report.trajectory, rows,
      fmt::format("{}: condition number {:.1f}", model.name, report.worth.condition));
}

}  // namespace dyngen::runtime

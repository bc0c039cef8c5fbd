// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/motion_charts.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "runtime/report/thinning.h"
#include "runtime/tools/dynid/page/arm_drawing.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kSlices = 600;    // of a signal: two values each
constexpr double kNearly = 0.95;  // of a limit

/// A quantity of all joints over time, and between what it has to stay.
struct ChartQuantity {
  const char* name;
  const char *of_revolute, *of_prismatic;  ///< units
  const MatrixXd& values;
  VectorXd lower, upper;  ///< infinite: not limited
};

ReportView view_of(const ChartQuantity& own, const VectorXd& time, const LinearModel& model) {
  const ThinnedSignals thin = thinned_signals(time, own.values, kSlices);
  ReportView view{own.name, {}};
  for (Index j = 0; j < own.values.cols(); ++j) {
    ReportPanel panel;
    panel.x = thin.x;
    panel.x_label = "time [s]";
    panel.y_label = fmt::format(
        "{} [{}]", joint_words(static_cast<int>(j)),
        model.revolute[static_cast<std::size_t>(j)] ? own.of_revolute : own.of_prismatic);
    panel.series.push_back({own.name, Role::kAfter, thin.y.col(j), {}, {}, false, false});
    for (const double limit : {own.lower[j], own.upper[j]}) {
      if (!std::isfinite(limit)) continue;
      panel.series.push_back({panel.series.size() == 1 ? "limit" : "",
                              Role::kBefore,
                              VectorXd::Constant(thin.x.size(), limit),
                              {},
                              {},
                              true,
                              false});
    }
    view.panels.push_back(std::move(panel));
  }
  return view;
}

}  // namespace

ReportChart motion_chart(const LinearModel& model, const MotionLimits& limits,
                         const Trajectory& trajectory, Index rows) {
  const VectorXd time = trajectory.time.head(rows);
  const MatrixXd q = trajectory.q.topRows(rows), dq = trajectory.dq.topRows(rows),
                 ddq = trajectory.ddq.topRows(rows);
  ReportChart chart;
  chart.id = "motion";
  chart.title = "The motion";
  chart.caption = "Dashed: what the robot file allows. Drag to zoom.";
  chart.choice = "show";
  chart.views = {
      view_of({"position", "rad", "m", q, limits.lower, limits.upper}, time, model),
      view_of({"speed", "rad/s", "m/s", dq, -limits.speed, limits.speed}, time, model),
      view_of({"acceleration", "rad/s^2", "m/s^2", ddq, -limits.acceleration, limits.acceleration},
              time, model)};
  if (limits.limits_torque()) {
    const MatrixXd tau = model.torque(q, dq, ddq, limits.beta);
    chart.views.push_back(
        view_of({"torque", "N m", "N", tau, -limits.torque, limits.torque}, time, model));
  }
  return chart;
}

ReportBars limit_bars(const LinearModel& model, const MotionLimits& limits,
                      const LimitShares& shares) {
  const auto share = [](double value, double limit) {
    return std::isfinite(limit) ? value : std::numeric_limits<double>::quiet_NaN();
  };
  ReportBars bars;
  bars.id = "limits";
  bars.title = "Largest share of each limit";
  bars.caption = "1 is the limit. Joints that come to 95 % of one are marked.";
  for (int j = 0; j < model.joints(); ++j) {
    ReportBarGroup group{joint_words(j), "of the limit", false, {}};
    group.bars = {
        {"position", Role::kForward, shares.position[j]},
        {"speed", Role::kBackward, share(shares.speed[j], limits.speed[j])},
        {"acceleration", Role::kBefore, share(shares.acceleration[j], limits.acceleration[j])}};
    if (limits.limits_torque()) {
      group.bars.push_back({"torque", Role::kModel, share(shares.torque[j], limits.torque[j])});
    }
    for (const ReportBar& bar : group.bars) group.marked = group.marked || bar.value >= kNearly;
    bars.groups.push_back(std::move(group));
  }
  return bars;
}

ReportArm motion_arm(const DescribedRobot& robot, const Trajectory& trajectory) {
  return arm_drawing(robot.model, trajectory.q.row(trajectory.samples() / 2).transpose(), {});
}

}  // namespace dyngen::runtime

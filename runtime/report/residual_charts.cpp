// SPDX-License-Identifier: MIT
#include "runtime/report/residual_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/report/robust_range.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

const char* way_words(int direction) {
  if (direction == 0) return "";
  return direction > 0 ? ", forward" : ", backward";
}

Role way_role(int direction, Role both) {
  if (direction == 0) return both;
  return direction > 0 ? Role::kForward : Role::kBackward;
}

/// The drawn samples that move one way.
ReportCloud cloud_of(const CoordinateView& over, const VectorXd& y,
                     const Eigen::VectorXi& direction, int way, Role role) {
  ReportCloud cloud;
  cloud.role = role;
  std::vector<double> xs, ys;
  for (Index i = 0; i < y.size(); ++i) {
    if ((way != 0 && direction[i] != way) || !std::isfinite(y[i])) continue;
    xs.push_back(over.cloud_x[i]);
    ys.push_back(y[i]);
  }
  cloud.x = Eigen::Map<const VectorXd>(xs.data(), static_cast<Index>(xs.size()));
  cloud.y = Eigen::Map<const VectorXd>(ys.data(), static_cast<Index>(ys.size()));
  return cloud;
}

/// A chart with a view for each variable, the wanted one first.
template <class PanelOf>
ReportChart over_variables(const ResidualView& view, std::size_t first, const AxisLabel& label,
                           const std::string& y_label, const PanelOf& panel_of) {
  ReportChart chart;
  std::vector<const CoordinateView*> order;
  if (first < view.over.size()) order.push_back(&view.over[first]);
  for (std::size_t i = 0; i < view.over.size(); ++i) {
    if (i != first) order.push_back(&view.over[i]);
  }
  for (const CoordinateView* over : order) {
    ReportPanel panel = panel_of(*over);
    panel.x = over->x;
    panel.x_label = label(over->variable);
    panel.y_label = y_label;
    chart.views.push_back({over->variable, {std::move(panel)}});
  }
  return chart;
}

bool has_values(const VectorXd& y) {
  return std::any_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

ReportChart where_chart(const ResidualView& view, const EffectLocation& where,
                        const AxisLabel& label, const std::string& unit, const std::string& id) {
  RobustRange range;
  range.add(view.left);
  range.settle();
  const VectorXd drawn = range.without_outside(view.left);
  const auto panel_of = [&](const CoordinateView& over) {
    ReportPanel panel;
    for (const DirectionView& own : over.directions) {
      const Role role = way_role(own.direction, Role::kBefore);
      panel.clouds.push_back(cloud_of(over, drawn, view.direction, own.direction, role));
      panel.series.push_back(
          {fmt::format("left by the model alone, mean{}", way_words(own.direction)), role, own.left,
           own.left_low, own.left_high, false, true});
      if (!has_values(own.explained) || own.explained.cwiseAbs().maxCoeff() == 0) continue;
      panel.series.push_back(
          {fmt::format("explained by what was found{}", way_words(own.direction)),
           Role::kModel,
           own.explained,
           {},
           {},
           own.direction < 0,
           false});
    }
    if (over.variable == where.variable && where.to > where.from && !where.spread) {
      panel.spans.push_back(
          {where.from, where.to, fmt::format("{:.0f} % of what is left", 100 * where.share)});
    }
    if (over.variable == "t" && std::isfinite(where.t_from) && std::isfinite(where.t_to)) {
      panel.spans.push_back({where.t_from, where.t_to, "where it acts"});
    }
    return panel;
  };
  ReportChart chart = over_variables(
      view, 0, label, fmt::format("residual of joint {} [{}]", view.joint + 1, unit), panel_of);
  chart.id = id;
  chart.title = fmt::format("What the model alone leaves of joint {}", view.joint + 1);
  chart.caption =
      "Points: single samples of the fitted recordings. Marks: their mean in bins, with a band "
      "from the lower to the upper quartile." +
      range.words(unit);
  return chart;
}

ReportChart model_chart(const ResidualView& view, const AxisLabel& label, const std::string& unit,
                        const std::string& id) {
  RobustRange range;
  range.add(view.effect);
  range.settle();
  const VectorXd drawn = range.without_outside(view.effect);
  const auto panel_of = [&](const CoordinateView& over) {
    ReportPanel panel;
    for (const DirectionView& own : over.directions) {
      const Role role = way_role(own.direction, Role::kData);
      panel.clouds.push_back(cloud_of(over, drawn, view.direction, own.direction, role));
      panel.series.push_back({fmt::format("data, mean{}", way_words(own.direction)),
                              role,
                              own.effect,
                              {},
                              {},
                              false,
                              true});
      panel.series.push_back({fmt::format("effect{}", way_words(own.direction)), Role::kModel,
                              own.model, own.model_low, own.model_high, own.direction < 0, false});
    }
    return panel;
  };
  ReportChart chart =
      over_variables(view, view.plot, label,
                     fmt::format("torque of joint {} [{}]", view.joint + 1, unit), panel_of);
  chart.id = id;
  chart.title = "The effect over the data";
  chart.caption =
      "Marks: what is left of the recorded torque when everything but this effect is taken off, "
      "mean in bins. Line: the effect at its estimate; its band is the interval of 95 % that the "
      "parameters have." +
      range.words(unit);
  return chart;
}

ReportChart proof_chart(const std::vector<HeldoutView>& heldout, int joint, double floor,
                        const std::string& unit, const std::string& id) {
  ReportChart chart;
  chart.id = id;
  chart.title = fmt::format("Held-out recordings of joint {}", joint + 1);
  chart.caption =
      "Drag to zoom. Each slice of time keeps its least and largest value, so that no peak is "
      "lost.";
  RobustRange of_torque, of_rest;
  for (const HeldoutView& own : heldout) {
    for (const auto* part : {&own.torque, &own.model}) of_torque.add(part->col(joint));
    for (const auto* part : {&own.before, &own.after}) of_rest.add(part->col(joint));
  }
  of_torque.settle();
  of_rest.settle();
  for (std::size_t i = 0; i < heldout.size(); ++i) {
    const HeldoutView& own = heldout[i];
    ReportPanel torque, left;
    torque.x = left.x = own.time;
    torque.x_label = left.x_label = "time [s]";
    torque.y_label = fmt::format("torque [{}]", unit);
    left.y_label = fmt::format("residual [{}]", unit);
    torque.series = {
        {"recorded", Role::kData, of_torque.cut(own.torque.col(joint)), {}, {}, false, false},
        {"model with what was found",
         Role::kModel,
         of_torque.cut(own.model.col(joint)),
         {},
         {},
         false,
         false}};
    left.series = {
        {"model alone", Role::kBefore, of_rest.cut(own.before.col(joint)), {}, {}, false, false},
        {"with what was found",
         Role::kAfter,
         of_rest.cut(own.after.col(joint)),
         {},
         {},
         false,
         false}};
    if (std::isfinite(floor)) {
      const VectorXd zero = VectorXd::Zero(own.time.size());
      left.series.push_back({"twice the noise", Role::kFloor, VectorXd::Constant(zero.size(), NAN),
                             zero.array() - 2 * floor, zero.array() + 2 * floor, false, false});
    }
    const std::string name = own.recording.empty() ? "recording" : own.recording;
    chart.views.push_back(
        {fmt::format("{}{}", heldout.size() > 1 ? fmt::format("{}. ", i + 1) : "", name),
         {std::move(torque), std::move(left)}});
  }
  const std::string torque_cut = of_torque.words(unit), rest_cut = of_rest.words(unit);
  if (!torque_cut.empty()) chart.caption += " Torque is cut:" + torque_cut;
  if (!rest_cut.empty()) chart.caption += " The residual is cut:" + rest_cut;
  return chart;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/simulate/simulate_picture.h"

#include <fmt/format.h>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

std::string unit_of(const SimulatedRobot& robot, const char* revolute, const char* prismatic) {
  bool turns = false, slides = false;
  for (const bool is_revolute : robot.revolute) (is_revolute ? turns : slides) = true;
  if (turns && slides) return fmt::format("{} or {}", revolute, prismatic);
  return turns ? revolute : prismatic;
}

Panel panel_of(const std::string& title, const std::string& label, const ClosedLoopRun& run,
               const SimulatedRobot& robot, const MatrixXd& values) {
  Panel panel;
  panel.title = title;
  panel.x_label = "time [s]";
  panel.y_label = label;
  for (Index j = 0; j < values.cols(); ++j) {
    panel.series.push_back(
        {robot.joint_names[static_cast<std::size_t>(j)], run.truth.time, values.col(j)});
  }
  return panel;
}

}  // namespace

Figure picture_of(const ClosedLoopRun& run, const SimulatedRobot& robot, const std::string& title) {
  const std::string position = unit_of(robot, "rad", "m");
  Panel motion = panel_of("position (dashed: asked for)", position, run, robot, run.truth.q);
  Panel asked = panel_of("", "", run, robot, run.reference);
  for (std::size_t j = 0; j < asked.series.size(); ++j) {
    Series series = asked.series[j];
    series.name.clear();
    series.dashed = true;
    series.colour = static_cast<int>(j);
    motion.series.push_back(std::move(series));
  }
  Figure figure;
  figure.title = title;
  figure.panels = {std::move(motion),
                   panel_of("error", position, run, robot, run.reference - run.truth.q),
                   panel_of("torque", unit_of(robot, "N m", "N"), run, robot, run.truth.tau)};
  return figure;
}

}  // namespace dyngen::runtime

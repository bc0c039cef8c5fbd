// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/arm_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "gen/explain/text.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

std::string degrees(const ex& angle) {
  constexpr double kDegreesOfRadian = 57.29577951308232;
  return fmt::format("{:.6g} deg", to_double(angle) * kDegreesOfRadian);
}

std::string length_text(const ex& value) {
  return is_number(value) ? fmt::format("{:.6g} m", to_double(value)) : "a run-time length";
}

/// Where z points, seen from the axis before it.
std::string axis_text(const SymbolicLink& link, int j) {
  const std::string own = fmt::format("z{}", j);
  const std::string before = link.parent == 0 ? "z0 of the base" : fmt::format("z{}", link.parent);
  const bool parallel = is_zero_number(GiNaC::sin(link.alpha));
  if (parallel && link.d.is_zero()) {
    const bool same = number_sign(exact_cos(link.alpha)) > 0;
    return fmt::format("{} lies on {}{}", own, before, same ? "" : ", turned over");
  }
  std::string text;
  if (parallel) {
    const bool same = number_sign(exact_cos(link.alpha)) > 0;
    text = fmt::format("{} is {} to {}", own, same ? "parallel" : "antiparallel", before);
  } else if (is_zero_number(GiNaC::cos(link.alpha))) {
    text = fmt::format("{} is perpendicular to {} (alpha = {})", own, before, degrees(link.alpha));
  } else {
    text = fmt::format("{} stands at {} to {}", own, degrees(link.alpha), before);
  }
  if (link.d.is_zero()) return text + (parallel ? "" : " and meets it");
  return text + fmt::format(", d = {} away along x{}", length_text(link.d), link.parent);
}

std::string joint_text(const SymbolicLink& link, int j) {
  std::string text;
  switch (link.type) {
    case JointType::kRevolute:
      text = fmt::format("revolute about z{}: ", j);
      break;
    case JointType::kPrismatic:
      text = fmt::format("prismatic along z{}: ", j);
      break;
    case JointType::kFixed:
      text = "fixed: ";
      break;
  }
  text += axis_text(link, j);
  if (!link.r.is_zero()) {
    text += fmt::format("; O{} stands r = {} along z{}{}", j, length_text(link.r), j,
                        link.type == JointType::kPrismatic ? ", plus q" : "");
  }
  if (!link.theta.is_zero()) {
    text += fmt::format("; {} {}", link.type == JointType::kRevolute ? "theta = q +" : "theta =",
                        degrees(link.theta));
  }
  if (link.parent != j - 1) {
    text +=
        link.parent == 0 ? "; stands on the base" : fmt::format("; hangs on link {}", link.parent);
  }
  return text;
}

/// Where weight pulls: against the base's acceleration, which the file has.
std::string gravity_text(const SymbolicRobot& robot) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  std::string pull, rows;
  for (std::size_t k = 0; k < 3; ++k) {
    const GiNaC::ex& component = robot.gravity[k];
    if (component.is_zero()) continue;
    const bool known = is_number(component);
    const double value = known ? to_double(component) : 1;
    pull += fmt::format("{}{} along {}{}0", pull.empty() ? "" : ", ",
                        known ? fmt::format("{:.6g} m/s^2", std::abs(value))
                              : std::string("a run-time acceleration"),
                        value > 0 ? '-' : '+', kAxes[k]);
    rows += fmt::format("{}g{} = {}", rows.empty() ? "" : ", ", kAxes[k],
                        known ? fmt::format("{:.6g}", value) : "*");
  }
  if (pull.empty()) return "no gravity";
  return fmt::format("gravity pulls with {} ({}: the base's acceleration against it)", pull, rows);
}

}  // namespace

std::string describe_arm(const SymbolicRobot& robot) {
  std::string text;
  for (int j = 1; j <= robot.size(); ++j) {
    const SymbolicLink& link = robot.link(j);
    const std::string name =
        link.name.empty() ? fmt::format("  {:>2}  ", j) : fmt::format("  {:>2} {}  ", j, link.name);
    text += fill_lines(name, joint_text(link, j), 6);
  }
  return text + fill_lines("      ", gravity_text(robot), 6);
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "gen/compare/comparison.h"
#include "gen/explain/text.h"

namespace dyngen {
namespace {

using JointNames = std::vector<std::string>;

std::string short_name(const std::string& name) {
  constexpr std::size_t kWidth = 13;
  return name.size() <= kWidth ? name : name.substr(0, kWidth - 1) + "~";
}

std::string number_list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", value);
  return text;
}

std::string ranges_text(const JointNames& names, const Comparison& comparison) {
  std::string text;
  for (std::size_t i = 0; i < comparison.ranges.size(); ++i) {
    const StateRange& range = comparison.ranges[i];
    text += fmt::format("  {:<14}q {:>9.4g} .. {:<9.4g}  |dq| <= {:<9.4g} |ddq| <= {:.4g}\n",
                        short_name(names[i]), range.q_min, range.q_max, range.dq, range.ddq);
  }
  return text;
}

std::string torques_text(const RobotModel& model, const JointNames& names,
                         const Comparison& comparison) {
  std::string text = fmt::format(
      "\nLargest torque difference of each joint\n{:<16}{:>12}{:>5}"
      "{:>13}{:>15}{:>15}\n",
      "", "difference", "", "of largest", "first", "second");
  std::vector<bool> slides;
  for (const JointModel& joint : model.joints) {
    if (joint.coordinate >= 0) slides.push_back(joint.type == JointType::kPrismatic);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const TorqueDifference& torque = comparison.torques[i];
    text += fmt::format("  {:<14}{:>12.4g} {:<4}{:>13.3g}{:>15.6g}{:>15.6g}\n",
                        short_name(names[i]), torque.difference, slides[i] ? "N" : "N m",
                        torque.share, torque.first, torque.second);
    if (torque.difference == 0) continue;
    text += fill_lines("    at q = ",
                       fmt::format("{}; dq = {}; ddq = {}", number_list(torque.q),
                                   number_list(torque.dq), number_list(torque.ddq)),
                       7);
  }
  return text;
}

std::string parts_text(const JointNames& names, const Comparison& comparison) {
  std::string text = fmt::format("\nParts of the torque\n{:<16}{:>12}{:>13}   {}\n", "",
                                 "difference", "of largest", "in the torque of");
  for (const PartDifference& part : comparison.parts) {
    text += fmt::format("  {:<14}{:>12.4g}{:>13.3g}   {}\n", part.part, part.difference, part.share,
                        part.same ? "the same" : names[static_cast<std::size_t>(part.joint)]);
  }
  return text;
}

std::string axes_text(const JointNames& names, const Comparison& comparison) {
  std::string text = "\nJoint axes as frame 0 sees them\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const AxisDifference& axis = comparison.axes[i];
    text += fmt::format("  {:<14}direction {:>10.3g} rad, place {:>10.3g} m\n",
                        short_name(names[i]), axis.angle, axis.distance);
  }
  return text;
}

}  // namespace

std::string comparison_text(const ComparedRobot& first, const ComparedRobot& second,
                            const Comparison& comparison, const ComparisonOptions& options) {
  std::string text =
      fmt::format("first:  {}\nsecond: {}\n", first.model.file_name, second.model.file_name);
  if (!comparison.other_joints.empty()) {
    text += "The two have different joints:\n";
    for (const std::string& reason : comparison.other_joints) {
      text += fill_lines("  ", reason, 4);
    }
    return text;
  }
  JointNames names;
  for (const JointModel& joint : first.model.joints) {
    if (joint.coordinate >= 0) names.push_back(joint.name);
  }
  const bool same = comparison.same_torques && comparison.same_axes && comparison.same_frame;
  if (same) {
    text += fill_lines("", fmt::format("The two are the same to {:g}.", options.tolerance), 0);
  } else {
    std::string differ = comparison.same_torques ? "" : "torques";
    if (!comparison.same_axes) differ += (differ.empty() ? "" : ", ") + std::string("joint axes");
    if (!comparison.same_frame) {
      differ += (differ.empty() ? "" : ", ") + std::string("the frame of the last link");
    }
    text += fill_lines("", fmt::format("The two differ in: {}.", differ), 0);
    if (comparison.same_torques) {
      text += fill_lines("", fmt::format("Torques are the same to {:g}.", options.tolerance), 0);
    }
  }
  text += fill_lines("",
                     fmt::format("{} random states (seed {}), within the limits of both:",
                                 options.samples, options.seed),
                     0);
  text += ranges_text(names, comparison);
  for (const std::string& joint : comparison.clipped) {
    text += fill_lines(
        "  ", fmt::format("{}: the limits do not overlap; the first's are used", joint), 4);
  }
  text += torques_text(first.model, names, comparison);
  text += parts_text(names, comparison);
  text += fmt::format("\nFrame of the last link: origin differs by {:.3g} m, axes by {:.3g} rad\n",
                      comparison.frame_distance, comparison.frame_angle);
  return text + axes_text(names, comparison);
}

}  // namespace dyngen

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/number_notes.h"

#include <fmt/format.h>

#include <algorithm>

namespace dyngen::runtime {
namespace {

enum class LinkNumbers { kKnown, kUnknown, kOther };

/// Known: numbers and no `*`; unknown: `*` and no number but zeros.
LinkNumbers link_numbers(const JointModel& joint) {
  bool number = false, star = false;
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    const Quantity& quantity = joint.chi[k];
    if (quantity.line == 0) continue;
    star = star || quantity.unknown;
    number = number || !(quantity.unknown || quantity.value.is_zero());
  }
  if (number == star) return LinkNumbers::kOther;
  return number ? LinkNumbers::kKnown : LinkNumbers::kUnknown;
}

}  // namespace

bool has_open_payload(const std::vector<EffectInstance>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const EffectInstance& effect) {
    return effect.law.family == "payload" && !effect.parameters.allFinite();
  });
}

std::vector<std::string> notes_of_numbers(const DescribedRobot& robot, bool open_payload) {
  if (robot.held.any()) {
    constexpr std::size_t kMost = 12;
    std::vector<std::string> names = robot.held.names;
    if (names.size() > kMost) names.resize(kMost);
    std::vector<std::string> notes = {fmt::format("held: {}", fmt::join(names, " "))};
    const std::size_t more = robot.held.names.size() - names.size();
    if (more > 0) notes.front() += fmt::format(" and {} more", more);
    notes.insert(notes.end(), robot.held.notes.begin(), robot.held.notes.end());
    return notes;
  }
  std::vector<int> known, unknown;
  for (int link = 1; link <= robot.model.size(); ++link) {
    const LinkNumbers numbers = link_numbers(robot.model.joint(link));
    if (numbers == LinkNumbers::kKnown) known.push_back(link);
    if (numbers == LinkNumbers::kUnknown) unknown.push_back(link);
  }
  if (known.empty() || (unknown.empty() && !open_payload)) return {};
  const auto links = [](const std::vector<int>& places) {
    return fmt::format("link{} {}", places.size() == 1 ? "" : "s", fmt::join(places, ", "));
  };
  return {fmt::format(
      "this file looks like an unknown load on a known arm: {} {} numbers, and {} unknown. A fit "
      "begins at numbers and changes them; to keep them and find the rest alone: --hold links={}",
      links(known), known.size() == 1 ? "has" : "have",
      unknown.empty() ? std::string("the payload is")
                      : fmt::format("{} {}", links(unknown), unknown.size() == 1 ? "is" : "are"),
      fmt::join(known, ","))};
}

std::vector<std::string> notes_of_negatives(const LinearModel& model, const Eigen::VectorXd& beta,
                                            const Eigen::VectorXd& stddev, double interval) {
  std::vector<std::string> names, notes;
  for (Eigen::Index i = 0; i < stddev.size(); ++i) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(i)];
    const bool bounded = parameter.kind == ParameterKind::kRotorInertia ||
                         parameter.kind == ParameterKind::kCoulomb ||
                         parameter.kind == ParameterKind::kViscous;
    if (!bounded || beta[i] >= 0) continue;
    if (beta[i] > -interval * stddev[i]) {
      names.push_back(parameter.name);
    } else if (const std::size_t beside = parameter.formula.find("; beside held ");
               beside != std::string::npos) {
      notes.push_back(fmt::format(
          "{} is {} and came out below 0: what is held beside it is too large ({})", parameter.name,
          parameter.formula.substr(0, beside), parameter.formula.substr(beside + 14)));
    }
  }
  if (!names.empty()) {
    notes.push_back(fmt::format(
        "{} {} below 0, but not by more than {} uncertainty: 0, the least that physics has, is as "
        "likely. A 0 in the robot file leaves the parameter out",
        fmt::join(names, " "), names.size() == 1 ? "is" : "are",
        names.size() == 1 ? "its" : "their"));
  }
  return notes;
}

}  // namespace dyngen::runtime

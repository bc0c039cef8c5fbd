// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/steady/steady_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

/// A joint needs so many runs that they are a programme, not what a motion happens to have.
constexpr int kFewestRuns = 6;

/// Recordings that are in memory with a torque.
std::vector<std::shared_ptr<const Recording>> usable(const std::vector<MotionSource>& sources,
                                                     SteadyJoints& answer) {
  std::vector<std::shared_ptr<const Recording>> recordings;
  for (const MotionSource& source : sources) {
    if (!source.recorded) {
      answer.remarks.push_back(fmt::format(
          "{} is too large to be in memory; its runs of constant speed are not looked for.",
          source.name));
      continue;
    }
    if (source.recorded->tau.size() > 0) recordings.push_back(source.recorded);
  }
  return recordings;
}

bool torque_is_dead(const std::vector<MotionSource>& sources, Index joint) {
  return std::any_of(sources.begin(), sources.end(), [&](const MotionSource& source) {
    const std::vector<bool>& dead = source.condition.torque_dead;
    return static_cast<std::size_t>(joint) < dead.size() && dead[static_cast<std::size_t>(joint)];
  });
}

}  // namespace

SteadyJoints steady_of(const DescribedRobot& robot, const std::vector<MotionSource>& sources,
                       const SteadyRules& rules, ProgressLine& progress) {
  SteadyJoints answer;
  const LinearModel& model = robot.linear;
  const auto recordings = usable(sources, answer);
  if (recordings.empty()) return {};
  for (Index j = 0; j < model.joints(); ++j) {
    progress.show(fmt::format("steady speeds of joint {}", j + 1), static_cast<std::size_t>(j),
                  static_cast<std::size_t>(model.joints()));
    if (torque_is_dead(sources, j)) continue;
    SteadyResult result =
        analyse_steady({recordings, j, model.revolute[static_cast<std::size_t>(j)], {}}, rules);
    if (result.runs >= kFewestRuns || !result.poses.pairs.empty()) {
      answer.joints.push_back(std::move(result));
    }
  }
  if (answer.joints.empty()) return {};
  return answer;
}

}  // namespace dyngen::runtime

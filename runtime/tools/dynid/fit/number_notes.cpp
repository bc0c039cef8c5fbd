// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/held_torque.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

/// How many of a link's inertial parameters are numbers, and how many are `*`.
struct LinkNumbers {
  int written = 0, zeros = 0, unknown = 0;
};

LinkNumbers link_numbers(const JointModel& joint) {
  LinkNumbers numbers;
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    const Quantity& quantity = joint.chi[k];
    if (quantity.unknown && quantity.line != 0) ++numbers.unknown;
    if (quantity.unknown || quantity.line == 0) continue;
    ++numbers.written;
    if (quantity.value.is_zero()) ++numbers.zeros;
  }
  return numbers;
}

/// A load that is to be found.
bool has_open_payload(const EffectTask& task) {
  return std::any_of(task.effects.begin(), task.effects.end(), [](const EffectInstance& effect) {
    return effect.law.family == "payload" && !effect.parameters.allFinite();
  });
}

}  // namespace

MotionSource without_held(const MotionSource& source, const DescribedRobot& robot) {
  if (!robot.held_torque) return source;
  return made_of(source, [held = robot.held_torque](const MotionSource& state) {
    const auto pieces = state.pieces;
    return with_pieces(state, [held, pieces](const std::function<void(const StreamPiece&)>& visit) {
      pieces([&](const StreamPiece& piece) {
        StreamPiece rest = piece;
        const Motion& motion = piece.motion;
        if (motion.tau.size() > 0) {
          rest.motion.tau -= held->model.torque(motion.q, motion.dq, motion.ddq, held->beta);
        }
        visit(rest);
      });
    });
  });
}

std::vector<std::string> notes_of_numbers(const DescribedRobot& robot, const EffectTask& task) {
  if (robot.held.any()) {
    return {fmt::format("held: {}; torque and percentages are of what these numbers leave",
                        fmt::join(robot.held.names, " "))};
  }
  std::vector<int> known, unknown;
  for (int link = 1; link <= robot.model.size(); ++link) {
    const LinkNumbers numbers = link_numbers(robot.model.joint(link));
    constexpr int kAll = static_cast<int>(kInertialCount);
    if (numbers.written == kAll && numbers.zeros < kAll) known.push_back(link);
    if (numbers.unknown == kAll) unknown.push_back(link);
  }
  const bool payload = has_open_payload(task);
  if (known.empty() || (unknown.empty() && !payload)) return {};
  return {fmt::format(
      "link{} {} of the file {} all numbers and {} unknown. A fit begins at numbers and changes "
      "them; to keep them and find the rest alone: --hold links={}",
      known.size() == 1 ? "" : "s", fmt::join(known, ", "), known.size() == 1 ? "is" : "are",
      unknown.empty() ? std::string("the payload is")
                      : fmt::format("link{} {} {}", unknown.size() == 1 ? "" : "s",
                                    fmt::join(unknown, ", "), unknown.size() == 1 ? "is" : "are"),
      fmt::join(known, ","))};
}

}  // namespace dyngen::runtime

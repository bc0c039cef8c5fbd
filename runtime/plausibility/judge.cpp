// SPDX-License-Identifier: MIT
#include "runtime/plausibility/judge.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/plausibility/model_remarks.h"
#include "runtime/plausibility/signal_remarks.h"

namespace dyngen::runtime {

std::string Remark::words() const {
  std::string place = recording.empty() ? "" : recording + ": ";
  return fmt::format("{}{}: {}", place, refused ? "error" : "warning", text);
}

std::vector<Remark> judge(const JudgedRobot& robot, const std::vector<MotionSource>& sources) {
  std::vector<Remark> remarks;
  for (const MotionSource& source : sources) {
    if (source.joints() != robot.model->joints()) continue;  // said by who makes its equations
    add_signal_remarks(robot, source, remarks);
  }
  const auto refused = [](const Remark& remark) { return remark.refused; };
  if (std::none_of(remarks.begin(), remarks.end(), refused)) {
    std::vector<MotionSource> fitting;
    for (const MotionSource& source : sources) {
      if (source.joints() == robot.model->joints()) fitting.push_back(source);
    }
    add_model_remarks(robot, fitting, remarks);
  }
  std::stable_partition(remarks.begin(), remarks.end(), refused);
  return remarks;
}

}  // namespace dyngen::runtime

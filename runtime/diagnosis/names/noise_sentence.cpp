// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/noise_sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace dyngen::runtime {
namespace {

/// " in a, b" where it is not all of them.
std::string in_some(const std::vector<MotionSource>& sources, const std::vector<int>& some) {
  if (some.size() == sources.size()) return "";
  std::vector<std::string> names;
  for (const int place : some) names.push_back(sources[static_cast<std::size_t>(place)].name);
  return fmt::format(" in {}", fmt::join(names, ", "));
}

/// Joints of the same recordings in one clause.
std::string sticks(const std::vector<StictionJoint>& joints, const std::vector<MotionSource>& train,
                   const char* what) {
  std::map<std::vector<int>, std::vector<int>> by_recordings;
  for (const StictionJoint& sticking : joints) {
    by_recordings[sticking.recordings].push_back(sticking.joint + 1);
  }
  std::string text;
  for (auto& [recordings, numbers] : by_recordings) {
    std::sort(numbers.begin(), numbers.end());
    const bool several = numbers.size() > 1;
    text += fmt::format(". Joint{} {} {} at reversals{}. Friction can take any value there; {}",
                        several ? "s" : "", fmt::join(numbers, ", "), several ? "stick" : "sticks",
                        in_some(train, recordings), what);
  }
  return text;
}

/// What a disturbance inside the loop means for the findings; empty: none is seen.
std::string follows(const std::vector<int>& joints) {
  if (joints.empty()) return "";
  std::vector<int> numbers;
  for (const int joint : joints) numbers.push_back(joint + 1);
  return fmt::format(
      ". A disturbance inside the control loop, or noise of the positions, shows on joint{} {}: "
      "the "
      "motion follows it. What it can explain is not named",
      numbers.size() > 1 ? "s" : "", fmt::join(numbers, ", "));
}

}  // namespace

std::string noise_sentence(const TorqueNoiseModel& noise, const std::vector<MotionSource>& train,
                           const std::vector<StictionJoint>& left_out,
                           const std::vector<StictionJoint>& impulses,
                           const std::vector<int>& disturbed) {
  return (noise.of_recordings    ? "from the differences between recordings of the same motion"
          : noise.from_periods   ? "from the differences between periods of the same motion"
          : noise.beside_largest ? "from what smooth functions of the joints' states leave too, "
                                   "since no motion repeats"
                                 : "from the residual of the last model, since no motion repeats: "
                                   "an upper bound of the "
                                   "noise") +
         sticks(left_out, train, "these equations are excluded") +
         sticks(impulses, train, "an impulse at each reversal is excluded") + follows(disturbed);
}

}  // namespace dyngen::runtime

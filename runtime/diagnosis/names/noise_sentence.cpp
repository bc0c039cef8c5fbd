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
std::string rests(const std::vector<RestingJoint>& joints, const std::vector<MotionSource>& train,
                  const char* what) {
  std::map<std::vector<int>, std::vector<int>> by_recordings;
  for (const RestingJoint& resting : joints) {
    by_recordings[resting.recordings].push_back(resting.joint + 1);
  }
  std::string text;
  for (auto& [recordings, numbers] : by_recordings) {
    std::sort(numbers.begin(), numbers.end());
    const bool several = numbers.size() > 1;
    text += fmt::format(
        "; joint{} {} rest{} for an instant where {}{}: friction there may be of any size, and {} "
        "left out of the judgement",
        several ? "s" : "", fmt::join(numbers, ", "), several ? "" : "s",
        several ? "they turn" : "it turns", in_some(train, recordings), what);
  }
  return text;
}

}  // namespace

std::string noise_sentence(const TorqueNoiseModel& noise, const std::vector<MotionSource>& train,
                           const std::vector<RestingJoint>& left_out,
                           const std::vector<RestingJoint>& impulses) {
  return (noise.from_periods ? "from what differs between periods of the same motion"
                             : "from what the last model leaves: a lower bound of what is missing, "
                               "since no motion repeats") +
         rests(left_out, train, "what it would change there is") +
         rests(impulses, train, "an impulse at each reversal is");
}

}  // namespace dyngen::runtime

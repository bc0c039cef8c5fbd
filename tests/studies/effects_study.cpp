// SPDX-License-Identifier: MIT
// Lets every effect of the catalogue act on simulated recordings, fits them, and prints as markdown
// how its parameters came back.
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <set>
#include <string>

#include "tests/studies/effect_recovery.h"

namespace {

using namespace dyngen::test;

constexpr const char* kUsage =
    "usage: effects_study [--recordings R (10)] [--first-seed S (1)] [--each] [effect ...]\n";

}  // namespace

int main(int argc, char** argv) {
  EffectStudyPlan plan;
  std::set<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--recordings" || word == "--first-seed") {
      int value = 0;
      const std::string text = i + 1 < argc ? argv[++i] : "";
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size() || value < 1) {
        std::fputs(kUsage, stderr);
        return 2;
      }
      if (word == "--recordings") {
        plan.recordings = value;
      } else {
        plan.first_seed = static_cast<unsigned>(value);
      }
    } else if (word == "--each") {
      plan.each = true;
    } else if (word.starts_with("-")) {
      std::fputs(kUsage, stderr);
      return 2;
    } else {
      names.insert(word);
    }
  }
  const dyngen::EffectCatalogue catalogue;
  const dyngen::runtime::DescribedRobot robot = effect_study_robot();
  fmt::print("{} recordings of each effect, seeds from {}, {} s\n\n", plan.recordings,
             plan.first_seed, plan.seconds);
  fmt::print(
      "| effect | not seen | within 1.96 | within 3 | worst | |\n|---|---:|---:|---:|---:|---|\n");
  std::size_t all = 0, covered = 0;
  for (const auto& effect : catalogue.all()) {
    if (!names.empty() && !names.contains(effect->name)) continue;
    const EffectRecovery recovery = recover(robot, *effect, plan);
    std::string remark = recovery.failure;
    if (recovery.not_converged > 0) {
      remark += fmt::format("{} did not converge", recovery.not_converged);
    }
    if (recovery.errors.empty()) {
      fmt::print("| {} | {} of {} | | | | {} |\n", recovery.name, recovery.unseen,
                 recovery.recordings, remark);
    } else {
      fmt::print("| {} | {} of {} | {:.0f} % | {:.0f} % | {:.1f} | {} |\n", recovery.name,
                 recovery.unseen, recovery.recordings, 100 * recovery.within(1.96),
                 100 * recovery.within(3), recovery.worst(), remark);
    }
    std::fflush(stdout);
    for (const double error : recovery.errors) {
      ++all;
      covered += error <= 1.96 ? 1 : 0;
    }
  }
  if (all > 0) {
    fmt::print("\n95 % intervals cover {:.1f} % of {} parameters\n",
               100.0 * static_cast<double>(covered) / static_cast<double>(all), all);
  }
  return 0;
}

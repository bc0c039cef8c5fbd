// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "tests/blind/score/score.h"

namespace blind {

std::string lines(const std::vector<Judged>& all) {
  std::string text;
  for (const Judged& each : all) {
    std::string truth, said;
    for (const auto& one : each.truth["truths"]) {
      truth += fmt::format("{}{} of joint {} ({}; lambda {:.0f}, {:.0f} % absorbed)",
                           truth.empty() ? "" : " and ", one["family"].get<std::string>(),
                           one["joint"].get<int>(), one["form"].get<std::string>(),
                           one["lambda"].get<double>(), 100 * one["absorbed"].get<double>());
    }
    if (each.answered) {
      for (const auto& one : each.answer["findings"]) {
        said += fmt::format("{}{} of joint {} ({:.2f})", said.empty() ? "" : " and ",
                            one["family"].get<std::string>(), one["joint"].get<int>(),
                            one["probability"].get<double>());
      }
      for (const auto& one : each.excused) {
        said += fmt::format("{}({} of joint {}, excused)", said.empty() ? "" : " and ",
                            one["family"].get<std::string>(), one["joint"].get<int>());
      }
      for (const auto& one : each.answer["unexplained"]) {
        said +=
            fmt::format("{}{}", said.empty() ? "" : " and ", one["description"].get<std::string>());
      }
    }
    text += fmt::format("{} {}{} {} {}: {} -> {}\n", each.name, each.kind,
                        each.habit == "laboratory" ? "" : " " + each.habit,
                        each.truth["arm"].get<std::string>(), each.truth["loop"].get<std::string>(),
                        truth.empty() ? "nothing" : truth,
                        each.answered ? (said.empty() ? "clean" : said) : "no answer");
  }
  return text;
}

}  // namespace blind

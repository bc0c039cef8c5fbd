// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/heldout_remarks.h"

#include <fmt/format.h>

namespace dyngen::runtime {
namespace {

bool is_far(const HeldoutResidual& rms, Eigen::Index j, const AnswerRules& rules) {
  return rms.after[j] > rules.heldout_far * rms.floor[j];
}

}  // namespace

std::vector<std::string> heldout_remarks(const HeldoutResidual& rms, const HeldoutResidual& judged,
                                         const AnswerRules& rules) {
  std::vector<std::string> remarks;
  for (Eigen::Index j = 0; j < rms.before.size(); ++j) {
    if (!(rms.after[j] > (1 + rules.printed_part) * rms.before[j])) continue;
    std::string remark = fmt::format(
        "joint {}: held-out recordings are predicted worse with the findings than without", j + 1);
    if (j < rms.visited.size() && rms.visited[j] < 1 - rules.printed_part) {
      remark += fmt::format(
          "; {:.0f} % of them are within the positions of the fitted ones, where findings are "
          "judged: beyond, what was found is not known to go on so",
          100 * rms.visited[j]);
    }
    remarks.push_back(std::move(remark));
  }
  for (Eigen::Index j = 0; j < rms.after.size(); ++j) {
    if (!is_far(rms, j, rules) || is_far(judged, j, rules)) continue;
    remarks.push_back(
        fmt::format("joint {}: most of it is near reversals, where friction can take any value; "
                    "{:.4g} without them",
                    j + 1, judged.after[j]));
  }
  return remarks;
}

}  // namespace dyngen::runtime

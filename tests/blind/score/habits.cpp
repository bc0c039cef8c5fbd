// SPDX-License-Identifier: MIT
#include "tests/blind/score/habits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "tests/blind/score/shares.h"

namespace blind {
namespace {

using Json = nlohmann::json;
using Cases = std::vector<const Judged*>;

constexpr double kStrongOfCrowd = 200;

std::string share_text(const Cases& of, bool Judged::*what) {
  const auto right = std::count_if(of.begin(), of.end(), [&](const Judged* e) { return e->*what; });
  return text_of(share_of(static_cast<int>(right), static_cast<int>(of.size())));
}

/// For each effect the finding that belongs to it, or -1.
std::vector<int> belonging(const Judged& judged, bool first_name) {
  const Json& truths = judged.truth["truths"];
  std::vector<int> finding_of(truths.size(), -1);
  if (!judged.answered) return finding_of;
  const Json& findings = judged.answer["findings"];
  for (std::size_t f = 0; f < findings.size(); ++f) {
    for (std::size_t i = 0; i < truths.size(); ++i) {
      const std::string family = truths[i]["family"];
      const bool named = first_name ? findings[f]["family"] == family : names(findings[f], family);
      if (finding_of[i] >= 0 || !named || !on_joint(findings[f], truths[i])) continue;
      finding_of[i] = static_cast<int>(f);
      break;
    }
  }
  return finding_of;
}

int taken(const std::vector<int>& finding_of) {
  return static_cast<int>(
      std::count_if(finding_of.begin(), finding_of.end(), [](int f) { return f >= 0; }));
}

double middle(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Cases crowds_of(const std::vector<Judged>& all) {
  Cases crowds;
  for (const Judged& each : all) {
    if (each.kind == "crowd") crowds.push_back(&each);
  }
  return crowds;
}

}  // namespace

std::string habit_table(const std::vector<Judged>& all) {
  std::map<std::string, std::pair<Cases, Cases>> by_habit;  // nulls, singles
  for (const Judged& each : all) {
    auto& [nulls, singles] = by_habit[each.habit];
    if (each.kind == "null") nulls.push_back(&each);
    if (each.kind == "single") singles.push_back(&each);
  }
  if (by_habit.size() < 2) return "";
  std::string text =
      "| habit | nulls: false alarms | single effects: found | family first | confident wrong "
      "|\n|---|---|---|---|---|\n";
  for (const auto& [habit, cases] : by_habit) {
    const auto& [nulls, singles] = cases;
    if (nulls.empty() && singles.empty()) continue;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", habit, share_text(nulls, &Judged::found),
                        share_text(singles, &Judged::found), share_text(singles, &Judged::first),
                        share_text(singles, &Judged::confident_wrong));
  }
  return text + "\n";
}

CrowdCount count_crowds(const std::vector<Judged>& all) {
  CrowdCount count;
  std::vector<double> gaps;
  for (const Judged* each : crowds_of(all)) {
    const std::vector<int> first = belonging(*each, true), any = belonging(*each, false);
    const Json& truths = each->truth["truths"];
    for (std::size_t i = 0; i < truths.size(); ++i) {
      if (truths[i]["lambda"] < kStrongOfCrowd) continue;
      ++count.strong;
      count.named += first[i] >= 0;
      count.among += any[i] >= 0;
    }
    gaps.push_back(each->gap_closed);
    if (!each->answered) continue;
    const int findings = static_cast<int>(each->answer["findings"].size());
    count.findings += findings;
    count.right += taken(first);
    count.spurious += findings - taken(any);
  }
  count.gap_closed = middle(gaps);
  return count;
}

std::string crowd_table(const std::vector<Judged>& all) {
  const Cases crowds = crowds_of(all);
  if (crowds.empty()) return "";
  const CrowdCount count = count_crowds(all);
  std::string text = fmt::format("| {} crowds | |\n|---|---|\n", crowds.size());
  const auto row = [&](const std::string& what, const std::string& value) {
    text += fmt::format("| {} | {} |\n", what, value);
  };
  row("recall: family and joint first, of effects of lambda 200 and more",
      text_of(share_of(count.named, count.strong)));
  row("the same, among the names of a finding", text_of(share_of(count.among, count.strong)));
  row("precision: family and joint first, of all findings",
      text_of(share_of(count.right, count.findings)));
  row("spurious findings a case",
      fmt::format("{:.2f}", count.spurious / static_cast<double>(crowds.size())));
  row("held-out gap closed, median", fmt::format("{:.2f}", count.gap_closed));
  return text + "\n";
}

}  // namespace blind

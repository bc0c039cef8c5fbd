// SPDX-License-Identifier: MIT
#include "tests/blind/score/change.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "tests/blind/score/score.h"

namespace blind {
namespace {

using Json = nlohmann::json;

bool is_answer(const Json& answer) {
  return answer.is_object() && answer.value("schema", "") == "dynid.diagnosis/1";
}

int other_of(const Json& finding) {
  return finding["other_joint"].is_number() ? finding["other_joint"].get<int>() : 0;
}

bool on_added_joint(const Json& finding, const Json& added) {
  const int said = finding["joint"], joint = added["joint"], other = added["other_joint"];
  if (joint == 0) return true;  // of the whole robot: findings stand where they like
  return said == joint || other_of(finding) == joint || (other != 0 && said == other);
}

bool says(const Json& finding, const Json& added) {
  return names(finding, added["family"]) && on_added_joint(finding, added);
}

/// Whether two findings are of the same thing: joints, and a family among the other's names.
bool alike(const Json& one, const Json& two) {
  const bool joints = one["joint"] == two["joint"] && other_of(one) == other_of(two);
  const bool swapped =
      other_of(one) != 0 && one["joint"] == other_of(two) && two["joint"] == other_of(one);
  return (joints || swapped) && (names(one, two["family"]) || names(two, one["family"]));
}

std::string text_of(const Json& finding) {
  const int joint = finding["joint"], other = other_of(finding);
  std::string where = joint == 0 ? "" : fmt::format(" {}", joint);
  if (other != 0) where += fmt::format("-{}", other);
  return finding["family"].get<std::string>() + where;
}

bool any(const Json& findings, const std::function<bool(const Json&)>& test) {
  return std::any_of(findings.begin(), findings.end(), test);
}

std::string list(const std::vector<std::string>& texts) {
  return texts.empty() ? "-" : fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

Change judge_change(const Json& entry, const Json& before, const Json& after) {
  Change change;
  change.name = entry["case"];
  change.recording = entry["recording"];
  change.added = entry["added"];
  change.answered = is_answer(before) && is_answer(after);
  if (!change.answered) return change;
  const Json& added = change.added;
  const Json& old = before["findings"];
  change.before = any(old, [&](const Json& f) { return says(f, added); });
  for (const Json& finding : after["findings"]) {
    const bool known = any(old, [&](const Json& f) { return alike(f, finding); });
    if (says(finding, added)) {
      if (change.said.empty()) {
        change.said = text_of(finding);
        change.probability = finding["probability"];
        change.first = finding["family"] == added["family"];
        change.appears = !change.before;
      }
      continue;
    }
    if (!known) change.more.push_back(text_of(finding));
  }
  for (const Json& finding : old) {
    if (!any(after["findings"], [&](const Json& f) { return alike(f, finding); })) {
      change.lost.push_back(text_of(finding));
    }
  }
  for (const Json& left : after["unexplained"]) {
    const bool known = any(before["unexplained"],
                           [&](const Json& other) { return other["joint"] == left["joint"]; });
    if (!known) change.open.push_back(fmt::format("joint {}", left["joint"].get<int>()));
  }
  return change;
}

std::string change_table(const std::vector<Change>& all) {
  std::string text =
      "| recording | added | strength, absorbed | said of it | new besides | no longer said | "
      "newly "
      "without a name | |\n|---|---|---|---|---|---|---|---|\n";
  int right = 0, counted = 0;
  for (const Change& one : all) {
    const Json& added = one.added;
    const int joint = added["joint"], other = added["other_joint"];
    const std::string where = (joint == 0 ? "" : fmt::format(" {}", joint)) +
                              (other == 0 ? "" : fmt::format("-{}", other));
    const std::string verdict = !one.answered ? "no answer"
                                : one.before  ? "there before"
                                : one.right() ? "right"
                                : one.appears ? "right, and more"
                                              : "missed";
    counted += one.answered && one.before ? 0 : 1;
    right += one.right() ? 1 : 0;
    text += fmt::format(
        "| {} | {}{}: {} | {:.0f}, {:.0f} % | {} | {} | {} | {} | {} |\n", one.recording,
        added["family"].get<std::string>(), where, added["form"].get<std::string>(),
        added["strength"].get<double>(), 100 * added["absorbed"].get<double>(),
        one.said.empty() ? "-" : fmt::format("{} ({:.2f})", one.said, one.probability),
        list(one.more), list(one.lost), list(one.open), verdict);
  }
  return text + fmt::format("\nRight: {} of {} that were not said before.\n", right, counted);
}

}  // namespace blind

// SPDX-License-Identifier: MIT
#include "tests/blind/score/score.h"

#include <algorithm>
#include <cmath>

#include "tests/blind/score/heldout.h"

namespace blind {
namespace {

using Json = nlohmann::json;

constexpr double kConfident = 0.9;
constexpr double kSeparable = 30;

/// Root mean square of the joints' ratios, and the share of the gap that is closed.
void judge_heldout(const Json& truth, const Json& answer, Judged& judged) {
  const Json& oracle = truth["heldout_oracle"];
  const Json& base = answer["heldout"]["rms_before"];
  const std::vector<double> before = in_suite_measure(truth, base, base);
  const std::vector<double> after = in_suite_measure(truth, base, answer["heldout"]["rms_after"]);
  judged.heldout = over_oracle(truth, after);
  if (judged.heldout == 0 || before.size() != after.size()) return;
  judged.heldout_before = over_oracle(truth, before);
  double open = 0, left = 0;
  for (std::size_t j = 0; j < oracle.size(); ++j) {
    const double o = oracle[j], a = after[j], b = before[j];
    open += (b * b - o * o) / (o * o);
    left += (a * a - o * o) / (o * o);
  }
  judged.gap_closed = open > 0 ? 1 - left / open : 0;
}

void judge_pair(const Json& truths, const Json& findings, Judged& judged) {
  int named = 0;
  for (const Json& truth : truths) {
    named += std::any_of(findings.begin(), findings.end(), [&](const Json& finding) {
      return names(finding, truth["family"]) && on_joint(finding, truth);
    });
  }
  judged.both = named == 2;
  judged.one = named >= 1;
  judged.third = findings.size() > truths.size();
}

/// Takes findings out of an answer that the habit of recording makes right, and that are not of a
/// truth.
Json take_excused(const Json& truth, Json& answer) {
  Json excused = Json::array(), counted = Json::array();
  const Json allowed = truth.value("allowed", Json::array());
  for (const Json& finding : answer["findings"]) {
    const bool wanted = std::any_of(truth["truths"].begin(), truth["truths"].end(),
                                    [&](const Json& one) { return names(finding, one["family"]); });
    const bool free = std::any_of(allowed.begin(), allowed.end(),
                                  [&](const Json& family) { return finding["family"] == family; });
    (free && !wanted ? excused : counted).push_back(finding);
  }
  answer["findings"] = counted;
  return excused;
}

}  // namespace

bool on_joint(const nlohmann::json& finding, const nlohmann::json& truth) {
  const int joint = truth["joint"], other = truth["other_joint"], said = finding["joint"];
  if (joint == 0) return said == 0 || truth["family"] == "unknown";
  return said == joint || (other != 0 && said == other) ||
         (finding["other_joint"].is_number() && finding["other_joint"] == joint);
}

bool names(const nlohmann::json& finding, const std::string& family) {
  if (finding["family"] == family) return true;
  const auto& aliases = finding["aliases"];
  return std::find(aliases.begin(), aliases.end(), family) != aliases.end();
}

Judged judge(const Json& truth, const Json& answer) {
  Judged judged;
  judged.name = truth["case"];
  judged.kind = truth["kind"];
  judged.truth = truth;
  judged.habit = truth.value("habit", "laboratory");
  judged.answer = answer;
  judged.excess = truth["excess"];
  judged.answered = answer.is_object() && answer.value("schema", "") == "dynid.diagnosis/1";
  const Json& truths = truth["truths"];
  if (!truths.empty()) {
    judged.lambda = truths[0]["lambda"];
    judged.absorbed = truths[0]["absorbed"];
    judged.filtered = truth.at("filtered");
    double imitated = 0;
    for (const auto& [family, share] : truth["imitated"].items()) {
      imitated = std::max(imitated, share.get<double>());
    }
    judged.separable = judged.lambda * (1 - imitated) >= kSeparable;
  }
  if (!judged.answered) return judged;
  judged.excused = take_excused(truth, judged.answer);
  const Json& findings = judged.answer["findings"];
  const bool unexplained = !answer["unexplained"].empty();
  judged.found = !findings.empty() || unexplained;
  judge_heldout(truth, answer, judged);
  const auto wrong = [&](const Json& finding) {
    return finding["probability"] >= kConfident &&
           std::none_of(truths.begin(), truths.end(),
                        [&](const Json& one) { return names(finding, one["family"]); });
  };
  judged.confident_wrong = std::any_of(findings.begin(), findings.end(), wrong);
  judged.flagged = unexplained && !judged.confident_wrong;
  if (truths.empty()) return judged;
  if (truths.size() > 1) judge_pair(truths, findings, judged);
  const Json& one = truths[0];
  if (!findings.empty()) {
    judged.joint = on_joint(findings[0], one);
    judged.first = findings[0]["family"] == one["family"];
    judged.aliases = static_cast<double>(std::max<std::size_t>(1, findings[0]["aliases"].size()));
    judged.among = std::any_of(findings.begin(), findings.end(),
                               [&](const Json& each) { return names(each, one["family"]); });
  }
  for (const Json& each : answer["undecidable"]) {
    const auto& families = each["families"];
    const bool named = std::find(families.begin(), families.end(), one["family"]) != families.end();
    judged.undecidable |= named && (each["joint"] == one["joint"] || each["joint"] == 0);
  }
  return judged;
}

std::string family_of(const Judged& judged) {
  const Json& truths = judged.truth["truths"];
  return truths.empty() ? "nothing" : truths[0]["family"];
}

std::string first_name(const Judged& judged) {
  if (!judged.answered) return "no answer";
  if (!judged.answer["findings"].empty()) return judged.answer["findings"][0]["family"];
  return judged.answer["unexplained"].empty() ? "clean" : "without a name";
}

}  // namespace blind

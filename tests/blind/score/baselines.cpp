// SPDX-License-Identifier: MIT
#include "tests/blind/score/baselines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/blind/score/heldout.h"

namespace blind {
namespace {

using Json = nlohmann::json;
using Rows = std::vector<const JudgedBaseline*>;
using Test = std::function<bool(const JudgedBaseline&)>;

constexpr double kStrong = 53;  // lambda of 60 and more, within the accuracy of sizes

bool is_family(const Json& truths, const std::string& family) {
  return std::any_of(truths.begin(), truths.end(),
                     [&](const Json& truth) { return truth["family"] == family; });
}

bool is_right(const Json& truths, const Json& name) {
  return std::any_of(truths.begin(), truths.end(), [&](const Json& truth) {
    return truth["family"] == name["family"] &&
           (name["joint"] == truth["joint"] ||
            (truth["other_joint"] != 0 && name["joint"] == truth["other_joint"]));
  });
}

Rows part(const std::vector<JudgedBaseline>& all, const Test& test) {
  Rows rows;
  for (const JudgedBaseline& each : all) {
    if (test(each)) rows.push_back(&each);
  }
  return rows;
}

std::string count(const Rows& rows, const Test& test) {
  if (rows.empty()) return "";
  const auto right =
      std::count_if(rows.begin(), rows.end(), [&](const auto* each) { return test(*each); });
  return fmt::format("{} of {}", right, rows.size());
}

std::string mean(const Rows& rows, const std::function<double(const JudgedBaseline&)>& value) {
  if (rows.empty()) return "";
  double sum = 0;
  for (const auto* each : rows) sum += value(*each);
  return fmt::format("{:.1f}", sum / static_cast<double>(rows.size()));
}

/// Median and 95th percentile, the nearest ones.
std::string heldout(const Rows& rows) {
  std::vector<double> values;
  for (const auto* each : rows) {
    if (each->heldout > 0) values.push_back(each->heldout);
  }
  if (values.empty()) return "";
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(
        std::lround(share * static_cast<double>(values.size() - 1)))];
  };
  return fmt::format("{:.3f}, {:.3f}", at(0.5), at(0.95));
}

}  // namespace

std::vector<JudgedBaseline> judge_baselines(const Json& truth, const Json& answer) {
  std::vector<JudgedBaseline> judged;
  if (!answer.is_object() || answer.value("schema", "") != "blind.baselines/1") return judged;
  const Json& truths = truth["truths"];
  for (const Json& each : answer["baselines"]) {
    const auto alone = std::find_if(answer["baselines"].begin(), answer["baselines"].end(),
                                    [](const Json& own) { return own["baseline"] == "base"; });
    const Json& base = (alone == answer["baselines"].end() ? each : *alone)["heldout_rms"];
    JudgedBaseline one;
    one.baseline = each["baseline"];
    one.kind = truth["kind"];
    one.names = one.baseline != "base" && one.baseline != "spline";
    one.lambda = truths.empty() ? 0 : truths[0]["lambda"].get<double>();
    const Json& names = each["names"];
    one.count = static_cast<int>(names.size());
    one.said = one.count > 0;
    one.first = one.said && is_right(truths, names[0]);
    for (const Json& name : names) {
      one.among = one.among || is_right(truths, name);
      one.wrong += is_family(truths, name["family"]) ? 0 : 1;
    }
    one.heldout = over_oracle(truth, in_suite_measure(truth, base, each["heldout_rms"]));
    judged.push_back(one);
  }
  return judged;
}

JudgedBaseline as_baseline(const Judged& judged) {
  JudgedBaseline one;
  one.baseline = "dynid diagnose";
  one.kind = judged.kind;
  one.names = true;
  one.lambda = judged.lambda;
  one.said = judged.found;
  one.first = judged.first && judged.joint;
  if (!judged.answered) return one;
  const Json& truths = judged.truth["truths"];
  for (const Json& finding : judged.answer["findings"]) {
    ++one.count;
    bool known = is_family(truths, finding["family"]);
    one.among = one.among || is_right(truths, finding);
    for (const Json& alias : finding["aliases"]) known = known || is_family(truths, alias);
    one.wrong += known ? 0 : 1;
  }
  one.heldout = judged.heldout;
  return one;
}

std::string baseline_table(const std::vector<JudgedBaseline>& all) {
  std::vector<std::string> methods;
  for (const JudgedBaseline& each : all) {
    if (std::find(methods.begin(), methods.end(), each.baseline) == methods.end()) {
      methods.push_back(each.baseline);
    }
  }
  std::string text =
      "| method | nulls: false alarms | single, lambda of 60 and more: anything found | family and "
      "joint first | among the names | names a case | wrong names a case | held-out rms over the "
      "oracle's, nulls: median, 95th percentile | others "
      "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& method : methods) {
    const auto own = [&](const Test& test) {
      return part(all, [&](const auto& e) { return e.baseline == method && test(e); });
    };
    const Rows every = own([](const auto&) { return true; });
    const Rows nulls = own([](const auto& e) { return e.kind == "null"; });
    const Rows others = own([](const auto& e) { return e.kind != "null"; });
    const Rows strong =
        own([](const auto& e) { return e.kind == "single" && e.lambda >= kStrong; });
    const auto said = [](const JudgedBaseline& e) { return e.said; };
    const auto first = [](const JudgedBaseline& e) { return e.first; };
    const auto among = [](const JudgedBaseline& e) { return e.among; };
    const auto names = [](const JudgedBaseline& e) { return e.count; };
    const auto wrong = [](const JudgedBaseline& e) { return e.wrong; };
    const std::string named =
        every.front()->names
            ? fmt::format("{} | {} | {} | {} | {} | {}", count(nulls, said), count(strong, said),
                          count(strong, first), count(strong, among), mean(every, names),
                          mean(every, wrong))
            : "names nothing | | | | |";
    text += fmt::format("| {} | {} | {} | {} |\n", method, named, heldout(nulls), heldout(others));
  }
  return text;
}

}  // namespace blind

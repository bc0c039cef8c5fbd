// SPDX-License-Identifier: MIT
#include "tests/blind/score/estimates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/blind/score/shares.h"

namespace blind {
namespace {

using Json = nlohmann::json;

constexpr double kAskedErrors = 100;  // lambda from which on errors are asked for

/// A finding of the truth's family on its joint, whose parameters have the truth's names.
bool means_the_same(const Json& finding, const Json& truth) {
  if (finding["family"] != truth["family"] || finding["joint"] != truth["joint"]) return false;
  const std::string formula = truth.value("formula", "");
  if (!formula.empty() && finding["formula"] != formula) return false;
  const auto& wanted = truth["parameters"];
  for (const auto& [name, value] : wanted.items()) {
    if (!finding["parameters"].contains(name)) return false;
  }
  // another member of the family has other parameters besides
  return truth["own_form"].get<bool>() || finding["parameters"].size() == wanted.size();
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

std::string error_row(const std::string& what, const std::vector<Estimate>& all,
                      bool (*taken)(const Estimate&)) {
  std::vector<double> errors;
  for (const Estimate& each : all) {
    if (taken(each) && std::isfinite(each.error())) errors.push_back(each.error());
  }
  const std::size_t count = errors.size();
  if (count == 0) return fmt::format("| {} | none |\n", what);
  return fmt::format("| {} | {:.1f} %, of {} |\n", what, 100 * median(std::move(errors)), count);
}

}  // namespace

double Estimate::error() const {
  return truth != 0 ? std::abs(value - truth) / std::abs(truth)
                    : std::numeric_limits<double>::quiet_NaN();
}

bool Estimate::covered() const { return std::abs(value - truth) <= 1.96 * deviation; }

std::vector<Estimate> estimates(const std::vector<Judged>& all) {
  std::vector<Estimate> result;
  for (const Judged& judged : all) {
    if (!judged.answered) continue;
    for (const Json& truth : judged.truth["truths"]) {
      if (!truth.contains("parameters")) continue;
      const auto& findings = judged.answer["findings"];
      const auto finding = std::find_if(findings.begin(), findings.end(), [&](const Json& each) {
        return means_the_same(each, truth);
      });
      if (finding == findings.end()) continue;
      for (const auto& [name, value] : truth["parameters"].items()) {
        const Json& own = (*finding)["parameters"][name];
        if (!own["value"].is_number()) continue;
        result.push_back(
            {fmt::format("{} {} {}", judged.name, truth["family"].get<std::string>(), name),
             truth["own_form"], truth["lambda"], value, own["value"],
             own["std"].is_number() ? own["std"].get<double>() : 0});
      }
    }
  }
  return result;
}

std::string estimate_table(const std::vector<Judged>& judged) {
  const std::vector<Estimate> all = estimates(judged);
  if (all.empty()) return "";
  std::string text = "| numbers of effects that are named right | |\n|---|---|\n";
  text += error_row("relative error, the catalogue's form, lambda of 100 and more, median", all,
                    [](const Estimate& e) { return !e.own_form && e.lambda >= kAskedErrors; });
  text += error_row("the same, all lambda", all, [](const Estimate& e) { return !e.own_form; });
  text += error_row("another form, the same to first order, lambda of 100 and more", all,
                    [](const Estimate& e) { return e.own_form && e.lambda >= kAskedErrors; });
  for (const bool own_form : {false, true}) {
    int covered = 0, of = 0;
    for (const Estimate& each : all) {
      if (each.own_form != own_form || each.deviation <= 0) continue;
      ++of;
      covered += each.covered();
    }
    text += fmt::format("| intervals of 95 % that hold the truth, {} | {} |\n",
                        own_form ? "another form" : "the catalogue's form",
                        text_of(share_of(covered, of)));
  }
  return text + "\n";
}

}  // namespace blind

// SPDX-License-Identifier: MIT
#include "tests/blind/score/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace blind {
namespace {

using Set = std::vector<const Judged*>;

std::map<double, Set> by_lambda(const Set& singles) {
  std::map<double, Set> steps;
  for (const Judged* each : singles) {
    steps[each->truth["wanted_lambda"].get<double>()].push_back(each);
  }
  return steps;
}

double mean_lambda(const Set& cases) {
  double sum = 0;
  for (const Judged* each : cases) sum += std::log(each->lambda);
  return std::exp(sum / static_cast<double>(cases.size()));
}

Share count(const Set& cases, bool Judged::*right) {
  const auto number =
      std::count_if(cases.begin(), cases.end(), [&](const Judged* e) { return e->*right; });
  return share_of(static_cast<int>(number), static_cast<int>(cases.size()));
}

std::string detection(const Set& singles) {
  std::string text = "lambda,cases,found,found_low,found_high,first,first_low,first_high\n";
  for (const auto& [wanted, cases] : by_lambda(singles)) {
    const Share found = count(cases, &Judged::found), first = count(cases, &Judged::first);
    text += fmt::format("{:.4g},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", mean_lambda(cases),
                        cases.size(), found.value(), found.low, found.high, first.value(),
                        first.low, first.high);
  }
  return text;
}

std::string oracle() {
  std::string text = "lambda,one,two,four,asked\n";
  constexpr int kSteps = 120;
  for (int i = 0; i <= kSteps; ++i) {
    const double lambda = 2 * std::pow(250, static_cast<double>(i) / kSteps);
    text += fmt::format("{:.4g},{:.5f},{:.5f},{:.5f},{:.5f}\n", lambda, oracle_power(lambda, 1),
                        oracle_power(lambda, 2), oracle_power(lambda, 4),
                        oracle_power(lambda, 1, kDiagnosisLevel));
  }
  return text;
}

/// Truths in the order of the alphabet, nulls and foreign physics last; answers in the same order,
/// then what is no name.
std::string confusion(const Set& cases) {
  std::map<std::string, std::map<std::string, int>> counts;
  std::set<std::string> names;
  const std::vector<std::string> unnamed = {"without a name", "clean", "no answer"};
  for (const Judged* each : cases) {
    std::string truth = family_of(*each);
    if (each->kind == "hidden") truth += " (hidden)";
    const std::string answer = first_name(*each);
    ++counts[truth][answer];
    if (std::find(unnamed.begin(), unnamed.end(), answer) == unnamed.end()) names.insert(answer);
  }
  std::vector<std::string> truths, last;
  for (const auto& [truth, answers] : counts) {
    const bool name = truth != "nothing" && truth != "unknown" && truth.back() != ')';
    (name ? truths : last).push_back(truth);
    if (name) names.insert(truth);
  }
  truths.insert(truths.end(), last.begin(), last.end());
  std::vector<std::string> columns(names.begin(), names.end());
  for (const std::string& each : unnamed) columns.push_back(each);
  std::string text = "truth";
  for (const std::string& column : columns) text += "," + column;
  text += "\n";
  for (const std::string& truth : truths) {
    text += truth == "unknown" ? "foreign" : truth;
    for (const std::string& column : columns) {
      const auto found = counts[truth].find(column);
      text += fmt::format(",{}", found == counts[truth].end() ? 0 : found->second);
    }
    text += "\n";
  }
  return text;
}

/// Both columns rise by themselves: two distributions.
std::string heldout(const Set& singles) {
  std::vector<double> before, after;
  for (const Judged* each : singles) {
    if (!each->found || each->heldout <= 0) continue;
    before.push_back(each->heldout_before);
    after.push_back(each->heldout);
  }
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  std::string text = "share,before,after\n";
  for (std::size_t i = 0; i < after.size(); ++i) {
    text += fmt::format("{:.4f},{:.5f},{:.5f}\n",
                        (static_cast<double>(i) + 1) / static_cast<double>(after.size()), before[i],
                        after[i]);
  }
  return text;
}

std::string concealed(const Set& singles) {
  std::vector<std::string> rows;
  for (const Judged* each : singles) {
    rows.push_back(
        fmt::format("{:.4f},{:.6f},{:.3f}\n", each->absorbed, each->excess, each->lambda));
  }
  std::sort(rows.begin(), rows.end());
  std::string text = "absorbed,excess,lambda\n";
  for (const std::string& row : rows) text += row;
  return text;
}

}  // namespace

std::vector<std::pair<double, Share>> detection_steps(const Set& singles) {
  std::vector<std::pair<double, Share>> steps;
  for (const auto& [wanted, cases] : by_lambda(singles)) {
    steps.emplace_back(mean_lambda(cases), count(cases, &Judged::found));
  }
  return steps;
}

std::map<std::string, std::string> figures(const std::vector<Judged>& all) {
  Set singles, one_truth;
  for (const Judged& each : all) {
    if (each.kind == "single") singles.push_back(&each);
    if (each.kind != "pair" && each.kind != "crowd") one_truth.push_back(&each);
  }
  std::map<std::string, std::string> files;
  if (!one_truth.empty()) files["confusion.csv"] = confusion(one_truth);
  if (singles.empty()) return files;
  files["detection.csv"] = detection(singles);
  files["oracle.csv"] = oracle();
  files["concealed.csv"] = concealed(singles);
  files["heldout.csv"] = heldout(singles);
  std::erase_if(files, [](const auto& file) {
    return std::count(file.second.begin(), file.second.end(), '\n') < 2;
  });
  return files;
}

}  // namespace blind

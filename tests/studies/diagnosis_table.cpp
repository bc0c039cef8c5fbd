// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace dyngen::test {
namespace {

using Scores = std::vector<const CaseScore*>;

/// P(X <= k) of the binomial distribution.
double binomial_below(int k, int n, double p) {
  if (p <= 0) return 1;
  if (p >= 1) return k >= n ? 1 : 0;
  double sum = 0;
  for (int i = 0; i <= k; ++i) {
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                    i * std::log(p) + (n - i) * std::log1p(-p));
  }
  return sum;
}

/// Where a falling function of p in 0 .. 1 is 0.
double root(const std::function<double(double)>& falling) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (falling(middle) > 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

double quantile(std::vector<double> values, double part) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(
      std::floor(part * static_cast<double>(values.size() - 1) + 0.5))];
}

Rate rate(const Scores& scores, const std::function<bool(const CaseScore&)>& hit) {
  Rate result;
  for (const CaseScore* score : scores) result.add(hit(*score));
  return result;
}

Scores those(const Scores& scores, const std::function<bool(const CaseScore&)>& wanted) {
  Scores result;
  for (const CaseScore* score : scores) {
    if (wanted(*score)) result.push_back(score);
  }
  return result;
}

std::string numbers(const Scores& scores) {
  std::vector<double> heldout, base, errors, seconds;
  Rate covered;
  for (const CaseScore* s : scores) {
    heldout.push_back(s->heldout);
    base.push_back(s->base_heldout);
    errors.insert(errors.end(), s->errors.begin(), s->errors.end());
    covered.hits += s->covered;
    covered.of += s->intervals;
    seconds.push_back(s->seconds);
  }
  std::string text = fmt::format(
      "Held-out rms over the oracle's: median {:.4f}, 95th percentile {:.4f}; of the "
      "base model {:.4f} and {:.4f}. Seconds a case: median {:.1f}, most {:.1f}.",
      quantile(heldout, 0.5), quantile(heldout, 0.95), quantile(base, 0.5), quantile(base, 0.95),
      quantile(seconds, 0.5), quantile(seconds, 1));
  if (covered.of > 0) {
    text += fmt::format(
        " Parameters of effects that were named: median error {:.1f} %, intervals cover {}.",
        100 * quantile(errors, 0.5), covered.text());
  }
  return text + "\n";
}

/// A row for each value of a key.
std::string by(const Scores& scores, const std::string& key,
               const std::function<std::string(const CaseScore&)>& key_of) {
  std::map<std::string, Scores> groups;
  std::vector<std::string> order;
  for (const CaseScore* s : scores) {
    Scores& group = groups[key_of(*s)];
    if (group.empty()) order.push_back(key_of(*s));
    group.push_back(s);
  }
  std::string text = fmt::format(
      "| {} | found | joint right, of found | family first, of separable and found | truth among "
      "aliases, of named | aliases | confident wrong | held-out, median |\n"
      "|---|---|---|---|---|---:|---|---:|\n",
      key);
  for (const std::string& name : order) {
    const Scores& group = groups[name];
    const Scores found = those(group, [](const CaseScore& s) { return s.detected; });
    const Scores named = those(group, [](const CaseScore& s) { return s.aliases > 0; });
    double aliases = 0;
    std::vector<double> heldout;
    for (const CaseScore* s : named) aliases += s->aliases;
    for (const CaseScore* s : group) heldout.push_back(s->heldout);
    const Scores clear = those(found, [](const CaseScore& s) { return s.separable; });
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {:.3f} |\n", name,
        rate(group, [](const CaseScore& s) { return s.detected; }).text(),
        rate(found, [](const CaseScore& s) { return s.joint_right; }).text(),
        rate(clear, [](const CaseScore& s) { return s.family_right; }).text(),
        rate(named, [](const CaseScore& s) { return s.in_aliases; }).text(),
        named.empty() ? "" : fmt::format("{:.1f}", aliases / static_cast<double>(named.size())),
        rate(group, [](const CaseScore& s) { return s.confident_wrong; }).text(),
        quantile(heldout, 0.5));
  }
  return text + "\n";
}

/// Truth down, the first answer across; "-" where nothing was found.
std::string confusion(const Scores& scores) {
  std::map<std::string, std::map<std::string, int>> counts;
  std::set<std::string> answers;
  for (const CaseScore* s : scores) {
    const std::string truth = s->true_families.empty()
                                  ? (s->kind == CaseKind::kNull ? "null" : "foreign")
                                  : s->true_families.front();
    const std::string answer = s->answered.empty() ? "-" : s->answered.front();
    ++counts[truth][answer];
    answers.insert(answer);
  }
  std::string text = "| truth |";
  std::string line = "|---|";
  for (const std::string& answer : answers) {
    text += " " + answer + " |";
    line += "---:|";
  }
  text += "\n" + line + "\n";
  for (const auto& [truth, row] : counts) {
    text += "| " + truth + " |";
    for (const std::string& answer : answers) {
      const auto place = row.find(answer);
      text += place == row.end() ? " |" : fmt::format(" {} |", place->second);
    }
    text += "\n";
  }
  return text + "\n";
}

std::string baseline_table(const Scores& scores) {
  std::map<std::string, std::map<std::string, std::vector<const BaselineScore*>>> groups;
  for (const CaseScore* s : scores) {
    for (const BaselineScore& b : s->baselines) groups[b.method][case_name(s->kind)].push_back(&b);
  }
  if (groups.empty()) return "";
  std::string text =
      "### Baselines\n\n| method | cases | names anything | names something wrong | names a case | "
      "first name right |\n|---|---|---|---|---:|---|\n";
  for (const auto& [method, kinds] : groups) {
    for (const auto& [kind, list] : kinds) {
      Rate any, wrong, first;
      double names = 0;
      for (const BaselineScore* b : list) {
        any.add(b->names > 0);
        wrong.add(b->wrong > 0);
        first.add(b->first_right);
        names += b->names;
      }
      text += fmt::format("| {} | {} | {} | {} | {:.1f} | {} |\n", method, kind, any.text(),
                          wrong.text(), names / static_cast<double>(list.size()),
                          kind == "null" ? "" : first.text());
    }
  }
  return text + "\n";
}

/// How often the first name is right, by the probability that the answer gives it.
std::string calibration(const Scores& scores) {
  constexpr std::array<double, 5> kFrom = {0, 0.6, 0.8, 0.95, 1.01};
  std::string text;
  double error = 0, count = 0;
  for (std::size_t bin = 0; bin + 1 < kFrom.size(); ++bin) {
    Rate right;
    double stated = 0;
    for (const CaseScore* s : scores) {
      if (s->probability <= 0 || s->probability < kFrom[bin] || s->probability >= kFrom[bin + 1]) {
        continue;
      }
      right.add(s->family_right);
      stated += s->probability;
    }
    if (right.of == 0) continue;
    const double mean = stated / right.of;
    error += std::abs(stated - right.hits);
    count += right.of;
    text += fmt::format("| {:g} to {:g} | {} | {:.3f} | {} |\n", kFrom[bin],
                        std::min(kFrom[bin + 1], 1.0), right.of, mean, right.text());
  }
  if (text.empty()) return "";
  return "Probabilities of first names, and how often they were right:\n\n"
         "| stated | names | mean | right |\n|---|---:|---:|---|\n" +
         text +
         fmt::format("\nMean difference (expected calibration error): {:.3f}.\n\n", error / count);
}

/// What is wrong with an answer; empty: nothing.
std::string failing(const CaseScore& s) {
  if (!s.failure.empty()) return "failed";
  switch (s.kind) {
    case CaseKind::kNull:
      return s.detected ? "false alarm" : "";
    case CaseKind::kTheorem:
      if (s.detected) return "false name";
      return s.undecidable ? "" : "not said to be undecidable";
    case CaseKind::kUnknown:
      if (s.confident_wrong) return "confident wrong name";
      if (s.unknown) return "";
      return s.detected ? "a name, not flagged" : s.lambda >= 60 ? "not found" : "";
    default:
      break;
  }
  if (s.confident_wrong) return "confident wrong name";
  if (!s.detected) return s.lambda >= 60 ? "not found" : "";
  if (!s.joint_right) return "wrong joint";
  if (s.separable && !s.family_right) return "wrong family";
  if (s.aliases > 0 && !s.in_aliases) return "truth not among aliases";
  if (s.kind == CaseKind::kPair && s.spurious > 0) return "a third name";
  if (s.heldout > 1.08) return "held-out";
  return "";
}

std::string of_kind(CaseKind kind, const Scores& scores) {
  std::string text = fmt::format("### {} ({} cases)\n\n", case_name(kind), scores.size());
  const auto noise = [](const CaseScore& s) { return case_name(s.noise); };
  switch (kind) {
    case CaseKind::kNull: {
      text +=
          "False alarms: " + rate(scores, [](const CaseScore& s) { return s.detected; }).text() +
          ".\n\n";
      text += "| noise | false alarms |\n|---|---|\n";
      std::map<std::string, Rate> groups;
      for (const CaseScore* s : scores) groups[noise(*s)].add(s->detected);
      for (const auto& [name, alarms] : groups) {
        text += fmt::format("| {} | {} |\n", name, alarms.text());
      }
      text += "\n";
      break;
    }
    case CaseKind::kTheorem:
      text += "Answered as undecidable, without a name: " +
              rate(scores, [](const CaseScore& s) { return s.undecidable && !s.detected; }).text() +
              "; anything found: " +
              rate(scores, [](const CaseScore& s) { return s.detected; }).text() + ".\n\n";
      break;
    case CaseKind::kUnknown:
      text +=
          "Found: " + rate(scores, [](const CaseScore& s) { return s.detected; }).text() +
          "; flagged as unknown: " +
          rate(scores, [](const CaseScore& s) { return s.unknown; }).text() +
          "; of those that no effect imitates: " +
          rate(those(scores, [](const CaseScore& s) { return s.separable; }),
               [](const CaseScore& s) { return s.unknown; })
              .text() +
          "; flagged, or no confident name: " +
          rate(scores,
               [](const CaseScore& s) { return s.unknown || (s.detected && !s.confident_wrong); })
              .text() +
          "; confident names: " +
          rate(scores, [](const CaseScore& s) { return s.confident_wrong; }).text() + ".\n\n";
      text +=
          by(scores, "lambda", [](const CaseScore& s) { return fmt::format("{:g}", s.lambda); });
      break;
    default:
      text +=
          by(scores, "lambda", [](const CaseScore& s) { return fmt::format("{:g}", s.lambda); });
      text += by(scores, "noise", noise);
      text += by(scores, "robot", [](const CaseScore& s) { return s.robot; });
      text += calibration(scores);
  }
  if (kind == CaseKind::kPair) {
    text +=
        "Both named: " + rate(scores, [](const CaseScore& s) { return s.named == 2; }).text() +
        "; at least one: " + rate(scores, [](const CaseScore& s) { return s.named > 0; }).text() +
        "; a third name: " +
        rate(scores, [](const CaseScore& s) { return s.spurious > 0; }).text() + ".\n\n";
  }
  return text + numbers(scores) + "\n";
}

}  // namespace

double Rate::low() const {
  if (hits == 0) return 0;
  return root([this](double p) { return 0.025 - (1 - binomial_below(hits - 1, of, p)); });
}

double Rate::high() const {
  if (hits == of) return 1;
  return root([this](double p) { return binomial_below(hits, of, p) - 0.025; });
}

std::string Rate::text() const {
  if (of == 0) return "";
  return fmt::format("{:.1f} % ({}/{}, {:.1f} to {:.1f})", 100.0 * hits / of, hits, of, 100 * low(),
                     100 * high());
}

std::string tables(const std::vector<CaseScore>& scores) {
  std::map<CaseKind, Scores> kinds;
  Scores all;
  for (const CaseScore& score : scores) {
    if (!score.failure.empty()) continue;
    kinds[score.kind].push_back(&score);
    all.push_back(&score);
  }
  std::string text;
  for (const auto& [kind, own] : kinds) text += of_kind(kind, own);
  text += baseline_table(all);
  text += "### Truth and first answer\n\n" + confusion(all);
  std::string failures;
  for (const CaseScore& score : scores) {
    const std::string what = failing(score);
    if (!what.empty()) failures += fmt::format("- **{}**: {}\n", what, in_words(score));
  }
  return text + "### Failures\n\n" + (failures.empty() ? "none\n" : failures);
}

}  // namespace dyngen::test

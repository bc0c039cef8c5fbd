// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "tests/blind/score/estimates.h"
#include "tests/blind/score/figures.h"
#include "tests/blind/score/habits.h"
#include "tests/blind/score/score.h"
#include "tests/blind/score/shares.h"

namespace blind {
namespace {

using Set = std::vector<const Judged*>;
using Test = std::function<bool(const Judged&)>;

Set part(const Set& all, const Test& test) {
  Set some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const Judged* each) { return test(*each); });
  return some;
}

std::string rate(const Set& of, const Test& test) {
  const auto right = std::count_if(of.begin(), of.end(), [&](const Judged* e) { return test(*e); });
  return text_of(share_of(static_cast<int>(right), static_cast<int>(of.size())));
}

double quantile(const Set& of, double share, const std::function<double(const Judged&)>& value) {
  std::vector<double> values;
  for (const Judged* each : of) values.push_back(value(*each));
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - std::floor(place)) * (values[high] - values[low]);
}

std::string row(const std::string& what, const std::string& value) {
  return fmt::format("| {} | {} |\n", what, value);
}

/// Share that who knows the form is expected to find. @param known  what is left of lambda
std::string expected(const Set& of, const std::function<double(const Judged&)>& known,
                     double level = kOracleLevel) {
  double sum = 0;
  for (const Judged* each : of) sum += oracle_power(known(*each), 1, level);
  return fmt::format("{:.1f} %", 100 * sum / static_cast<double>(of.size()));
}

double whole(const Judged& each) { return each.lambda; }
double reached(const Judged& each) { return each.filtered; }
double slow(const Judged& each) { return each.slow.value_or(0); }

double in_equations(const Judged& each) { return each.reach.value_or(0); }

bool are_measured(const Set& all, std::optional<double> Judged::*what = &Judged::slow) {
  return std::all_of(all.begin(), all.end(),
                     [&](const Judged* e) { return (e->*what).has_value(); });
}

/// Of 60 and more, within the accuracy that sizes are found with.
constexpr double kStrong = 53;
bool is_strong(const Judged& each) { return each.lambda >= kStrong; }

std::string concealment(const Set& singles) {
  std::string text = "| concealment of the single effects | |\n|---|---|\n";
  text += row("absorbed by the refit, 70 % and more",
              rate(singles, [](const Judged& e) { return e.absorbed >= 0.7; }));
  text += row("absorbed by the refit, 90 % and more",
              rate(singles, [](const Judged& e) { return e.absorbed >= 0.9; }));
  text += row("residual above the floor, median",
              fmt::format("{:.2f} %",
                          100 * quantile(singles, 0.5, [](const Judged& e) { return e.excess; })));
  text += row("forms that are not the catalogue's", rate(singles, [](const Judged& e) {
                return e.truth["truths"][0]["own_form"].get<bool>();
              }));
  return text + "\n";
}

std::string single_table(const Set& singles) {
  const Set strong = part(singles, is_strong);
  const Set found = part(strong, [](const Judged& e) { return e.found; });
  const auto is_named = [](const Judged& e) { return e.answered && !e.answer["findings"].empty(); };
  const Set named = part(strong, is_named);
  const Set separable = part(strong, [](const Judged& e) { return e.separable; });
  std::string text = "| single effects, lambda of 60 and more | |\n|---|---|\n";
  text += row("found", rate(strong, [](const Judged& e) { return e.found; }));
  if (!strong.empty()) {
    text += row("found by who knows the form, and has what is below 20 Hz, away from rests",
                expected(strong, reached));
    text += row("the same, by as many tests and as few false alarms as a diagnosis",
                expected(strong, reached, kDiagnosisLevel));
    if (are_measured(strong)) {
      text += row(
          "the same, of what is below 40 Hz without the instants of stops, turns and letting go",
          expected(strong, slow, kDiagnosisLevel));
    }
    if (are_measured(strong, &Judged::reach)) {
      text += row("the same, of what is in dynid's own equations",
                  expected(strong, in_equations, kDiagnosisLevel));
    }
    if (are_measured(singles, &Judged::again)) {
      text += row("found, of those that are of 60 and more when lambda is measured again",
                  rate(part(singles, [](const Judged& e) { return *e.again >= kStrong; }),
                       [](const Judged& e) { return e.found; }));
    }
  }
  text += row("named", rate(strong, is_named));
  text += row("joint right, of those named", rate(named, [](const Judged& e) { return e.joint; }));
  text += row("family first, of separable ones that are named",
              rate(part(named, [](const Judged& e) { return e.separable; }),
                   [](const Judged& e) { return e.first; }));
  text += row("separable", rate(strong, [](const Judged& e) { return e.separable; }));
  text += row("truth among the aliases, of those named",
              rate(named, [](const Judged& e) { return e.among; }));
  double names = 0;
  for (const Judged* each : named) names += each->aliases;
  text +=
      row("names in a set, mean",
          fmt::format("{:.2f}", names / std::max<double>(1, static_cast<double>(named.size()))));
  text +=
      row("confident wrong names", rate(strong, [](const Judged& e) { return e.confident_wrong; }));
  const auto ratio = [](const Judged& e) { return e.heldout; };
  text +=
      row("held-out rms over the oracle's, median, 95th percentile",
          fmt::format("{:.3f}, {:.3f}", quantile(found, 0.5, ratio), quantile(found, 0.95, ratio)));
  text += row(
      "held-out gap closed, median",
      fmt::format("{:.2f}", quantile(found, 0.5, [](const Judged& e) { return e.gap_closed; })));
  return text + "\n";
}

std::string ladder(const Set& singles) {
  std::string text =
      "| wanted lambda | found | by who knows the form | and has what is below 20 Hz, away from "
      "rests | by as many tests and as few false alarms as a diagnosis | and has what is below 40 "
      "Hz without the instants | family first | confident wrong "
      "|\n|---|---|---|---|---|---|---|---|\n";
  std::set<double> steps;
  for (const Judged* each : singles) steps.insert(each->truth["wanted_lambda"].get<double>());
  for (const double step : steps) {
    const Set here =
        part(singles, [&](const Judged& e) { return e.truth["wanted_lambda"] == step; });
    text += fmt::format("| {:g} | {} | {} | {} | {} | {} | {} | {} |\n", step,
                        rate(here, [](const Judged& e) { return e.found; }), expected(here, whole),
                        expected(here, reached), expected(here, reached, kDiagnosisLevel),
                        are_measured(here) ? expected(here, slow, kDiagnosisLevel) : "not measured",
                        rate(here, [](const Judged& e) { return e.first; }),
                        rate(here, [](const Judged& e) { return e.confident_wrong; }));
  }
  const double half = half_detected(detection_steps(singles)), best = oracle_lambda(0.5, 1);
  text +=
      fmt::format("\nHalf is found at lambda {}; by who knows its form at {:.1f}{}.\n",
                  std::isfinite(half) ? fmt::format("{:.0f}", half) : "that is not in the set",
                  best, std::isfinite(half) ? fmt::format(": efficiency {:.2f}", best / half) : "");
  return text + "\n";
}

/// By what is left of lambda to who does not know all. @param what  is known
std::string known_ladder(const Set& singles, const std::string& what,
                         const std::function<double(const Judged&)>& known) {
  constexpr std::array<double, 7> kEdges = {0, 5, 10, 20, 40, 80, 1e9};
  std::string text = fmt::format(
      "| lambda {} | found | by who knows the form and has that much |\n|---|---|---|\n", what);
  for (std::size_t i = 0; i + 1 < kEdges.size(); ++i) {
    const Set here = part(singles, [&](const Judged& e) {
      return known(e) >= kEdges[i] && known(e) < kEdges[i + 1];
    });
    if (here.empty()) continue;
    const std::string range = i + 2 < kEdges.size()
                                  ? fmt::format("{:g} to {:g}", kEdges[i], kEdges[i + 1])
                                  : fmt::format("{:g} and more", kEdges[i]);
    text += fmt::format("| {} | {} | {} |\n", range,
                        rate(here, [](const Judged& e) { return e.found; }), expected(here, known));
  }
  const Set strong = part(singles, is_strong);
  return text +
         fmt::format(
             "\nOf effects of lambda 60 and more the median has {:.0f} % of it there.\n\n",
             100 * quantile(strong, 0.5, [&](const Judged& e) { return known(e) / e.lambda; }));
}

std::string known_ladders(const Set& singles) {
  std::string text = known_ladder(singles, "below 20 Hz, away from rests", reached);
  const Set measured = part(singles, [](const Judged& e) { return e.instants.has_value(); });
  if (!measured.empty()) {
    text += known_ladder(measured, "without the instants of stops, turns and letting go",
                         [](const Judged& e) { return e.instants.value_or(0); });
  }
  if (!singles.empty() && are_measured(singles, &Judged::reach)) {
    text += known_ladder(singles, "in dynid's own equations", in_equations);
  }
  return text;
}

/// What the equations hold of physics outside the catalogue. No test of a diagnosis knows its form;
/// without a form only what repeats is seen.
std::string foreign_table(const Set& foreign) {
  std::string text =
      "| foreign | lambda | in dynid's own equations | of it in what repeats | first answer "
      "|\n|---|---|---|---|---|\n";
  for (const Judged* each : foreign) {
    text += fmt::format("| {} | {:.0f} | {:.0f} | {:.0f} | {} |\n",
                        each->truth["truths"][0]["form"].get<std::string>(), each->lambda,
                        each->reach.value_or(0), each->repeating.value_or(0), first_name(*each));
  }
  return text + "\n";
}

std::string confusion(const Set& all) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Judged* each : all) ++counts[family_of(*each)][first_name(*each)];
  std::string text = "| truth | first answer, how often |\n|---|---|\n";
  for (const auto& [truth, answers] : counts) {
    std::string said;
    for (const auto& [name, count] : answers) {
      said += fmt::format("{}{} {}", said.empty() ? "" : ", ", name, count);
    }
    text += row(truth, said);
  }
  return text + "\n";
}

}  // namespace

std::string broken(const std::vector<Judged>& judged, const Bounds& bounds) {
  std::string text;
  const auto share = [&](const Test& among, const Test& test) {
    double of = 0, right = 0;
    for (const Judged& each : judged) {
      of += among(each);
      right += among(each) && test(each);
    }
    return of > 0 ? right / of : std::nan("");
  };
  const auto most = [&](const char* what, double found, double bound) {
    if (found > bound) text += fmt::format("{}: {:.3f}, at most {:g}\n", what, found, bound);
  };
  const auto least = [&](const char* what, double found, double bound) {
    if (found < bound) text += fmt::format("{}: {:.3f}, at least {:g}\n", what, found, bound);
  };
  const Test strong = [](const Judged& e) { return e.kind == "single" && is_strong(e); };
  most("false alarms of nulls",
       share([](const Judged& e) { return e.kind == "null"; },
             [](const Judged& e) { return e.found; }),
       bounds.most_false_alarms);
  most("confident wrong names",
       share([](const Judged& e) { return e.kind == "single" || e.kind == "foreign"; },
             [](const Judged& e) { return e.confident_wrong; }),
       bounds.most_confident_wrong);
  least("single effects found", share(strong, [](const Judged& e) { return e.found; }),
        bounds.least_found);
  least("family first", share(strong, [](const Judged& e) { return e.first; }), bounds.least_first);
  return text;
}

std::string tables(const std::vector<Judged>& judged) {
  Set all;
  for (const Judged& each : judged) all.push_back(&each);
  const auto kind = [&](const std::string& name) {
    return part(all, [&](const Judged& e) { return e.kind == name; });
  };
  std::string text = "| | |\n|---|---|\n";
  const auto add = [&](const std::string& what, const Set& of, const Test& test) {
    if (!of.empty()) text += row(what, rate(of, test));
  };
  add("answered", all, [](const Judged& e) { return e.answered; });
  add("nulls: false alarms", kind("null"), [](const Judged& e) { return e.found; });
  add("pairs: both named", kind("pair"), [](const Judged& e) { return e.both; });
  add("pairs: one at least", kind("pair"), [](const Judged& e) { return e.one; });
  add("pairs: a third name", kind("pair"), [](const Judged& e) { return e.third; });
  add("hidden: among the undecidable, and nothing found", kind("hidden"),
      [](const Judged& e) { return e.undecidable && !e.found; });
  add("hidden: anything found", kind("hidden"), [](const Judged& e) { return e.found; });
  add("foreign: flagged, without a confident name", kind("foreign"),
      [](const Judged& e) { return e.flagged; });
  add("foreign: anything found", kind("foreign"), [](const Judged& e) { return e.found; });
  add("foreign: confident names", kind("foreign"),
      [](const Judged& e) { return e.confident_wrong; });
  add("passing: family first", kind("passing"), [](const Judged& e) { return e.first; });
  add("passing: found", kind("passing"), [](const Judged& e) { return e.found; });
  text += "\n";
  const Set singles = kind("single");
  if (!singles.empty())
    text += concealment(singles) + single_table(singles) + ladder(singles) + known_ladders(singles);
  const Set foreign = kind("foreign");
  if (!foreign.empty() && are_measured(foreign, &Judged::repeating)) text += foreign_table(foreign);
  text += habit_table(judged) + crowd_table(judged) + estimate_table(judged);
  return text + confusion(part(all, [](const Judged& e) { return e.kind != "crowd"; }));
}

}  // namespace blind

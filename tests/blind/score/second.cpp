// SPDX-License-Identifier: MIT
#include "tests/blind/score/second.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "tests/blind/score/shares.h"

namespace blind {
namespace {

using Json = nlohmann::json;
using Outcome = Second::Outcome;

const Json* open_finding(const Json& answer) {
  if (!answer.is_object() || !answer.contains("findings")) return nullptr;
  for (const Json& finding : answer["findings"]) {
    if (finding["aliases"].size() > 1) return &finding;
  }
  return nullptr;
}

std::vector<std::string> names_of(const Json& finding) {
  std::vector<std::string> names = finding["aliases"];
  if (names.empty()) names.push_back(finding["family"]);
  return names;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool same_place(const Json& finding, const Json& other) {
  const int joint = finding["joint"], before = other["joint"];
  return joint == before || joint == 0 || before == 0;
}

/// Whether another finding of the answer, which has one name, is a truth already.
bool is_named(const Json& truth, const Json& answer, const Json& but) {
  return std::any_of(
      answer["findings"].begin(), answer["findings"].end(), [&](const Json& finding) {
        return &finding != &but && names_of(finding) == std::vector<std::string>{truth["family"]} &&
               same_place(finding, truth);
      });
}

/// The truth that the names are about, of those that no other finding is: one of theirs and of the
/// joint, else one of theirs, else one of the joint, else the first. Null: there is none.
const Json* truth_of(const Json& truths, const Json& answer, const Json& finding,
                     const std::vector<std::string>& names) {
  const auto first = [&](auto&& test) -> const Json* {
    const auto found = std::find_if(truths.begin(), truths.end(), [&](const Json& truth) {
      return !is_named(truth, answer, finding) && test(truth);
    });
    return found == truths.end() ? nullptr : &*found;
  };
  const auto of_names = [&](const Json& truth) { return holds(names, truth["family"]); };
  const auto of_place = [&](const Json& truth) { return same_place(finding, truth); };
  const Json* found = first([&](const Json& truth) { return of_names(truth) && of_place(truth); });
  if (found == nullptr) found = first(of_names);
  if (found == nullptr) found = first(of_place);
  return found != nullptr ? found : first([](const Json&) { return true; });
}

/// What of the second answer stands where the names were: their truth, a name of theirs, any
/// finding of the place.
const Json* successor(const Json& findings, const Json& before, const Json* truth,
                      const std::vector<std::string>& names) {
  const auto first = [&](auto&& test) -> const Json* {
    const auto found = std::find_if(findings.begin(), findings.end(), test);
    return found == findings.end() ? nullptr : &*found;
  };
  const Json* found = nullptr;
  if (truth != nullptr) {
    found = first([&](const Json& each) { return holds(names_of(each), (*truth)["family"]); });
  }
  if (found == nullptr) {
    found = first([&](const Json& each) { return holds(names, each["family"]); });
  }
  if (found == nullptr) {
    found = first([&](const Json& each) { return same_place(each, before); });
  }
  return found;
}

}  // namespace

bool leaves_names(const Json& answer) { return open_finding(answer) != nullptr; }

Second judge_second(const Judged& judged, const Json& second, const Json& asked) {
  const Json& open = *open_finding(judged.answer);
  Second result;
  result.name = judged.name;
  result.before = names_of(open);
  const Json* const truth = truth_of(judged.truth["truths"], judged.answer, open, result.before);
  result.nameable = truth != nullptr && judged.kind != "hidden" && (*truth)["family"] != "unknown";
  result.held = result.nameable && holds(result.before, (*truth)["family"]);
  if (asked.is_object() && asked.value("found", false)) {
    const Json& motion = asked["trajectory"];
    result.separation = asked["separation"].is_number() ? asked["separation"].get<double>() : 0;
    result.duration = motion["period"].get<double>() * motion["periods"].get<double>();
  }
  if (!second.is_object() || second.value("schema", "") != "dynid.diagnosis/1") return result;
  result.too_many = second["findings"].size() > judged.truth["truths"].size();
  const Json* const now = successor(second["findings"], open, truth, result.before);
  if (now == nullptr) {
    result.outcome = result.nameable ? Outcome::kLost : Outcome::kRight;
    return result;
  }
  result.after = names_of(*now);
  if (result.after.size() > 1) {
    result.outcome = Outcome::kOpen;
  } else {
    const bool right = result.nameable && result.after.front() == (*truth)["family"];
    result.outcome = right ? Outcome::kRight : Outcome::kWrong;
  }
  return result;
}

std::string second_table(const std::vector<Second>& all) {
  std::string text = "| one more recording where names were left | |\n|---|---|\n";
  const auto row = [&](const std::string& what, int right, int of) {
    text += fmt::format("| {} | {} |\n", what, text_of(share_of(right, of)));
  };
  std::map<Outcome, int> counts;
  int nameable = 0, held = 0, held_right = 0, too_many = 0, no_name = 0, no_name_right = 0;
  std::vector<double> durations;
  for (const Second& each : all) {
    if (each.duration > 0) durations.push_back(each.duration);
    if (!each.nameable) {
      ++no_name;
      no_name_right += each.outcome == Outcome::kRight;
      continue;
    }
    ++nameable;
    ++counts[each.outcome];
    held += each.held;
    too_many += each.outcome == Outcome::kRight && each.too_many;
    held_right += each.held && each.outcome == Outcome::kRight;
  }
  row("sets of names, resolved to the truth", counts[Outcome::kRight], nameable);
  row("of those that held the truth", held_right, held);
  row("resolved, with a finding too many beside it", too_many, counts[Outcome::kRight]);
  row("resolved to a wrong name", counts[Outcome::kWrong], nameable);
  row("several names still", counts[Outcome::kOpen], nameable);
  row("nothing named any more", counts[Outcome::kLost], nameable);
  row("no motion, or no answer", counts[Outcome::kNotAsked], nameable);
  row("sets where no name is right, withdrawn", no_name_right, no_name);
  if (!durations.empty()) {
    std::sort(durations.begin(), durations.end());
    text +=
        fmt::format("| length of what was asked for, least, median, most | {:g}, {:g}, {:g} s |\n",
                    durations.front(), durations[durations.size() / 2], durations.back());
  }
  return text + "\n";
}

std::string second_lines(const std::vector<Second>& all) {
  static const std::map<Outcome, const char*> kWords = {{Outcome::kRight, "right"},
                                                        {Outcome::kWrong, "wrong"},
                                                        {Outcome::kOpen, "open"},
                                                        {Outcome::kLost, "lost"},
                                                        {Outcome::kNotAsked, "not asked"}};
  std::string text;
  for (const Second& each : all) {
    text += fmt::format(
        "{}: {} -> {} ({}; separation {:.3g}, {:g} s{})\n", each.name,
        fmt::join(each.before, " or "),
        each.after.empty() ? "nothing" : fmt::format("{}", fmt::join(each.after, " or ")),
        kWords.at(each.outcome), each.separation, each.duration,
        each.nameable && !each.held ? "; the truth was not among them" : "");
  }
  return text;
}

}  // namespace blind

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace dyngen::runtime {
namespace {

/// Part of a joint's structure that has no name.
double nameless_part(const Search& search, const std::vector<Finding>& findings,
                     const Nameless& nameless) {
  const CompetitionResult& result = search.result();
  double named = 0;
  for (std::size_t i = 0; i < result.winners.size(); ++i) {
    const std::vector<int> joints = joints_of(
        search.hypotheses()[result.winners[i].hypothesis].effect, search.sets().train.joints());
    if (std::find(joints.begin(), joints.end(), nameless.structure.joint) == joints.end()) {
      continue;
    }
    named += findings[i].evidence.lambda;
  }
  const double left = std::max(0.0, nameless.score.delta_chi2 - nameless.score.degrees);
  return left / std::max(left + named, 1e-300);
}

std::string explanation(const std::vector<Finding>& findings, double probable) {
  const auto changes = std::count_if(findings.begin(), findings.end(),
                                     [](const Finding& own) { return own.since_reference; });
  const auto uncertain = std::count_if(findings.begin(), findings.end(), [&](const Finding& own) {
    return !own.since_reference && own.uncertain;
  });
  const auto effects = static_cast<std::ptrdiff_t>(findings.size()) - changes - uncertain;
  std::string text;
  if (effects > 0) {
    text = fmt::format("{} left-out effect{} explain{} what the model leaves.", effects,
                       effects == 1 ? "" : "s", effects == 1 ? "s" : "");
  }
  if (uncertain > 0) {
    text += fmt::format(
        "{}{} effect{} {} found whose name{} uncertain (probability below {:g}, or a "
        "test against it).",
        text.empty() ? "" : " ", uncertain, uncertain == 1 ? "" : "s",
        uncertain == 1 ? "was" : "were", uncertain == 1 ? " is" : "s are", probable);
  }
  if (changes > 0) {
    text += fmt::format(
        "{}{} change{} since the reference recordings, which the model's own "
        "parameters have taken up.",
        text.empty() ? "" : " ", changes, changes == 1 ? "" : "s");
  }
  return text;
}

}  // namespace

bool found_nothing(const CompetitionResult& result) {
  return result.winners.empty() && result.nameless.empty();
}

std::string why_too_slow(const CompetitionResult& result, const NoiseRules& rules) {
  const Eigen::VectorXd& worth = result.noise.worth;
  Eigen::Index joint = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < worth.size(); ++j) {
    if (!(worth[j] > 0) || worth[j] >= least) continue;  // 0: a joint without equations
    joint = j;
    least = worth[j];
  }
  if (least >= rules.least_independent) return {};
  return fmt::format(
      "What the model leaves of joint {} is so slow that the recordings are worth {:.0f} "
      "independent samples: too few to tell structure from noise.",
      joint + 1, least);
}

std::string why_cut_off(const CompetitionResult& result) {
  if (result.cut_off.empty()) return {};
  return fmt::format("Nothing was found before the effort was spent; not searched: {}.",
                     fmt::join(result.cut_off, ", "));
}

std::string not_judged_sentence(const std::vector<UnjudgedJoint>& unjudged) {
  if (unjudged.empty()) return {};
  std::vector<int> joints;
  bool stand = true;
  for (const UnjudgedJoint& own : unjudged) {
    joints.push_back(own.joint + 1);
    stand = stand && !(own.equations > 0);
  }
  const bool one = joints.size() == 1;
  return fmt::format("Joint{} {} {}: {} not judged.", one ? "" : "s", fmt::join(joints, ", "),
                     stand ? (one ? "stands" : "stand")
                           : (one ? "has too few equations" : "have too few equations"),
                     one ? "it is" : "they are");
}

Conclusion concluded(const Search& search, const std::vector<Finding>& findings,
                     const AnswerRules& rules) {
  const std::vector<Nameless>& all = search.result().nameless;
  const bool open = std::any_of(all.begin(), all.end(), [&](const Nameless& nameless) {
    return nameless_part(search, findings, nameless) > rules.unexplained_part;
  });
  const bool doubted = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return !finding.since_reference && finding.doubted;
  });
  const bool some_certain = std::any_of(findings.begin(), findings.end(),
                                        [](const Finding& own) { return !own.uncertain; });
  // no other name is as good as an uncertain one: what is as good has none
  const bool without_name =
      std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
        return !finding.since_reference && finding.uncertain && finding.aliases.size() <= 1;
      });
  if (open) {
    return {Verdict::kUnexplainedStructure,
            some_certain
                ? "Effects were found, and there is structure beside them that none explains."
                : "There is structure that no effect of the catalogue explains."};
  }
  if (doubted) {
    return {Verdict::kUnexplainedStructure,
            "There is structure beside the model; the effect that is nearest to it has a condition "
            "against it."};
  }
  if (without_name) {
    return {Verdict::kUnexplainedStructure,
            explanation(findings, rules.probable) +
                " Structure without a name explains as much as an uncertain one."};
  }
  if (!findings.empty()) return {Verdict::kExplained, explanation(findings, rules.probable)};
  return {Verdict::kClean, "Nothing above the noise: the model explains these recordings."};
}

}  // namespace dyngen::runtime

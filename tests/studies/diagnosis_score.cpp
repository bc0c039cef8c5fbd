// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_score.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "runtime/effects/effect_fit.h"
#include "runtime/effects/effect_residual.h"
#include "runtime/effects/effect_rows.h"
#include "tests/baselines/effect_dictionary.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using runtime::Diagnosis;
using runtime::EffectInstance;
using runtime::EffectRecordings;
using runtime::Finding;

constexpr double kConfident = 0.9;

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool shares(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](const std::string& word) { return contains(b, word); });
}

/// Whether a place is that of an effect. @param joint  -1: the whole robot
bool same_place(int joint, int other, const EffectInstance& truth) {
  if (truth.joint < 0) return true;  // all joints show it
  return joint == truth.joint || joint == truth.other ||
         (other >= 0 && (other == truth.joint || other == truth.other));
}

bool at_truth(const DiagnosisCase& own, int joint, int other) {
  if (own.foreign) return joint == own.foreign->joint;
  return std::any_of(own.truth.begin(), own.truth.end(), [&](const TrueEffect& effect) {
    return same_place(joint, other, effect.effect);
  });
}

std::string verdict_name(runtime::Verdict verdict) {
  switch (verdict) {
    case runtime::Verdict::kClean:
      return "clean";
    case runtime::Verdict::kExplained:
      return "explained";
    case runtime::Verdict::kNotExplained:
      return "not explained";
    case runtime::Verdict::kUnexplainedStructure:
      return "unexplained";
    case runtime::Verdict::kInsufficientData:
      return "insufficient";
  }
  return "";
}

std::string answer_text(const Diagnosis& diagnosis) {
  std::string text;
  for (const Finding& finding : diagnosis.findings) {
    text += text.empty() ? "" : " + ";
    text += finding.effect.law.name;
    if (finding.effect.joint >= 0) text += fmt::format(" {}", finding.effect.joint + 1);
    if (finding.effect.other >= 0) text += fmt::format("<-{}", finding.effect.other + 1);
    text += fmt::format(" (p {:.2f}, lambda {:.0f}, {})", finding.probability,
                        finding.evidence.lambda, fmt::join(finding.aliases, "|"));
  }
  for (const runtime::Unexplained& left : diagnosis.unexplained) {
    text += fmt::format("{}unknown {} ({})", text.empty() ? "" : " + ", left.joint + 1,
                        fmt::join(left.variables, ","));
  }
  return text.empty() ? "nothing" : text;
}

/// Parameters of a finding that is of the true law at the true place.
void compare_parameters(const Finding& finding, const EffectInstance& truth, double interval,
                        CaseScore& score) {
  for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
    const runtime::EffectParameterFit& found = finding.parameters[p];
    if (found.held || found.at_bound || !(found.stddev > 0)) continue;
    const double value = truth.parameters[static_cast<Index>(p)];
    const double error = std::abs(found.value - value);
    ++score.intervals;
    score.covered += error <= interval * found.stddev ? 1 : 0;
    if (value != 0) score.errors.push_back(error / std::abs(value));
  }
}

void judge_findings(const DiagnosisCase& own, const Diagnosis& diagnosis, CaseScore& score) {
  for (const Finding& finding : diagnosis.findings) {
    score.answered.push_back(finding.effect.law.family);
    const bool right = contains(score.true_families, finding.effect.law.family) ||
                       shares(finding.aliases, score.true_families);
    score.spurious += right ? 0 : 1;
    if (!right && finding.probability >= kConfident) score.confident_wrong = true;
    if (at_truth(own, finding.effect.joint, finding.effect.other)) score.detected_there = true;
  }
  for (const runtime::Unexplained& left : diagnosis.unexplained) {
    score.answered.emplace_back("unknown");
    if (at_truth(own, left.joint, -1)) score.detected_there = true;
  }
  score.unknown = !diagnosis.unexplained.empty() ||
                  diagnosis.verdict == runtime::Verdict::kUnexplainedStructure;
  score.detected = !score.answered.empty() || score.unknown;
  if (!diagnosis.findings.empty()) {
    const Finding& first = diagnosis.findings.front();
    score.joint_right = at_truth(own, first.effect.joint, first.effect.other);
    score.family_right = contains(score.true_families, first.effect.law.family);
    score.in_aliases = score.family_right || shares(first.aliases, score.true_families);
    score.aliases = std::max<int>(1, static_cast<int>(first.aliases.size()));
    score.probability = first.probability;
    score.confident = first.probability >= kConfident;
  } else if (!diagnosis.unexplained.empty()) {
    score.joint_right = at_truth(own, diagnosis.unexplained.front().joint, -1);
  }
  for (const TrueEffect& truth : own.truth) {
    for (const Finding& finding : diagnosis.findings) {
      if (finding.effect.law.family != truth.effect.law.family ||
          !same_place(finding.effect.joint, finding.effect.other, truth.effect)) {
        continue;
      }
      ++score.named;
      const bool same = finding.effect.law.name == truth.effect.law.name &&
                        finding.effect.joint == truth.effect.joint &&
                        finding.effect.other == truth.effect.other;
      if (same) compare_parameters(finding, truth.effect, diagnosis.fit.interval, score);
      break;
    }
  }
  for (const runtime::Undecidable& open : diagnosis.undecidable) {
    for (const TrueEffect& truth : own.truth) {
      const bool there =
          open.joint < 0 || truth.effect.joint < 0 || open.joint == truth.effect.joint;
      if (there && contains(open.families, truth.effect.law.family)) score.undecidable = true;
    }
  }
}

/// rms over the joints, each over its noise.
double scaled_rms(const VectorXd& rms, const runtime::AtlasNoise& noise) {
  double sum = 0;
  for (Index j = 0; j < rms.size(); ++j) {
    const double ratio = rms[j] / noise.joints[static_cast<std::size_t>(j)].deviation;
    sum += ratio * ratio;
  }
  return std::sqrt(sum / static_cast<double>(rms.size()));
}

double heldout_rms(const EffectRecordings& data, runtime::EffectPoint point,
                   const runtime::AtlasNoise& noise) {
  point.initial.clear();
  return scaled_rms(runtime::residual_with_effects(data, point), noise);
}

void judge_heldout(const DiagnosisCase& own, const Diagnosis& diagnosis,
                   const EffectRecordings& train, const EffectRecordings& heldout,
                   CaseScore& score) {
  // the oracle does not know foreign physics, nor that an effect is in one recording alone
  if (own.foreign || diagnosis.fit.point.beta.size() == 0) return;
  std::vector<EffectInstance> effects;
  if (own.request.kind != CaseKind::kTheorem) {
    for (const TrueEffect& truth : own.truth) {
      if (truth.recording >= 0) return;
      effects.push_back(truth.effect);  // where its search begins
    }
  }
  const double oracle = heldout_rms(heldout, runtime::fit_effects(train, effects).point, own.noise);
  score.heldout = heldout_rms(heldout, diagnosis.fit.point, own.noise) / oracle;
  score.base_heldout =
      heldout_rms(heldout, runtime::fit_effects(train, {}).point, own.noise) / oracle;
}

/// Joints of true effects with memory keep their equations where they stand.
std::vector<bool> remembering(const DiagnosisCase& own) {
  std::vector<bool> result(static_cast<std::size_t>(own.robot.joints()), false);
  for (const TrueEffect& truth : own.truth) {
    if (!truth.effect.law.states.empty() && truth.effect.joint >= 0) {
      result[static_cast<std::size_t>(truth.effect.joint)] = true;
    }
  }
  return result;
}

void judge_baselines(const DiagnosisCase& own, const EffectRecordings& train, CaseScore& score) {
  const EffectDictionary dictionary = effect_dictionary(own.input.hypotheses, train);
  const auto judge = [&](const std::string& method, const std::vector<Index>& places) {
    BaselineScore result{method, static_cast<int>(places.size()), 0, false};
    for (const Index place : places) {
      const EffectInstance& effect = dictionary.effects[static_cast<std::size_t>(place)];
      const bool right = contains(score.true_families, effect.law.family);
      result.wrong += right ? 0 : 1;
      if (place == places.front()) result.first_right = right;
    }
    score.baselines.push_back(result);
  };
  judge("lasso", lasso(dictionary.set));
  judge("forward", forward(dictionary.set));
}

CaseScore score_of(const CaseRequest& request) {
  CaseScore score;
  score.kind = request.kind;
  score.seed = request.seed;
  score.robot = request.robot;
  score.lambda = request.lambda;
  return score;
}

std::string without_breaks(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\t', ' ');
  return text;
}

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, mark);) parts.push_back(part);
  return parts;
}

void judge_nearest(const Nearest& nearest, double lambda, double absorbed, CaseScore& score) {
  score.separable = nearest.separable(lambda);
  score.likeness = nearest.likeness;
  score.likest = nearest.family;
  score.absorbed = absorbed;
}

}  // namespace

CaseScore run_case(const CaseRequest& request, bool baselines) {
  CaseScore score = score_of(request);
  try {
    const DiagnosisCase own = make_case(request);
    score.noise = own.noise_kind;
    score.truth = own.truth_text();
    for (const TrueEffect& truth : own.truth) {
      score.true_families.push_back(truth.effect.law.family);
    }
    if (!own.truth.empty()) {
      const TrueEffect& first = own.truth.front();
      judge_nearest(first.nearest, first.lambda, first.absorbed, score);
    } else if (own.foreign) {
      const ForeignStrength& strength = own.foreign_strength;
      judge_nearest(strength.nearest, strength.lambda, strength.absorbed, score);
    }
    const auto begin = std::chrono::steady_clock::now();
    const Diagnosis diagnosis = runtime::diagnose(own.input);
    score.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    score.verdict = verdict_name(diagnosis.verdict);
    score.answer = answer_text(diagnosis);
    judge_findings(own, diagnosis, score);
    const auto rows = [&](const std::vector<runtime::MotionSource>& sources,
                          const std::vector<bool>& keeping) {
      return runtime::effect_recordings(own.input.model, own.input.robot, sources, {}, keeping);
    };
    const EffectRecordings train = rows(own.input.train, remembering(own));
    // friction of a joint that stands is any: it says nothing of a model
    const std::vector<bool> none(static_cast<std::size_t>(own.robot.joints()), false);
    judge_heldout(own, diagnosis, train, rows(own.input.heldout, none), score);
    if (baselines) judge_baselines(own, train, score);
  } catch (const std::exception& error) {
    score.failure = without_breaks(error.what());
  }
  return score;
}

std::string to_line(const CaseScore& s) {
  std::string baselines;
  for (const BaselineScore& b : s.baselines) {
    baselines += fmt::format("{}:{}:{}:{},", b.method, b.names, b.wrong, int{b.first_right});
  }
  return fmt::format(
      "{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}"
      "\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\tend",
      case_name(s.kind), case_name(s.noise), s.seed, s.robot, s.lambda, s.truth, s.answer,
      s.verdict, fmt::join(s.true_families, ","), fmt::join(s.answered, ","), s.failure,
      int{s.separable}, s.likeness, s.likest, s.absorbed, int{s.detected}, int{s.detected_there},
      int{s.joint_right}, int{s.family_right}, int{s.in_aliases}, s.aliases, s.named, s.spurious,
      int{s.confident}, int{s.confident_wrong}, s.probability, int{s.undecidable}, int{s.unknown},
      s.heldout, s.base_heldout, fmt::join(s.errors, ","),
      fmt::format("{}/{}", s.covered, s.intervals), s.seconds, baselines);
}

CaseScore from_line(const std::string& line) {
  const std::vector<std::string> parts = split(line, '\t');
  constexpr std::size_t kParts = 35;
  if (parts.size() != kParts || parts.back() != "end") {
    throw std::invalid_argument(
        fmt::format("from_line(): {} fields, expected {}", parts.size(), kParts));
  }
  std::size_t place = 0;
  const auto text = [&] { return parts[place++]; };
  const auto number = [&] { return std::stod(parts[place++]); };
  const auto count = [&] { return std::stoi(parts[place++]); };
  const auto flag = [&] { return parts[place++] == "1"; };
  CaseScore s;
  s.kind = case_kind(text());
  s.noise = case_noise(text());
  s.seed = static_cast<unsigned>(count());
  s.robot = text();
  s.lambda = number();
  s.truth = text();
  s.answer = text();
  s.verdict = text();
  s.true_families = split(text(), ',');
  s.answered = split(text(), ',');
  s.failure = text();
  s.separable = flag();
  s.likeness = number();
  s.likest = text();
  s.absorbed = number();
  s.detected = flag();
  s.detected_there = flag();
  s.joint_right = flag();
  s.family_right = flag();
  s.in_aliases = flag();
  s.aliases = count();
  s.named = count();
  s.spurious = count();
  s.confident = flag();
  s.confident_wrong = flag();
  s.probability = number();
  s.undecidable = flag();
  s.unknown = flag();
  s.heldout = number();
  s.base_heldout = number();
  for (const std::string& error : split(text(), ',')) s.errors.push_back(std::stod(error));
  const std::vector<std::string> covered = split(text(), '/');
  s.covered = std::stoi(covered.at(0));
  s.intervals = std::stoi(covered.at(1));
  s.seconds = number();
  for (const std::string& one : split(text(), ',')) {
    const std::vector<std::string> fields = split(one, ':');
    s.baselines.push_back(
        {fields.at(0), std::stoi(fields.at(1)), std::stoi(fields.at(2)), fields.at(3) == "1"});
  }
  return s;
}

std::string in_words(const CaseScore& s) {
  std::string text = fmt::format("{} seed {} {} lambda {:g} {} noise: {}", case_name(s.kind),
                                 s.seed, s.robot, s.lambda, case_name(s.noise), s.truth);
  if (!s.likest.empty()) {
    text += fmt::format(" (absorbed {:.4f}, c2 {:.2f} {}{})", s.absorbed, s.likeness, s.likest,
                        s.separable ? ", separable" : "");
  }
  if (!s.failure.empty()) return text + " -> FAILED: " + s.failure;
  text += fmt::format(" -> {}: {}; held-out {:.3f} (base {:.3f}), {:.1f} s", s.verdict, s.answer,
                      s.heldout, s.base_heldout, s.seconds);
  for (const BaselineScore& b : s.baselines) {
    text += fmt::format("; {}: {} names, {} wrong", b.method, b.names, b.wrong);
  }
  return text;
}

}  // namespace dyngen::test

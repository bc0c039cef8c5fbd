// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/found_effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/diagnosis/names/effect_location.h"
#include "runtime/diagnosis/names/name_tests.h"
#include "runtime/diagnosis/names/naming.h"

namespace dyngen::runtime {
namespace {

std::string where_it_acts(const EffectInstance& effect) {
  if (effect.joint < 0) return "the whole robot";
  if (effect.other >= 0) {
    return fmt::format("joints {} and {}", effect.joint + 1, effect.other + 1);
  }
  return fmt::format("{}joint {}", effect.law.acts_inward ? "the link of " : "", effect.joint + 1);
}

std::string when_it_acts(const EffectLocation& where) {
  return where.recording.empty() ? "" : " in " + where.recording;
}

/// "the same of joint 2 (gain = -0.0428)": linear parameters of effects on other joints. A force on
/// another link has six, which are left out.
std::string elsewhere(const Naming& naming, const std::vector<Hypothesis>& hypotheses) {
  std::vector<std::string> places;
  for (const Rival& rival : naming.elsewhere) {
    std::vector<std::string> numbers;
    const EffectInstance& effect = rival.trial.effect;
    if (effect.law.acts_inward) {
      places.push_back("the same of " + where_it_acts(effect));
      continue;
    }
    for (const int p : hypotheses[rival.hypothesis].linear) {
      numbers.push_back(fmt::format("{} = {:.4g}",
                                    effect.law.parameters[static_cast<std::size_t>(p)].name,
                                    effect.parameters[p]));
    }
    places.push_back(
        fmt::format("the same of {} ({})", where_it_acts(effect), fmt::join(numbers, ", ")));
  }
  return fmt::format("{}", fmt::join(places, ", "));
}

/// Whether the name holds on halves of the recordings.
FalsifierOutcome stability_test(const Naming& naming, double stability) {
  const double share = naming.stability();
  return {"stability", share >= stability,
          fmt::format("{} explains most of {:.0f} of 100 halves of the recordings",
                      naming.families.size() > 1 ? "it, or a name that is not told apart," : "it",
                      100 * share),
          true};
}

std::string why(const Finding& finding, const Naming& naming) {
  std::string text = fmt::format(
      "{} on {} lowers chi-square by {:.0f} beside the refitted model", finding.effect.law.family,
      where_it_acts(finding.effect) + when_it_acts(finding.where), finding.evidence.lambda);
  if (!finding.unnamed.empty()) {
    text += fmt::format("; {}: chi-square {} by {:.0f}", finding.unnamed,
                        naming.unnamed_distance < 0 ? "lower" : "higher",
                        std::abs(naming.unnamed_distance));
  } else if (naming.rivals.empty() && finding.elsewhere.empty()) {
    text += "; no other effect is near";
  }
  std::vector<std::string> alike;
  if (!finding.elsewhere.empty()) alike.push_back(finding.elsewhere);
  const bool several = finding.aliases.size() > 1 && !naming.rivals.empty();
  if (several) alike.push_back(naming.rivals.front().name);
  if (!alike.empty()) {
    text += fmt::format("; these data cannot separate it from {}", fmt::join(alike, " or "));
  }
  if (!several && !naming.rivals.empty()) {
    const Rival& next = naming.rivals.front();
    text +=
        fmt::format("; the next name, {}: chi-square higher by {:.0f}", next.name, next.distance);
  }
  for (const std::string& value : finding.unusual) text += "; " + value;
  for (const std::string& sentence : finding.caveats) text += "; " + sentence;
  return text;
}

/// @param scales  of the finding's joint
std::vector<std::string> caveats(const Finding& finding, const Naming& naming,
                                 const EffectScales& scales) {
  std::vector<std::string> sentences;
  const EffectLaw& law = finding.effect.law;
  std::vector<std::string> forms = naming.forms;
  std::sort(forms.begin(), forms.end());
  if (!forms.empty()) {
    sentences.push_back(fmt::format("{} explains it as well: these recordings do not separate them",
                                    fmt::join(forms, " or ")));
  }
  for (std::size_t p = 0; p < law.parameters.size(); ++p) {
    const EffectParameter& own = law.parameters[p];
    const double value = finding.parameters[p].value;
    if (own.role != EffectRole::kShape || own.unit != "s" || !(value > scales.duration)) continue;
    sentences.push_back(
        fmt::format("{} is longer than the {:.3g} s of recording: how far the effect goes on is "
                    "not known",
                    own.name, scales.duration));
  }
  return sentences;
}

struct Found {
  Finding finding;
  LocatedEffect located;
};

/// Shares of what an effect itself has on its joint become shares of all that was found there,
/// with a name or without.
void share_among_all(std::vector<Found>& all_found, const std::vector<Nameless>& nameless) {
  for (Found& found : all_found) {
    const int joint = found.located.joint;
    double all = 0;
    for (const Found& own : all_found) all += own.located.squares[joint];
    for (const Nameless& own : nameless) {
      if (own.structure.joint != joint) continue;
      all += std::max(0.0, own.score.delta_chi2 - own.score.degrees);
    }
    found.finding.where.share *= found.located.squares[joint] / std::max(all, 1e-300);
  }
}

Found found(const Search& search, std::size_t place, const Naming& naming, EffectSignals& signals,
            const EvidenceSystem::Options& options) {
  const AnswerRules& rules = options.rules.answer;
  const EffectRecordings& evidence = search.sets().evidence();
  const CompetitionResult& result = search.result();
  const EffectFit& fit = result.fit;
  const Winner& winner = result.winners[place];
  const Hypothesis& hypothesis = search.hypotheses()[winner.hypothesis];
  Finding finding;
  finding.effect = fit.point.effects[place];
  finding.parameters = fit.parameters[place];
  finding.aliases = naming.families;
  finding.probability = naming.probability;
  finding.elsewhere = elsewhere(naming, search.hypotheses());
  if (naming.unnamed_distance < kApart) finding.unnamed = naming.unnamed;
  finding.absorbed = 1 - naming.part_left;
  finding.evidence = {naming.lambda, naming.delta_bic, 0};
  const EvidenceSystem system =
      system_without(evidence, signals, search.hypotheses(), result, place, options);
  finding.tests = name_tests(evidence, signals, system, finding.effect);
  if (!hypothesis.windowed) finding.tests.push_back(stability_test(naming, rules.stability));
  LocatedEffect where = located(evidence, signals, system, hypothesis, finding.effect);
  finding.where = where.where;
  if (finding.effect.recording >= 0) {
    finding.where.recording =
        search.parts().train[static_cast<std::size_t>(finding.effect.recording)].name;
  }
  const auto object = [&](const std::string& test, const std::string& text) {
    finding.probability = std::min<double>(finding.probability, rules.probable);
    finding.doubted = true;
    finding.tests.push_back({test, false, text, true});
  };
  for (const EffectRemark& remark : fit.remarks) {
    if (!fit.objects(remark, static_cast<int>(place))) continue;
    object(remark.kind == EffectRemark::Kind::kFalsified ? "falsifier" : "bound", remark.text);
  }
  for (const int joint : joints_of(hypothesis.effect, evidence.joints())) {
    if (!winner.outdone || !has_nameless(result, joint)) continue;
    object("structure",
           fmt::format("joint {} has structure without a name that explains more", joint + 1));
  }
  const EffectScales scales = ScaleTable(search.sets().train).of(fit.point.beta, finding.effect);
  finding.unusual = unusual_values(finding.effect, scales);
  finding.caveats = caveats(finding, naming, scales);
  finding.uncertain = finding.doubted || finding.probability < rules.probable;
  finding.why = why(finding, naming);
  return {std::move(finding), std::move(where)};
}

}  // namespace

std::vector<Finding> found_effects(Search& search, const CompetitionOptions& options,
                                   const CompetitionProgress& progress) {
  CompetitionResult& result = search.result();
  if (result.winners.empty()) return {};
  if (progress) progress("the final fit", 0);
  const std::vector<EffectInstance> effects = result.fit.point.effects;
  EffectFitOptions settings;
  // where motions repeat it is free of what the model leaves out, and has slow parts
  if (result.noise.free_of_structure()) settings.noise = result.noise.known();
  result.fit = fit_effects(search.sets().train, effects, settings);
  EffectSignals signals(search.sets().evidence());
  EvidenceSystem::Options system;
  system.seed = options.seed;
  system.surrogates = 0;
  system.with_regressor = options.with_regressor;
  system.rules = options.rules;
  const EquationSets& sets = search.sets();
  const NamingData data{sets.evidence(),     sets.train, sets.proof,
                        search.hypotheses(), system,     {options.effort, sets.evidence().work}};
  const std::vector<Naming> namings = settle_names(data, signals, result, progress);
  std::vector<Found> all;
  for (std::size_t i = 0; i < namings.size(); ++i) {
    all.push_back(found(search, i, namings[i], signals, system));
  }
  share_among_all(all, result.nameless);
  std::vector<Finding> findings;
  for (Found& own : all) findings.push_back(std::move(own.finding));
  return findings;
}

}  // namespace dyngen::runtime

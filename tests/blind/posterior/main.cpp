// SPDX-License-Identifier: MIT
// blind_posterior: which sets of effects a case supports, by their posterior over the columns that
// a diagnosis screens beside the model: a study of that way to choose, beside the rounds of dynid.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gen/tool/output_files.h"
#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/diagnosis.h"
#include "runtime/diagnosis/posterior/effect_posterior.h"
#include "runtime/diagnosis/scans/generic_columns.h"
#include "tests/blind/dynid/case_input.h"
#include "tests/blind/dynid/competed.h"

namespace blind {
namespace {

using namespace dyngen::runtime;
using Eigen::Index;
using Json = nlohmann::json;

constexpr double kSlab = 200;        // variance of a coefficient: effects of lambda up to some 200
constexpr double kExpected = 0.02;   // effects on a recording, before it is seen
constexpr double kSearched = 6;      // log odds that a search over orders or windows costs
constexpr double kShape = 1;         // the same of a shape's grid
constexpr double kInadmissible = 4;  // of an estimate that a bound or a falsifier speaks against
constexpr double kNameless = 2;      // of structure without a name

/// What a candidate is called.
struct Called {
  std::string family, name;
  int joint = 0;  // from 1; 0: the whole robot
};

struct Candidates {
  std::vector<Candidate> all;
  std::vector<Called> called;
  std::vector<JointColumns> columns;

  void add(Candidate candidate, Called name, JointColumns own) {
    candidate.columns = own.columns();
    all.push_back(candidate);
    called.push_back(std::move(name));
    columns.push_back(std::move(own));
  }
};

Candidates candidates_of(const Search& search, EffectSignals& signals,
                         const EvidenceSystem& system) {
  const EffectRecordings& data = search.sets().evidence();
  Candidates result;
  for (const NamedResult& named : search.result().first.named) {
    if (!named.seen) continue;
    const Hypothesis& hypothesis = search.hypotheses()[named.hypothesis];
    const EffectInstance& effect = hypothesis.effect;
    double odds = -kShape * static_cast<double>(hypothesis.shapes.size());
    if (hypothesis.ordered || hypothesis.windowed) odds -= kSearched;
    std::vector<const TrialScore*> trials = {&named.best};
    const bool freer = named.freest.score.delta_chi2 > 1.0001 * named.best.score.delta_chi2;
    if (freer && !hypothesis.shapes.empty()) trials.push_back(&named.freest);
    for (const TrialScore* trial : trials) {
      result.add(
          {0, named.hypothesis,
           odds - (trial->admissible ? 0 : kInadmissible) - trial->unusual / 2},
          {effect.law.family, short_name(effect), effect.link > 0 ? effect.link : effect.joint + 1},
          hypothesis_columns(data, signals, system, hypothesis, trial->effect));
    }
  }
  const std::vector<GenericStructure> structures = structures_of(data);
  std::size_t hypothesis = search.hypotheses().size();
  for (const GenericResult& each : search.result().first.generic) {
    GenericStructure structure = structures[each.structure];
    structure.frequency = each.frequency;
    if (structure.form == GenericStructure::Form::kRepeats) continue;
    result.add({0, hypothesis++, -kNameless},
               {"", fmt::format("{}", fmt::join(structure.names(), " and ")), structure.joint + 1},
               system.whitened(generic_columns(data, signals, structure)));
  }
  std::set<std::size_t> hypotheses;
  for (const Candidate& each : result.all) hypotheses.insert(each.hypothesis);
  const double prior = std::log(kExpected / static_cast<double>(hypotheses.size()));
  for (Candidate& each : result.all) each.log_odds += prior;
  return result;
}

Json answer_of(const DiagnosisInput& input) {
  Search search(input, DiagnosisOptions().decimation);
  compete_by_default(search);  // where joints stick, and the noise
  CompetitionResult alone = search.result();
  alone.winners.clear();
  alone.nameless.clear();
  alone.fit = alone.base;
  EffectSignals signals(search.sets().evidence());
  signals.set_beta(alone.base.point.beta);
  signals.set_tangent_beta(alone.base.point.beta);
  EvidenceSystem::Options plain;
  plain.surrogates = 0;
  const EvidenceSystem system =
      system_beside(search.sets().evidence(), signals, search.hypotheses(), alone, alone.fit.point,
                    alone.noise, plain);
  const Candidates candidates = candidates_of(search, signals, system);
  const Products products = system.products(side_by_side(candidates.columns), false);
  const SetEvidence evidence(products.left, products.rest, candidates.all, kSlab);
  const EffectPosterior posterior = effect_posterior(evidence);

  std::set<std::pair<std::string, int>> names;
  for (const Called& each : candidates.called) names.insert({each.family, each.joint});
  Json findings = Json::array();
  for (const auto& name : names) {
    const double probability = posterior.probability([&](std::size_t place) {
      const Called& called = candidates.called[place];
      return called.family == name.first && called.joint == name.second;
    });
    if (probability < 0.05) continue;
    findings.push_back(
        {{"family", name.first}, {"joint", name.second}, {"probability", probability}});
  }
  std::stable_sort(findings.begin(), findings.end(), [](const Json& a, const Json& b) {
    return a["probability"].get<double>() > b["probability"].get<double>();
  });
  Json best = Json::array();
  for (const std::size_t place : posterior.sets.front().set) {
    best.push_back(candidates.called[place].name);
  }
  return {{"schema", "blind.posterior/1"},
          {"any", posterior.any()},
          {"findings", findings},
          {"best", best},
          {"candidates", candidates.all.size()}};
}

}  // namespace
}  // namespace blind

int main(int argc, char** argv) {
  CLI::App app{"Says which sets of effects recordings support, by their posterior."};
  std::string robot, json;
  std::vector<std::string> train, heldout;
  app.add_option("robot", robot, "robot file")->required();
  app.add_option("recordings", train, "that are fitted")->required();
  app.add_option("--holdout", heldout, "one that is not; may be given again")
      ->allow_extra_args(false);
  app.add_option("--json", json, "the answer")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    const auto input = blind::case_input(robot, train, heldout);
    dyngen::write_files({{json, blind::answer_of(input).dump(1) + "\n"}});
  } catch (const std::exception& error) {
    fmt::print(stderr, "blind_posterior: {}\n", error.what());
    return 1;
  }
  return 0;
}

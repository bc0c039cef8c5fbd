// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/unnamed_rival.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "runtime/diagnosis/names/imitation.h"
#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kTried = 4;   // of each kind
constexpr double kSameForm = 0.01;  // of a curve's chi-square, which the winner cannot imitate

/// The first few places of those with the largest chi-square reduction, net.
std::vector<std::size_t> largest(std::vector<std::pair<double, std::size_t>> nets) {
  std::stable_sort(nets.begin(), nets.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::size_t> places;
  for (const auto& [net, place] : nets) {
    if (places.size() < kTried && net > 0) places.push_back(place);
  }
  return places;
}

}  // namespace

UnnamedRival unnamed_rival(const EffectRecordings& data, EffectSignals& signals,
                           const std::vector<Hypothesis>& hypotheses,
                           const CompetitionResult& result, const Winner& winner,
                           const EffectInstance& found, const EvidenceSystem& system) {
  std::vector<int> joints = joints_of(hypotheses[winner.hypothesis].effect, data.joints());
  std::erase_if(joints, [&](int joint) {
    return std::any_of(result.sticking.begin(), result.sticking.end(),
                       [&](const StictionJoint& sticking) { return sticking.joint == joint; });
  });
  const auto meets = [&](int joint) {
    return std::find(joints.begin(), joints.end(), joint) != joints.end();
  };
  UnnamedRival best;
  const auto consider = [&](double net, std::string what, const JointColumns& columns,
                            Nameless form) {
    if (net > best.net) best = {std::move(what), net, columns, std::move(form)};
  };

  std::vector<GenericStructure> structures = structures_of(data);
  std::vector<std::pair<double, std::size_t>> nets;
  for (const GenericResult& generic : winner.generic) {
    GenericStructure& structure = structures[generic.structure];
    structure.frequency = generic.frequency;
    if (!meets(structure.joint) || !structure.is_specific() ||
        structure.form == GenericStructure::Form::kImpulses) {
      continue;
    }
    nets.emplace_back(net_of(structure, generic.score, result.noise), generic.structure);
  }
  for (const std::size_t place : largest(std::move(nets))) {
    const GenericStructure& structure = structures[place];
    const JointColumns white = system.whitened(generic_columns(data, signals, structure));
    Nameless form;
    form.structure = structure;
    form.score = score_of(system.products(white, false), false);
    const double net = net_of(structure, form.score, result.noise);
    consider(net,
             fmt::format("a function of {}, which is no effect of the catalogue",
                         fmt::join(structure.names(), " and ")),
             white, std::move(form));
  }

  nets.clear();
  for (const NamedResult& other : winner.others) {
    if (!other.seen || other.freest.admissible) continue;
    const Hypothesis& hypothesis = hypotheses[other.hypothesis];
    const std::vector<int> own = joints_of(hypothesis.effect, data.joints());
    if (!std::any_of(own.begin(), own.end(), meets)) continue;
    nets.emplace_back(net_of(hypothesis, other.freest, result.noise), other.hypothesis);
  }
  const ScaleTable scales(data);
  const JointColumns own =
      hypothesis_columns(data, signals, system, hypotheses[winner.hypothesis], found);
  for (const std::size_t place : largest(std::move(nets))) {
    const Hypothesis& hypothesis = hypotheses[place];
    const TrialScore trial =
        try_hypothesis(data, signals, system, hypothesis, winner.others[place].freest.effect,
                       scales.of(result.fit.point.beta, hypothesis.effect), false);
    if (trial.admissible) continue;
    const JointColumns columns =
        hypothesis_columns(data, signals, system, hypothesis, trial.effect);
    JointColumns curve = columns;
    for (Eigen::MatrixXd& part : curve.parts) part = part * trial.score.coefficients;
    const Imitation by_winner = imitation(system, curve, own);
    if (by_winner.left < kSameForm * by_winner.whole) continue;  // the same curve, which has a name
    Nameless form;
    form.structure.joint = columns.joints.front();
    form.score = trial.score;
    form.ruled_out = trial.effect;
    consider(net_of(hypothesis, trial, result.noise),
             fmt::format("the form of {}, no name here since {}", short_name(trial.effect),
                         trial.objection),
             columns, std::move(form));
  }
  return best;
}

}  // namespace dyngen::runtime

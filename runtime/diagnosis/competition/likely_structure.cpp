// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/likely_structure.h"

#include <algorithm>
#include <utility>

#include "runtime/diagnosis/competition/likelihood.h"
#include "runtime/diagnosis/competition/nameless_proof.h"
#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kStrongest = 3;  // of a joint whose likelihoods are compared

/// Functions of the motion on a joint with the largest net squares beside white noise, a few, that
/// held-out recordings can speak for.
std::vector<const GenericResult*> strongest_of(const Screening& plain,
                                               const std::vector<GenericStructure>& structures,
                                               const TorqueNoiseModel& noise, int joint) {
  std::vector<const GenericResult*> own;
  for (const GenericResult& generic : plain.generic) {
    Nameless nameless;
    nameless.structure = structures[generic.structure];
    if (nameless.structure.joint == joint && is_function(nameless.structure) &&
        is_provable(nameless)) {
      own.push_back(&generic);
    }
  }
  const auto net = [&](const GenericResult& generic) {
    return net_of(structures[generic.structure], generic.score, noise);
  };
  std::stable_sort(own.begin(), own.end(), [&](const GenericResult* a, const GenericResult* b) {
    return net(*a) > net(*b);
  });
  own.resize(std::min(own.size(), kStrongest));
  return own;
}

}  // namespace

std::optional<LikelyStructure> likeliest_structure(const EffectRecordings& data,
                                                   EffectSignals& signals,
                                                   const std::vector<GenericStructure>& structures,
                                                   const CompetitionResult& result,
                                                   const ModelSide& plain) {
  const LikelihoodRatio ratio(data, rests_of(data, plain.system, result.fit.rms));
  std::optional<LikelyStructure> best;
  for (int joint = 0; joint < data.joints(); ++joint) {
    if (has_nameless(result, joint)) continue;
    for (const GenericResult* generic :
         strongest_of(plain.screening, structures, result.noise, joint)) {
      const GenericStructure& structure = structures[generic->structure];
      EvidenceSystem with = plain.system;
      with.add(with.whitened(generic_columns(data, signals, structure)));
      LikelyStructure likely{*generic, 0, rests_of(data, with, result.fit.rms)};
      Score& score = likely.generic.score;
      score.delta_chi2 = ratio.of(likely.residuals);
      likely.generic.surprise = surprise_of(score.delta_chi2, score.degrees);
      likely.net = net_of(structure, score, result.noise);
      if (likely.net > (best ? best->net : 0)) best = std::move(likely);
    }
  }
  return best;
}

}  // namespace dyngen::runtime

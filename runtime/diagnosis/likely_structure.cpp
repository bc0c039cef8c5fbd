// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/likely_structure.h"

#include <algorithm>
#include <utility>

#include "runtime/diagnosis/generic_columns.h"
#include "runtime/diagnosis/likelihood.h"
#include "runtime/diagnosis/nameless_proof.h"
#include "runtime/effects/absorption.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kStrongest = 3;  // of a joint whose likelihoods are compared

bool has_nameless(const CompetitionResult& result, int joint) {
  return std::any_of(result.nameless.begin(), result.nameless.end(),
                     [&](const Nameless& nameless) { return nameless.structure.joint == joint; });
}

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

EvidenceSystem beside_white_noise(const EffectRecordings& data, EffectSignals& signals,
                                  const std::vector<Hypothesis>& hypotheses,
                                  const CompetitionResult& result,
                                  EvidenceSystem::Options options) {
  TorqueNoiseModel white = result.noise;
  white.joints = quick_noise(white_noise(result.fit.rms).joints);
  options.surrogates = 0;
  return system_beside(data, signals, hypotheses, result, result.fit.point, white, options);
}

RunResiduals rests_of(const EffectRecordings& data, const EvidenceSystem& white,
                      const VectorXd& deviation) {
  RunResiduals residuals;
  for (const EffectRun& run : data.runs) {
    residuals.emplace_back(run.rows.Y.rows(), data.joints());
  }
  for (int j = 0; j < data.joints(); ++j) {
    const VectorXd rest = deviation[j] * white.rest(j);
    Index start = 0;
    for (std::size_t run = 0; run < residuals.size(); ++run) {
      const Index rows = residuals[run].rows();
      residuals[run].col(j) =
          rest.segment(start, rows).cwiseProduct(data.runs[run].rows.counted.col(j));
      start += rows;
    }
  }
  return residuals;
}

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
      score.squares = ratio.of(likely.residuals);
      likely.generic.surprise = surprise_of(score.squares, score.degrees);
      likely.net = net_of(structure, score, result.noise);
      if (likely.net > (best ? best->net : 0)) best = std::move(likely);
    }
  }
  return best;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/competition/heldout.h"

namespace dyngen::runtime {

/// Whether an effect that came first in a round becomes a winner.
class Acceptance {
 public:
  /// All must outlive it.
  /// @param train    what evidence is of
  /// @param fitted   what fits and noise are of
  /// @param heldout  what an effect is held against
  /// @param result   what was found so far; grows
  Acceptance(const EffectRecordings& train, EffectSignals& signals, const EffectRecordings& fitted,
             const EffectRecordings& heldout, const std::vector<Hypothesis>& hypotheses,
             HalfBandTest& half_band, const EvidenceSystem::Options& options,
             CompetitionResult& result)
      : train_(train),
        signals_(signals),
        fitted_(fitted),
        heldout_(heldout),
        hypotheses_(hypotheses),
        half_band_(half_band),
        options_(options),
        result_(result) {}

  /// At each new noise of the result.
  void begin_round();

  /// An effect, and what it is judged by.
  struct Candidate {
    NamedResult named;
    EffectFit fit;              ///< of the winners and, as its last, the effect
    bool beyond_doubt = false;  ///< by its p-value: then it is enough that held-out data agree
    bool at_stiction = false;   ///< of Winner
  };
  /// Keeps an effect that is no estimate held by a bound, that neither what is left nor the
  /// half_band refutes, and that held-out recordings speak for. @return whether it is a winner now
  bool accept(Candidate candidate, const Screening& screening);
  /// The same of the first of the round that was turned down for a bound alone.
  bool accept_at_bound(const Screening& screening);

  /// What held-out recordings say of a fit with one effect more.
  [[nodiscard]] HeldoutProof proof_of(const EffectFit& next) const;

 private:
  bool keep(Candidate candidate, const Screening& screening);
  [[nodiscard]] bool refuted(const Candidate& candidate);
  [[nodiscard]] bool proved(const Candidate& candidate, HeldoutProof proof) const;

  const EffectRecordings& train_;
  EffectSignals& signals_;
  const EffectRecordings& fitted_;
  const EffectRecordings& heldout_;
  const std::vector<Hypothesis>& hypotheses_;
  HalfBandTest& half_band_;
  EvidenceSystem::Options options_;
  CompetitionResult& result_;
  std::optional<Candidate> at_bound_;  // of this round
  Eigen::MatrixXd known_;              // model_information() of what is fitted
};

}  // namespace dyngen::runtime

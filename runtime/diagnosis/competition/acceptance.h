// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/effect_conditions.h"
#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/sought.h"

namespace dyngen::runtime {

/// Whether an effect that came first in a round becomes a winner.
class Acceptance {
 public:
  /// All but the options must outlive it. @param false_alarm  as in CompetitionOptions
  /// @param result  what was found so far
  Acceptance(const CompetitionData& data, const Sought& sought,
             const EvidenceSystem::Options& options, double false_alarm,
             const CompetitionResult& result)
      : data_(data),
        sought_(sought),
        options_(options),
        false_alarm_(false_alarm),
        result_(result) {}

  /// At each new noise of the result.
  void begin_round();

  /// An effect, and what it is judged by.
  struct Candidate {
    NamedResult named;
    EffectFit fit;              ///< of the winners and, as its last, the effect
    bool beyond_doubt = false;  ///< by its p-value: then it is enough that held-out data agree
    bool at_stiction = false;   ///< of Winner
    /// What explains more: beside it held-out recordings must speak for the effect.
    EffectConditions::Beside beside = EffectConditions::Beside::kNothing;
  };
  /// An effect that is accepted.
  struct Accepted {
    Winner winner;
    EffectFit fit;  ///< of the winners so far and, as its last, this one
  };
  /// Accepts an effect that is no estimate held by a bound, that neither the residual nor the
  /// half-band test refutes, that is more than a disturbance inside the loop, and that held-out
  /// recordings speak for. @return nothing: it is refused
  [[nodiscard]] std::optional<Accepted> accept(Candidate candidate, const Screening& screening);
  /// The same of the first of the round that was turned down for a bound alone.
  [[nodiscard]] std::optional<Accepted> accept_at_bound(const Screening& screening);

  /// What held-out recordings say of a fit with one effect more.
  [[nodiscard]] HeldoutProof proof_of(const EffectFit& next) const;

 private:
  [[nodiscard]] std::optional<Accepted> judged(Candidate candidate,
                                               const Screening& screening) const;
  [[nodiscard]] bool refuted(const Candidate& candidate) const;
  [[nodiscard]] bool is_disturbance(const Candidate& candidate, const Screening& screening) const;
  [[nodiscard]] bool proved(const Candidate& candidate, HeldoutProof proof) const;

  const CompetitionData& data_;
  const Sought& sought_;
  EvidenceSystem::Options options_;
  double false_alarm_;
  const CompetitionResult& result_;
  std::optional<Candidate> at_bound_;  // of this round
  Eigen::MatrixXd known_;              // model_information() of what is fitted
};

}  // namespace dyngen::runtime

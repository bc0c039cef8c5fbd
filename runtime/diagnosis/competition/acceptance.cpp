// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/acceptance.h"

#include <utility>

#include "runtime/diagnosis/competition/sandwich_test.h"

namespace dyngen::runtime {

void Acceptance::begin_round() {
  at_bound_.reset();
  if (options_.with_regressor) known_ = model_information(fitted_, result_.noise);
}

bool Acceptance::accept(Candidate candidate, const Screening& screening) {
  // a bound that holds the estimate, a falsifier, or a parameter that the data do not determine
  // speak against the name
  const int own = static_cast<int>(candidate.fit.point.effects.size()) - 1;
  bool doubtful = false, only_bounds = true;
  for (const EffectRemark& remark : candidate.fit.remarks) {
    if (!candidate.fit.objects(remark, own)) continue;
    doubtful = true;
    only_bounds = only_bounds && remark.kind == EffectRemark::Kind::kAtBound;
  }
  if (!doubtful) return keep(std::move(candidate), screening);
  if (only_bounds && !at_bound_) at_bound_ = std::move(candidate);
  return false;
}

bool Acceptance::accept_at_bound(const Screening& screening) {
  return at_bound_ && keep(std::move(*at_bound_), screening);
}

HeldoutProof Acceptance::proof_of(const EffectFit& next) const {
  return heldout_proof(heldout_, result_.fit.point, next.point, result_.noise, known_);
}

/// Whether its own columns in each period, or the half_band, ask for another size.
bool Acceptance::refuted(const Candidate& candidate) {
  const Hypothesis& hypothesis = hypotheses_[candidate.named.hypothesis];
  if (result_.noise.from_periods) {
    const EvidenceSystem system = system_beside(train_, signals_, hypotheses_, result_,
                                                result_.fit.point, result_.noise, options_);
    if (scatter_refutes(train_, signals_, system, hypothesis, candidate.named.best.effect)) {
      return true;
    }
  }
  return half_band_.contradicts(hypotheses_, result_, hypothesis, candidate.fit.point, options_);
}

/// Whether held-out recordings speak for it, or, of one beyond doubt, agree with it; an event is
/// not in them and must only not harm them.
bool Acceptance::proved(const Candidate& candidate, HeldoutProof proof) const {
  const Hypothesis& hypothesis = hypotheses_[candidate.named.hypothesis];
  proof.parameters = static_cast<double>(hypothesis.linear.size() + hypothesis.shapes.size());
  proof.fitted = candidate.named.best.score.delta_chi2;
  if (hypothesis.windowed) return !proof.harms();
  return proof.helps() || (candidate.beyond_doubt && proof.agrees());
}

bool Acceptance::keep(Candidate candidate, const Screening& screening) {
  if (refuted(candidate)) return false;
  const HeldoutProof proof = proof_of(candidate.fit);
  if (!proved(candidate, proof)) return false;
  Winner winner;
  winner.hypothesis = candidate.named.hypothesis;
  winner.trial = std::move(candidate.named.best);
  winner.surprise = candidate.named.surprise;
  winner.at_stiction = candidate.at_stiction;
  winner.others = screening.named;
  winner.generic = screening.generic;
  result_.winners.push_back(std::move(winner));
  result_.fit = std::move(candidate.fit);
  return true;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/acceptance.h"

#include <utility>

#include "runtime/diagnosis/competition/loop_disturbance.h"
#include "runtime/diagnosis/competition/sandwich_test.h"

namespace dyngen::runtime {

void Acceptance::begin_round() {
  at_bound_.reset();
  if (options_.with_regressor) known_ = model_information(data_.fit, result_.noise);
}

std::optional<Acceptance::Accepted> Acceptance::accept(Candidate candidate,
                                                       const Screening& screening) {
  // a bound that holds the estimate, a falsifier, or a parameter that the data do not determine
  // speak against the name
  const int own = static_cast<int>(candidate.fit.point.effects.size()) - 1;
  bool doubtful = false, only_bounds = true;
  for (const EffectRemark& remark : candidate.fit.remarks) {
    if (!candidate.fit.objects(remark, own)) continue;
    doubtful = true;
    only_bounds = only_bounds && remark.kind == EffectRemark::Kind::kAtBound;
  }
  if (!doubtful) return judged(std::move(candidate), screening);
  if (only_bounds && !at_bound_) at_bound_ = std::move(candidate);
  return std::nullopt;
}

std::optional<Acceptance::Accepted> Acceptance::accept_at_bound(const Screening& screening) {
  if (!at_bound_) return std::nullopt;
  return judged(*std::exchange(at_bound_, std::nullopt), screening);
}

HeldoutProof Acceptance::proof_of(const EffectFit& next) const {
  return heldout_proof(data_.heldout, result_.fit.point, next.point, result_.noise, known_);
}

/// Whether its own columns in each period, or the half-band test, ask for another size.
bool Acceptance::refuted(const Candidate& candidate) const {
  const Hypothesis& hypothesis = sought_.hypotheses[candidate.named.hypothesis];
  if (result_.noise.from_periods) {
    const EvidenceSystem system =
        system_beside(data_.evidence, data_.signals, sought_.hypotheses, result_, result_.fit.point,
                      result_.noise, options_);
    if (scatter_refutes(data_.evidence, data_.signals, system, hypothesis,
                        candidate.named.best.effect)) {
      return true;
    }
  }
  return data_.half_band.contradicts(sought_.hypotheses, result_, hypothesis, candidate.fit.point,
                                     options_);
}

/// Whether a disturbance inside the loop shows beside it, beside which it is no more than noise.
bool Acceptance::is_disturbance(const Candidate& candidate, const Screening& screening) const {
  if (result_.noise.from_periods || !options_.with_regressor) return false;
  const LoopDisturbance disturbance(data_.evidence, result_.noise, false_alarm_);
  const Hypothesis& hypothesis = sought_.hypotheses[candidate.named.hypothesis];
  NamedResult named = candidate.named;
  EvidenceSystem::Options options = options_;
  options.surrogates = 0;
  const EvidenceSystem system = system_beside(data_.evidence, data_.signals, sought_.hypotheses,
                                              result_, result_.fit.point, result_.noise, options);
  std::vector<int> linear, all;
  for (const int p : hypothesis.linear) linear.push_back(1 + p);
  all = linear;
  for (const int p : hypothesis.shapes) {
    if (!hypothesis.windowed) all.push_back(1 + p);
  }
  const auto white = [&](const std::vector<int>& wanted) {
    return system.whitened(
        effect_columns(data_.evidence, data_.signals, named.best.effect, wanted, hypothesis.held));
  };
  const std::optional<Score> left = disturbance.beside_it(system, white(linear), white(all));
  if (!left) return false;
  named.best.score = *left;
  return screening.family_wise(surprise_of_refined(named, hypothesis)) > false_alarm_;
}

/// Whether held-out recordings speak for it, or, of one beyond doubt, agree with it; an event is
/// not in them and must only not harm them.
bool Acceptance::proved(const Candidate& candidate, HeldoutProof proof) const {
  const Hypothesis& hypothesis = sought_.hypotheses[candidate.named.hypothesis];
  proof.parameters = static_cast<double>(sought_.parameters(candidate.named.hypothesis));
  proof.fitted = candidate.named.best.score.delta_chi2;
  if (hypothesis.windowed) {
    return candidate.beside == EffectConditions::Beside::kNothing && !proof.harms();
  }
  return proof.helps() || (candidate.beyond_doubt && proof.agrees());
}

std::optional<Acceptance::Accepted> Acceptance::judged(Candidate candidate,
                                                       const Screening& screening) const {
  if (refuted(candidate) || !proved(candidate, proof_of(candidate.fit)) ||
      is_disturbance(candidate, screening)) {
    return std::nullopt;
  }
  Winner winner;
  winner.hypothesis = candidate.named.hypothesis;
  winner.trial = std::move(candidate.named.best);
  winner.surprise = candidate.named.surprise;
  winner.at_stiction = candidate.at_stiction;
  winner.outdone = candidate.beside == EffectConditions::Beside::kOutdone;
  winner.others = screening.named;
  winner.generic = screening.generic;
  return Accepted{std::move(winner), std::move(candidate.fit)};
}

}  // namespace dyngen::runtime

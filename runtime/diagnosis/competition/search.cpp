// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/search.h"

#include <utility>

namespace dyngen::runtime {
namespace {

constexpr double kLeastCounted = 0.35;  // of the equations of a joint that moves, beside its rests

/// Parameters of the model without effects: typical sizes are parts of its friction.
Eigen::VectorXd model_alone(const EffectRecordings& train) {
  EffectFitOptions once;
  once.most_rounds = 1;
  return fit_effects(train, {}, once).point.beta;
}

}  // namespace

Search::Search(const DiagnosisInput& input, Eigen::Index decimation, const EquationRules& rules)
    : input_(input),
      decimation_(decimation),
      rules_(rules),
      parts_(input.heldout.empty() ? divided(input.train, rules)
                                   : Division{input.train, input.heldout}),
      seen_{.rows = diagnosis_rows(parts_.train, decimation), .rules = rules},
      views_(views_of(input, parts_, seen_)),
      moving_(counted_part(views_.train)) {}

void Search::compete(CompetitionOptions options, const CompetitionProgress& progress) {
  const ScaleTable scales(views_.train);
  const Eigen::VectorXd alone = model_alone(views_.train);
  for (const EffectInstance& effect : input_.hypotheses) {
    hypotheses_.push_back(hypothesis_of(effect, scales.of(alone, effect)));
  }
  options.until_rest = true;
  for (;;) {
    Witness slow(views_.slow);
    result_ = runtime::compete(views_.evidence(), views_.train, slow, views_.proof, hypotheses_,
                               options, progress);
    if (!options.until_rest || result_.resting.empty()) return;
    // where that would leave too little, impulses at their reversals are left out instead
    options.until_rest = look_beside(result_.resting);
    options.rests = true;
  }
}

/// @return whether equations are left out that had not been before
bool Search::look_beside(const std::vector<RestingJoint>& found) {
  std::vector<RestingJoint> joints = seen_.resting;
  if (!join(joints, found)) return false;
  const ViewOptions beside = beside_rests(
      {.rows = diagnosis_rows(parts_.train, decimation_), .rules = rules_}, parts_.train, joints);
  Views views = views_of(input_, parts_, beside);
  const Eigen::ArrayXd left = counted_part(views.train).array();
  if ((left < kLeastCounted * moving_.array()).any()) return false;
  if (!whole_) whole_ = Whole{std::move(views_.train), std::move(views_.heldout)};
  seen_ = beside;
  views_ = std::move(views);
  return true;
}

const EffectRecordings& Search::shown_train() const {
  return whole_ ? whole_->train : views_.train;
}

const EffectRecordings& Search::shown_heldout() const {
  return whole_ ? whole_->heldout : views_.heldout;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/equation_sets/left_out_rows.h"

namespace dyngen::runtime {
namespace {

constexpr double kLeastCounted =
    0.35;  // of the equations of a joint that moves, beside its stiction intervals

/// Parameters of the model without effects: typical sizes are parts of its friction.
Eigen::VectorXd model_alone(const EffectRecordings& train) {
  EffectFitOptions once;
  once.most_rounds = 1;
  return fit_effects(train, {}, once).point.beta;
}

/// Whether an effect is of a joint that is masked, or of a pair with one.
bool acts_on_masked(const EffectRecordings& data, const EffectInstance& effect) {
  const auto masked = [&](int joint) {
    return joint >= 0 && joint < data.joints() && data.is_masked(joint);
  };
  return masked(effect.joint) || masked(effect.other);
}

/// What is computed of any of them is added there.
void count_in(EquationSets& sets, const std::shared_ptr<WorkCount>& work) {
  for (EffectRecordings* own : {&sets.train, &sets.heldout, &sets.proof, &sets.slow}) {
    own->work = work;
  }
  if (sets.beside) sets.beside->work = work;
}

}  // namespace

Search::Search(const DiagnosisInput& input, Eigen::Index decimation, const EquationRules& rules)
    : input_(input),
      decimation_(decimation),
      rules_(rules),
      parts_(input.heldout.empty() ? divided(input.train, rules)
                                   : Division{input.train, input.heldout}),
      seen_{.rows = diagnosis_rows(parts_.train, decimation), .rules = rules},
      sets_(equation_sets_of(input, parts_, seen_)) {
  mask_joints();
  moving_ = counted_part(sets_.train);
  count_in(sets_, work_);
}

/// Takes joints with too few equations out of all sets.
void Search::mask_joints() {
  unjudged_ = unjudged_joints(sets_.train, rules_);
  for (const UnjudgedJoint& own : unjudged_) masked_.push_back(own.joint);
  leave_out_joints(sets_, masked_);
  seen_.masked = masked_;
}

/// Equations as they are before joints are found to stick.
EquationSetOptions Search::plain() const {
  return {.rows = diagnosis_rows(parts_.train, decimation_), .rules = rules_, .masked = masked_};
}

/// What may compete: effects of joints that are judged, with shapes that the recordings can show.
void Search::add_hypotheses() {
  const ScaleTable scales(sets_.train);
  const Eigen::VectorXd alone = model_alone(sets_.train);
  for (const EffectInstance& effect : input_.hypotheses) {
    if (acts_on_masked(sets_.train, effect)) continue;
    const EffectScales own = scales.of(alone, effect);
    const int slow = slower_than_recording(effect.law, own);
    if (slow < 0) {
      hypotheses_.push_back(hypothesis_of(effect, own));
      continue;
    }
    const std::string& shape = effect.law.parameters[static_cast<std::size_t>(slow)].name;
    std::string why = fmt::format("{}: no {} is within its bounds in {:.3g} s of recording",
                                  effect.law.name, shape, own.duration);
    if (std::find(not_offered_.begin(), not_offered_.end(), why) == not_offered_.end()) {
      not_offered_.push_back(std::move(why));
    }
  }
}

void Search::compete(CompetitionOptions options, const CompetitionProgress& progress) {
  add_hypotheses();
  options.until_stiction = true;
  for (;;) {
    EffectSignals signals(sets_.evidence());
    HalfBandTest half_band(sets_.slow);
    const CompetitionData data{.evidence = sets_.evidence(),
                               .signals = signals,
                               .fit = sets_.train,
                               .half_band = half_band,
                               .heldout = sets_.proof};
    result_ = runtime::compete(data, hypotheses_, options, progress);
    if (!options.until_stiction || result_.sticking.empty()) return;
    // where that would leave too little, impulses at their reversals are left out instead
    options.until_stiction = look_beside(result_.sticking);
    options.sticks = true;
  }
}

/// @return whether equations are left out that had not been before
bool Search::look_beside(const std::vector<StictionJoint>& found) {
  std::vector<StictionJoint> joints = seen_.sticking;
  if (!join(joints, found)) return false;
  const EquationSetOptions beside = beside_stiction(plain(), parts_.train, joints);
  EquationSets sets = equation_sets_of(input_, parts_, beside);
  const Eigen::ArrayXd left = counted_part(sets.train).array();
  if ((left < kLeastCounted * moving_.array()).any()) return false;
  if (!whole_) whole_ = Whole{std::move(sets_.train), std::move(sets_.heldout)};
  seen_ = beside;
  sets_ = std::move(sets);
  count_in(sets_, work_);
  return true;
}

const EffectRecordings& Search::shown_train() const { return whole_ ? whole_->train : sets_.train; }

Search::Judged Search::judged() const {
  EquationSetOptions whole = plain();
  EquationSetOptions own = seen_;
  for (int joint = 0; joint < input_.model.joints(); ++joint)
    whole.sticking.push_back({joint, 0, {}});
  own.sticking = whole.sticking;
  return {away_from_stiction(shown_train(), parts_.train, whole),
          away_from_stiction(shown_heldout(), parts_.heldout, whole),
          away_from_stiction(sets_.proof, parts_.heldout, own)};
}

const EffectRecordings& Search::shown_heldout() const {
  return whole_ ? whole_->heldout : sets_.heldout;
}

}  // namespace dyngen::runtime

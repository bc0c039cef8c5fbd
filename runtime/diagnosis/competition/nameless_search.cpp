// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/nameless_search.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/competition/likely_structure.h"
#include "runtime/diagnosis/competition/loop_disturbance.h"
#include "runtime/diagnosis/competition/nameless_proof.h"
#include "runtime/diagnosis/competition/sandwich_test.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;
using Form = GenericStructure::Form;

constexpr double kUnheldCaution = 0.01;  // of the false alarms: nothing held out speaks for it
constexpr std::ptrdiff_t kCandidates = 4;
constexpr double kRuledOutNet = 15;  // squares, net: a form that cannot be is no small thing

/// Independent samples that the noise of its joints is known by.
double least_worth(const JointColumns& columns, const EvidenceSystem& system) {
  double least = system.worth(columns.joints.front());
  for (const int joint : columns.joints) least = std::min(least, system.worth(joint));
  return least;
}

}  // namespace

/// Structures that are more than noise, the strongest first, a few. Impulses of a joint that sticks
/// are known, and what is little beside them is nothing.
std::vector<const GenericResult*> NamelessSearch::candidates(const Screening& screening) const {
  std::vector<const GenericResult*> strongest;
  for (const GenericResult& generic : screening.generic) {
    const GenericStructure& structure = sought_.structures[generic.structure];
    const bool known = structure.form == Form::kImpulses && stiction_.sticks(structure.joint);
    // where nothing repeats, what depends on time alone is noise
    const bool of_time = !result_.noise.from_periods && structure.form == Form::kFunction &&
                         structure.variables.front().kind == StructureVariable::Kind::kTime;
    const double squares = generic.score.delta_chi2 - generic.score.degrees;
    if (known || of_time || squares < stiction_.unseen_on({structure.joint})) continue;
    if (screening.family_wise(generic.surprise) <= false_alarm_) strongest.push_back(&generic);
  }
  std::stable_sort(strongest.begin(), strongest.end(),
                   [&](const GenericResult* a, const GenericResult* b) {
                     const bool first = sought_.structures[a->structure].is_specific();
                     const bool second = sought_.structures[b->structure].is_specific();
                     return first != second ? first : a->surprise > b->surprise;
                   });
  const auto repeating =
      std::find_if(strongest.begin(), strongest.end(), [&](const GenericResult* generic) {
        return !sought_.structures[generic->structure].is_specific();
      });
  if (repeating - strongest.begin() > kCandidates) {
    strongest.erase(strongest.begin() + kCandidates, repeating);
  }
  return strongest;
}

std::vector<StictionJoint> NamelessSearch::sticking(const EvidenceSystem& system,
                                                    const Screening& screening) const {
  const std::vector<const GenericResult*> strongest = candidates(screening);
  if (strongest.empty()) return {};
  std::vector<StictionJoint> joints =
      stiction_.sticking(system, screening, sought_.structures[strongest.front()->structure]);
  return joints.empty() ? stiction_.strongest(system, screening) : joints;
}

std::optional<Nameless> NamelessSearch::next(const EvidenceSystem& system,
                                             const Screening& screening) const {
  if (std::optional<Nameless> form = next_ruled_out(system, screening)) return form;
  bool specific = true;  // the strongest of them may still be said
  for (const GenericResult* generic : candidates(screening)) {
    const GenericStructure& structure = sought_.structures[generic->structure];
    if (structure.is_specific() && !specific) continue;
    if (has_nameless(result_, structure.joint)) {
      specific = false;
      continue;
    }
    std::optional<Nameless> nameless = confirmed(nameless_of(*generic, ""), system, result_.noise,
                                                 !sure(screening, generic->surprise));
    if (nameless) return nameless;
  }
  return std::nullopt;
}

std::optional<Nameless> NamelessSearch::next_likely(const ModelSide& plain) const {
  const std::optional<LikelyStructure> likely =
      likeliest_structure(data_.evidence, data_.signals, sought_.structures, result_, plain);
  if (!likely || plain.screening.family_wise(likely->generic.surprise) > false_alarm_) {
    return std::nullopt;
  }
  const std::vector<double> no_repeats(data_.evidence.runs.size(), 0.0);
  const TorqueNoiseModel noise = torque_noise_model(data_.evidence, likely->residuals, no_repeats,
                                                    options_.with_regressor, options_.rules.noise);
  const EvidenceSystem system = system_beside(data_.evidence, data_.signals, sought_.hypotheses,
                                              result_, result_.fit.point, noise, options_);
  return confirmed(nameless_of(likely->generic, ""), system, noise, true);
}

bool NamelessSearch::sure(const Screening& screening, double surprise) const {
  // noise of the residual has much of the structure in it: the p-value is too large anyway
  const double caution = result_.noise.free_of_structure() ? kUnheldCaution : 1;
  return screening.family_wise(surprise) <= caution * false_alarm_;
}

bool NamelessSearch::is_costly(const std::string& effect) const {
  return std::any_of(result_.nameless.begin(), result_.nameless.end(),
                     [&](const Nameless& nameless) { return nameless.costly == effect; });
}

/// The largest surprise of generic structure on some joints.
double NamelessSearch::structure_surprise(const Screening& screening,
                                          const std::vector<int>& joints) const {
  double most = 0;
  for (const GenericResult& generic : screening.generic) {
    const int joint = sought_.structures[generic.structure].joint;
    if (!sought_.structures[generic.structure].is_specific()) continue;
    if (std::find(joints.begin(), joints.end(), joint) == joints.end()) continue;
    most = std::max(most, generic.surprise);
  }
  return most;
}

/// The strongest effect that a bound or a falsifier rules out, if it is more than any other
/// structure there: it is of that form.
std::optional<Nameless> NamelessSearch::next_ruled_out(const EvidenceSystem& system,
                                                       const Screening& screening) const {
  const std::vector<RuledOut> candidates = ruled_out(screening);
  const RuledOut* strongest = strongest_apart_from_stiction(candidates, system, screening);
  if (!strongest || strongest->named.surprise < structure_surprise(screening, strongest->joints)) {
    return std::nullopt;
  }
  Nameless nameless;
  nameless.structure.joint = strongest->joints.front();
  nameless.surprise = strongest->named.surprise;
  nameless.ruled_out = strongest->named.best.effect;
  nameless.objection = strongest->named.best.objection;
  return confirmed(std::move(nameless), system, result_.noise, false);
}

/// Effects that a bound or a falsifier rules out and that are beyond doubt, the strongest first.
std::vector<NamelessSearch::RuledOut> NamelessSearch::ruled_out(const Screening& screening) const {
  std::vector<RuledOut> candidates;
  for (const NamedResult& each : screening.named) {
    if (!each.seen || each.freest.admissible) continue;
    NamedResult named = without_conditions(each);
    const double net = net_of(sought_.hypotheses[named.hypothesis], named.best, result_.noise);
    if (net <= kRuledOutNet || !sure(screening, named.surprise)) continue;
    std::vector<int> joints = sought_.joints(named.hypothesis);
    // beside a joint that sticks, what friction left of the stops looks like friction that cannot
    // be
    if (std::any_of(joints.begin(), joints.end(), [&](int joint) {
          return has_nameless(result_, joint) || stiction_.sticks(joint);
        })) {
      continue;
    }
    candidates.push_back({std::move(named), std::move(joints), net});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const RuledOut& a, const RuledOut& b) { return a.net > b.net; });
  return candidates;
}

/// The first that reversals of its joints do not hide, or none. Reversals are left out once for all
/// candidates of the same joints.
const NamelessSearch::RuledOut* NamelessSearch::strongest_apart_from_stiction(
    const std::vector<RuledOut>& candidates, const EvidenceSystem& system,
    const Screening& screening) const {
  const RuledOut* strongest = nullptr;
  std::set<std::vector<int>> asked;
  for (const RuledOut& first : candidates) {
    if (strongest && first.net <= strongest->net) break;
    if (!asked.insert(first.joints).second) continue;
    const EvidenceSystem beside = stiction_.beside_reversals(system, first.joints);
    for (const RuledOut& candidate : candidates) {
      if (strongest && candidate.net <= strongest->net) break;
      if (candidate.joints != first.joints) continue;
      const Hypothesis& hypothesis = sought_.hypotheses[candidate.named.hypothesis];
      if (!stiction_.nothing_left_in(beside, screening, hypothesis, candidate.named)) {
        strongest = &candidate;
      }
    }
  }
  return strongest;
}

Nameless NamelessSearch::nameless_of(const GenericResult& generic,
                                     const std::string& costly) const {
  Nameless nameless;
  nameless.structure = sought_.structures[generic.structure];
  nameless.structure.frequency = generic.frequency;
  nameless.surprise = generic.surprise;
  nameless.costly = costly;
  return nameless;
}

/// Whether held-out recordings let it be said.
bool NamelessSearch::is_proved(const Nameless& nameless, const TorqueNoiseModel& noise,
                               bool needs_proof) const {
  if (!is_provable(nameless)) return !needs_proof;
  const ProofData data{data_.evidence, data_.signals, data_.heldout};
  return is_supported(nameless_proof(data, sought_.hypotheses, result_, noise, nameless, options_),
                      !needs_proof);
}

/// Whether a disturbance inside the loop shows beside structure, beside which that is no more than
/// noise.
bool NamelessSearch::is_disturbance(const Nameless& nameless, const JointColumns& white,
                                    const EvidenceSystem& system,
                                    const TorqueNoiseModel& noise) const {
  if (noise.from_periods || !options_.with_regressor) return false;
  const LoopDisturbance disturbance(data_.evidence, noise, false_alarm_);
  const std::optional<Score> left = disturbance.beside_it(system, white, white);
  if (!left) return false;
  const double surprise =
      surprise_of(left->delta_chi2, nameless.score.degrees, least_worth(white, system));
  return result_.last.family_wise(surprise) > false_alarm_;
}

/// With its score beside the model, unless something contradicts it.
/// @param noise        of the system
/// @param needs_proof  that held-out recordings have it too
std::optional<Nameless> NamelessSearch::confirmed(Nameless nameless, const EvidenceSystem& system,
                                                  const TorqueNoiseModel& noise,
                                                  bool needs_proof) const {
  const int joint = nameless.structure.joint;
  const JointColumns plain = nameless_columns(data_.evidence, data_.signals, nameless);
  const JointColumns white = system.whitened(plain);
  nameless.score = score_of(system.products(white, false), false);
  if (!is_proved(nameless, noise, needs_proof)) return std::nullopt;
  if (is_disturbance(nameless, white, system, noise)) return std::nullopt;
  const auto own = std::find(plain.joints.begin(), plain.joints.end(), joint);
  const auto place = static_cast<std::size_t>(own - plain.joints.begin());
  if (data_.half_band.contradicts(sought_.hypotheses, result_, nameless, options_))
    return std::nullopt;
  if (noise.from_periods && sandwich_test(system, white, nameless.score.coefficients).refutes()) {
    return std::nullopt;
  }
  const VectorXd& size = nameless.score.coefficients;
  // of the torque as much as the model does not absorb of its whitened squares
  const double left = (system.left_of(white, joint) * size).squaredNorm();
  const double whole = (white.parts[place] * size).squaredNorm();
  const double mean =
      (plain.parts[place] * size).squaredNorm() / static_cast<double>(plain.parts[place].rows());
  nameless.rms = std::sqrt(whole > 0 ? mean * left / whole : 0);
  return nameless;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/stiction_impulses.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLevel = 0.01;  // at which impulses are seen: a joint that sticks is no accusation
constexpr double kGoodPart = 1.0 / 3;  // of the squares of impulses: what explains it makes them
constexpr double kImperfect = 0.02;    // of the squares of impulses: what their shape leaves
constexpr double kThrough = 0.002;     // of those of another joint: it jolts the whole arm
constexpr double kKnown = 4;  // squares: an effect that would have as many elsewhere is seen there

/// Whether torque goes with the way since the joint last turned.
bool is_since_reversal(const GenericStructure& structure) {
  return structure.form == GenericStructure::Form::kFriction && structure.variables.size() == 1 &&
         structure.variables.front() ==
             StructureVariable{StructureVariable::Kind::kDistance, structure.joint};
}

/// Columns that are not 0 in one recording alone, by recordings.
/// @param part  (equations x columns) each within one run
std::vector<std::vector<Index>> columns_of_recordings(const EffectRecordings& data,
                                                      const MatrixXd& part) {
  std::vector<int> recordings;  // of every equation
  int count = 0;
  for (const EffectRun& run : data.runs) {
    recordings.insert(recordings.end(), static_cast<std::size_t>(run.rows.Y.rows()), run.recording);
    count = std::max(count, run.recording + 1);
  }
  std::vector<std::vector<Index>> columns(static_cast<std::size_t>(count));
  for (Index c = 0; c < part.cols(); ++c) {
    Index row = 0;
    part.col(c).cwiseAbs().maxCoeff(&row);
    columns[static_cast<std::size_t>(recordings[static_cast<std::size_t>(row)])].push_back(c);
  }
  return columns;
}

}  // namespace

bool StictionImpulses::sticks(int joint) const {
  return std::any_of(sticking_.begin(), sticking_.end(),
                     [&](const StictionJoint& sticking) { return sticking.joint == joint; });
}

double StictionImpulses::unseen_on(const std::vector<int>& joints) const {
  double most = 0;
  for (const StictionJoint& sticking : sticking_) {
    const bool own = std::find(joints.begin(), joints.end(), sticking.joint) != joints.end();
    most = std::max(most, (own ? kImperfect : kThrough) * sticking.squares);
  }
  return most;
}

/// Whether a single test by itself would say so.
bool StictionImpulses::significant(double surprise) { return std::exp(-surprise) < kLevel; }

const GenericResult* StictionImpulses::impulses_at(const Screening& screening, int joint) const {
  for (const GenericResult& generic : screening.generic) {
    const GenericStructure& structure = sought_.structures[generic.structure];
    if (structure.form == GenericStructure::Form::kImpulses && structure.joint == joint)
      return &generic;
  }
  return nullptr;
}

/// Surprise of the impulses at the reversals of a joint.
double StictionImpulses::impulses_of(const Screening& screening, int joint) const {
  const GenericResult* impulses = impulses_at(screening, joint);
  return impulses ? impulses->surprise : 0;
}

StictionImpulses::Part StictionImpulses::part_in(const EvidenceSystem& system,
                                                 const Screening& screening,
                                                 const Hypothesis& hypothesis,
                                                 const NamedResult& named) const {
  // what is late is late everywhere, not only where a joint that sticks lets go late
  const bool everywhere = hypothesis.effect.law.kind == EffectKind::kAlignment;
  if (everywhere && hide(system, screening, hypothesis, named)) return Part::kAll;
  EvidenceSystem beside = system, beside_effect = system;
  bool any = false, much_left = false;
  double squares = 0, degrees = 0, beside_it = 0;  // of the impulses
  const auto white_beside = [&](const EvidenceSystem& model) {
    return hypothesis_columns(data_.evidence, data_.signals, model, hypothesis, named.best.effect);
  };
  for (const int joint : joints_of(hypothesis.effect, data_.evidence.joints())) {
    if (sticks(joint) || !significant(impulses_of(screening, joint))) continue;
    const JointColumns impulses = system.whitened(
        generic_columns(data_.evidence, data_.signals, impulses_at_reversals(joint)));
    if (!any) beside_effect.add(white_beside(system));
    any = true;
    const Score& alone = impulses_at(screening, joint)->score;
    squares += alone.delta_chi2;
    degrees += alone.degrees;
    const Score left = score_of(beside_effect.products(impulses, false), false);
    beside_it += left.delta_chi2;
    much_left = much_left || significant(surprise_of(left.delta_chi2, left.degrees));
    beside.leave_out(impulses);
  }
  if (!any || !much_left) return Part::kNone;
  const Products products = beside.products(white_beside(beside), false);
  // an effect of this size would be seen elsewhere, and there it is smaller by half or more
  const VectorXd& size = named.best.score.coefficients;
  const double expected = size.dot(products.left * size);
  if (expected > kKnown && size.dot(products.rest) < 0.5 * expected) return Part::kAll;
  const Score left = score_of(products, false);
  if (screening.family_wise(surprise_of(left.delta_chi2, left.degrees)) <= false_alarm_) {
    return Part::kNone;
  }
  const bool makes_them =
      !everywhere && named.best.score.delta_chi2 > kGoodPart * std::max(0.0, squares - degrees) &&
      beside_it < kHardlyMoreThanNoise * degrees;
  return makes_them ? Part::kBecause : Part::kAll;
}

EvidenceSystem StictionImpulses::beside_reversals(const EvidenceSystem& system,
                                                  const std::vector<int>& joints) const {
  EvidenceSystem beside = system;
  for (const int joint : joints) {
    if (sticks(joint)) continue;
    beside.leave_out(system.whitened(
        generic_columns(data_.evidence, data_.signals, impulses_at_reversals(joint))));
  }
  return beside;
}

bool StictionImpulses::nothing_left_in(const EvidenceSystem& beside, const Screening& screening,
                                       const Hypothesis& hypothesis,
                                       const NamedResult& named) const {
  const Score left = score_of(
      beside.products(
          hypothesis_columns(data_.evidence, data_.signals, beside, hypothesis, named.best.effect),
          false),
      false);
  return screening.family_wise(surprise_of(left.delta_chi2, left.degrees)) > false_alarm_;
}

bool StictionImpulses::hide(const EvidenceSystem& system, const Screening& screening,
                            const Hypothesis& hypothesis, const NamedResult& named) const {
  const EvidenceSystem beside =
      beside_reversals(system, joints_of(hypothesis.effect, data_.evidence.joints()));
  return nothing_left_in(beside, screening, hypothesis, named);
}

std::vector<StictionJoint> StictionImpulses::sticking(const EvidenceSystem& system,
                                                      const Screening& screening,
                                                      const GenericStructure& structure) const {
  const double impulses = impulses_of(screening, structure.joint);
  if (sticks(structure.joint) || !significant(impulses)) return {};
  // a rest that is longer than an impulse looks like friction that goes with the way since then
  const bool long_stiction =
      is_since_reversal(structure) && screening.family_wise(impulses) <= kLevel;
  if (structure.form != GenericStructure::Form::kImpulses && !long_stiction) {
    EvidenceSystem beside = system;
    const auto white = [&](const GenericStructure& own) {
      return beside.whitened(generic_columns(data_.evidence, data_.signals, own));
    };
    beside.leave_out(white(impulses_at_reversals(structure.joint)));
    const Score left = score_of(beside.products(white(structure), false), false);
    const double surprise = surprise_of(left.delta_chi2, left.degrees);
    if (screening.family_wise(surprise) <= false_alarm_) return {};
  }
  std::vector<StictionJoint> joints = {found(system, screening, structure.joint)};
  for (const StictionJoint& other : strongest(system, screening)) {
    if (other.joint != structure.joint) joints.push_back(other);
  }
  return joints;
}

std::vector<StictionJoint> StictionImpulses::strongest(const EvidenceSystem& system,
                                                       const Screening& screening) const {
  std::vector<StictionJoint> joints;
  for (int j = 0; j < data_.evidence.joints(); ++j) {
    const double impulses = impulses_of(screening, j);
    if (sticks(j) || screening.family_wise(impulses) > kLevel) continue;
    const bool strongest = std::all_of(
        screening.generic.begin(), screening.generic.end(), [&](const GenericResult& generic) {
          const GenericStructure& structure = sought_.structures[generic.structure];
          return structure.joint != j || !structure.is_specific() || generic.surprise <= impulses;
        });
    if (strongest) joints.push_back(found(system, screening, j));
  }
  return joints;
}

StictionJoint StictionImpulses::found(const EvidenceSystem& system, const Screening& screening,
                                      int joint) const {
  StictionJoint sticking{joint, impulses_at(screening, joint)->score.delta_chi2, {}};
  const JointColumns impulses =
      generic_columns(data_.evidence, data_.signals, impulses_at_reversals(joint));
  const Products products = system.products(system.whitened(impulses), false);
  const std::vector<std::vector<Index>> own =
      columns_of_recordings(data_.evidence, impulses.parts[0]);
  for (std::size_t recording = 0; recording < own.size(); ++recording) {
    const Products part{products.whole(own[recording], own[recording]),
                        products.left(own[recording], own[recording]),
                        products.rest(own[recording]),
                        {}};
    const Score score = score_of(part, false);
    if (significant(surprise_of(score.delta_chi2, score.degrees))) {
      sticking.recordings.push_back(static_cast<int>(recording));
    }
  }
  const bool in_some = !sticking.recordings.empty() && 2 * sticking.recordings.size() <= own.size();
  if (in_some) return sticking;
  // none by itself shows it, or most do, and in the others it sticks too briefly to be seen
  sticking.recordings.resize(own.size());
  std::iota(sticking.recordings.begin(), sticking.recordings.end(), 0);
  return sticking;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/stops.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

constexpr double kGoodPart = 1.0 / 3;  // of the squares of impulses: what explains it makes them

}  // namespace

bool Stops::rests(int joint) const {
  return std::find(resting_.begin(), resting_.end(), joint) != resting_.end();
}

/// Whether a single test by itself would say so.
bool Stops::significant(double surprise) const { return std::exp(-surprise) < false_alarm_; }

const GenericResult* Stops::impulses_at(const Screening& screening, int joint) const {
  for (const GenericResult& generic : screening.generic) {
    const GenericStructure& structure = structures_[generic.structure];
    if (structure.at_reversals && structure.joint == joint) return &generic;
  }
  return nullptr;
}

/// Surprise of the impulses at the reversals of a joint.
double Stops::impulses_of(const Screening& screening, int joint) const {
  const GenericResult* impulses = impulses_at(screening, joint);
  return impulses ? impulses->surprise : 0;
}

Stops::Part Stops::part_in(const EvidenceSystem& system, const Screening& screening,
                           const Hypothesis& hypothesis, const NamedResult& named) const {
  EvidenceSystem beside = system, beside_effect = system;
  bool any = false, much_left = false;
  double impulses_squares = 0;  // less their expectation under noise
  const auto white_beside = [&](const EvidenceSystem& model) {
    return hypothesis_columns(data_, signals_, model, hypothesis, named.best.effect);
  };
  for (const int joint : joints_of(hypothesis.effect, data_.joints())) {
    if (rests(joint) || !significant(impulses_of(screening, joint))) continue;
    const JointColumns impulses =
        system.whitened(generic_columns(data_, signals_, impulses_at_reversals(joint)));
    if (!any) beside_effect.add(white_beside(system));
    any = true;
    const Score& alone = impulses_at(screening, joint)->score;
    impulses_squares += std::max(0.0, alone.squares - alone.degrees);
    const Score left = score_of(beside_effect.products(impulses, false), false);
    much_left = much_left || significant(surprise_of(left.squares, left.degrees));
    beside.leave_out(impulses);
  }
  if (!any || !much_left) return Part::kNone;
  const Score left = score_of(beside.products(white_beside(beside), false), false);
  if (screening.family_wise(surprise_of(left.squares, left.degrees)) <= false_alarm_) {
    return Part::kNone;
  }
  return named.best.score.squares > kGoodPart * impulses_squares ? Part::kBecause : Part::kAll;
}

std::vector<int> Stops::resting(const EvidenceSystem& system, const Screening& screening,
                                const GenericStructure& structure) const {
  if (rests(structure.joint) || !significant(impulses_of(screening, structure.joint))) return {};
  if (!structure.at_reversals) {
    EvidenceSystem beside = system;
    const auto white = [&](const GenericStructure& own) {
      return beside.whitened(generic_columns(data_, signals_, own));
    };
    beside.leave_out(white(impulses_at_reversals(structure.joint)));
    const Score left = score_of(beside.products(white(structure), false), false);
    const double surprise = surprise_of(left.squares, left.degrees);
    if (screening.family_wise(surprise) <= false_alarm_) return {};
  }
  std::vector<int> joints = {structure.joint};
  for (int j = 0; j < data_.joints(); ++j) {
    const double impulses = impulses_of(screening, j);
    if (j == structure.joint || rests(j)) continue;
    if (screening.family_wise(impulses) > false_alarm_) continue;
    const bool strongest = std::all_of(
        screening.generic.begin(), screening.generic.end(), [&](const GenericResult& generic) {
          return structures_[generic.structure].joint != j || generic.surprise <= impulses;
        });
    if (strongest) joints.push_back(j);
  }
  return joints;
}

}  // namespace dyngen::runtime

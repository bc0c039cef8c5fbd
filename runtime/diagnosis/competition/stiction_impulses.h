// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/sought.h"
#include "runtime/diagnosis/equation_sets/stiction_joint.h"

namespace dyngen::runtime {

/// Squares of impulses over their degrees: below it they are hardly more than noise.
inline constexpr double kHardlyMoreThanNoise = 2;

/// What dry friction does where a joint turns or stops: it holds the joint for an instant, with any
/// torque up to its own, and the equations have an impulse there. That is neither a name nor
/// structure: a joint of which it is seen `sticks`, and has its impulses beside the model.
class StictionImpulses {
 public:
  /// All must outlive it. @param sticking  as they are found
  StictionImpulses(const CompetitionData& data, const Sought& sought,
                   const std::vector<StictionJoint>& sticking, double false_alarm)
      : data_(data), sought_(sought), sticking_(sticking), false_alarm_(false_alarm) {}

  /// Whether a joint was found to rest.
  [[nodiscard]] bool sticks(int joint) const;

  /// Squares that are nothing on some joints where one of the robot sticks: the rest lasts, an
  /// impulse has not quite its shape, and what lets go jolts the others. 0 where none sticks.
  [[nodiscard]] double unseen_on(const std::vector<int>& joints) const;

  /// What the stops of its joints have to do with an effect.
  enum class Part {
    kNone,    ///< beside their impulses it is seen with the same size, or beside it there are none
    kAll,     ///< beside their impulses nothing is left of it, or far too little: they explain it
    kBecause  ///< little is to be expected of it beside them, but it explains a good part of them
              ///< and leaves hardly more than noise: it makes them
  };
  [[nodiscard]] Part part_in(const EvidenceSystem& system, const Screening& screening,
                             const Hypothesis& hypothesis, const NamedResult& named) const;
  /// Whether it is Part::kAll.
  [[nodiscard]] bool explain(const EvidenceSystem& system, const Screening& screening,
                             const Hypothesis& hypothesis, const NamedResult& named) const {
    return part_in(system, screening, hypothesis, named) == Part::kAll;
  }

  /// The model beside impulses at the reversals of some joints, seen or not; those of joints that
  /// rest it has already.
  [[nodiscard]] EvidenceSystem beside_reversals(const EvidenceSystem& system,
                                                const std::vector<int>& joints) const;
  /// Whether no more than noise is left of an effect there.
  [[nodiscard]] bool nothing_left_in(const EvidenceSystem& beside, const Screening& screening,
                                     const Hypothesis& hypothesis, const NamedResult& named) const;
  /// Whether nothing is left of it beside the reversals of its own joints.
  [[nodiscard]] bool hide(const EvidenceSystem& system, const Screening& screening,
                          const Hypothesis& hypothesis, const NamedResult& named) const;

  /// Joints that begin to rest: the structure's, if impulses at its reversals are more than noise
  /// and beside them the structure is not, or is a function of the way since then: a rest that is
  /// longer than an impulse; with it all others where impulses are the strongest structure. None if
  /// it is not so.
  [[nodiscard]] std::vector<StictionJoint> sticking(const EvidenceSystem& system,
                                                    const Screening& screening,
                                                    const GenericStructure& structure) const;
  /// Joints, besides those that rest already, where impulses are the strongest structure.
  [[nodiscard]] std::vector<StictionJoint> strongest(const EvidenceSystem& system,
                                                     const Screening& screening) const;

 private:
  [[nodiscard]] const GenericResult* impulses_at(const Screening& screening, int joint) const;
  [[nodiscard]] double impulses_of(const Screening& screening, int joint) const;
  [[nodiscard]] StictionJoint found(const EvidenceSystem& system, const Screening& screening,
                                    int joint) const;
  [[nodiscard]] static bool significant(double surprise);

  const CompetitionData& data_;
  const Sought& sought_;
  const std::vector<StictionJoint>& sticking_;
  double false_alarm_;
};

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition.h"
#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/diagnosis/equation_sets/division.h"
#include "runtime/diagnosis/equation_sets/equation_sets.h"
#include "runtime/diagnosis/equation_sets/sufficiency.h"

namespace dyngen::runtime {

/// What a diagnosis looks at and what its competition found there: all that an answer is told from.
/// Where joints are found to rest, it looks again beside their stiction intervals.
class Search {
 public:
  /// @param input  has to outlive it  @param decimation  as RowOptions
  /// @throws std::invalid_argument  if recordings do not fit the model
  Search(const DiagnosisInput& input, Eigen::Index decimation, const EquationRules& rules = {});

  void compete(CompetitionOptions options, const CompetitionProgress& progress);

  [[nodiscard]] const DiagnosisInput& input() const { return input_; }
  [[nodiscard]] const Division& parts() const { return parts_; }
  [[nodiscard]] const EquationSetOptions& seen() const { return seen_; }
  [[nodiscard]] const EquationSets& sets() const { return sets_; }
  /// Joints without equations enough, which all sets are without.
  [[nodiscard]] const std::vector<UnjudgedJoint>& unjudged() const { return unjudged_; }
  [[nodiscard]] const std::vector<Hypothesis>& hypotheses() const { return hypotheses_; }
  /// Effects that are none of them, since all their shapes are slower than the recordings:
  /// "thermal_time: no warm is within its bounds in 0.8 s of recording".
  [[nodiscard]] const std::vector<std::string>& not_offered() const { return not_offered_; }
  [[nodiscard]] const CompetitionResult& result() const { return result_; }
  [[nodiscard]] CompetitionResult& result() { return result_; }
  /// Recordings that an rms is of: all of their equations, sticks or not.
  [[nodiscard]] const EffectRecordings& shown_train() const;
  [[nodiscard]] const EffectRecordings& shown_heldout() const;
  /// The same, and the held-out equations (EquationSets::proof), away from the reversals of all
  /// joints, where friction can take any value: what a verdict is of.
  struct Judged {
    EffectRecordings train, heldout, proof;
  };
  [[nodiscard]] Judged judged() const;
  /// In 1e9 multiplications.
  [[nodiscard]] double work() const { return work_->done(); }

 private:
  void add_hypotheses();
  bool look_beside(const std::vector<StictionJoint>& found);
  void mask_joints();
  [[nodiscard]] EquationSetOptions plain() const;

  const DiagnosisInput& input_;
  Eigen::Index decimation_;
  EquationRules rules_;
  Division parts_;
  EquationSetOptions seen_;
  std::shared_ptr<WorkCount> work_ = std::make_shared<WorkCount>();
  EquationSets sets_;
  std::vector<UnjudgedJoint> unjudged_;
  std::vector<int> masked_;  ///< the same, from 0
  Eigen::VectorXd moving_;   ///< (n) part of the equations in which a joint does not stand still
  /// Recordings with the joint state that was chosen and where joints rest, if the sets are
  /// others.
  struct Whole {
    EffectRecordings train, heldout;
  };
  std::optional<Whole> whole_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<std::string> not_offered_;
  CompetitionResult result_;
};

}  // namespace dyngen::runtime

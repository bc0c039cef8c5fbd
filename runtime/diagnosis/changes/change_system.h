// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "runtime/diagnosis/changes/change_candidates.h"
#include "runtime/diagnosis/changes/possible_body.h"
#include "runtime/diagnosis/changes/session_scatter.h"
#include "runtime/rules/change_rules.h"

namespace dyngen::runtime {

/// A way in which a candidate may have changed: some of its parameters, or a load that is a point.
struct ChangeForm {
  std::size_t candidate = 0;
  bool body = false;      ///< all ten of a load: only bodies that can exist
  bool point = false;     ///< tangents of a point of mass
  Eigen::MatrixXd mix;    ///< (parameters x r) of the candidate's parameters
  Eigen::Index from = 0;  ///< place of its orthonormal columns
  Eigen::Index count = 0;
  double slab = 0;  ///< prior variance of each of them
};

/// Forms that changed together, ascending places.
using ChangeSet = std::vector<std::size_t>;

/// What one set says of its parameters.
struct ChangeEstimate {
  Eigen::VectorXd values, deviations;  ///< of all parameters of its candidates, one after another
  std::vector<bool> seen;              ///< false: no motion of the recordings shows the parameter
  Eigen::VectorXd reference;  ///< (common) parameters of both sides: those of the reference
};

/// The evidence of sessions for sets of changes: their log probability but for a constant.
///
/// Every form has orthonormal columns beside the common parameters, with independent normal priors
/// on their sizes; the scatter between sessions is integrated over.
class ChangeSystem {
 public:
  /// @param common       columns that both sides share
  /// @param false_alarm  P that sessions without a change are accused, by prior odds
  ChangeSystem(const std::vector<SessionEquations>& sessions, const SessionScatter& scatter,
               Eigen::Index common, std::vector<ChangeCandidate> candidates, double false_alarm,
               const ChangeRules& rules);

  [[nodiscard]] const ChangeRules& rules() const { return rules_; }

  [[nodiscard]] const std::vector<ChangeCandidate>& candidates() const { return candidates_; }
  [[nodiscard]] const std::vector<ChangeForm>& forms() const { return forms_; }
  [[nodiscard]] double log_evidence(const ChangeSet& set) const;
  /// The same without what bodies that cannot exist cost: an upper bound, and quick.
  [[nodiscard]] double upper_bound(const ChangeSet& set) const;
  /// Chi-square that a set explains at the scatter as it was estimated.
  [[nodiscard]] double chi_square(const ChangeSet& set) const;
  [[nodiscard]] Eigen::Index degrees(const ChangeSet& set) const;
  [[nodiscard]] ChangeEstimate estimate(const ChangeSet& set) const;
  /// Points of mass beside the other changes of a set.
  void place_points(const ChangeSet& set);

 private:
  /// At one scatter.
  struct Level {
    double log_weight = 0;  ///< of the scatter, without changes
    double scatter = 1;     ///< over the estimate
    LeftOfSessions of;      ///< raw columns, each over its length
    Eigen::MatrixXd gram;   ///< of all forms' orthonormal columns
    Eigen::VectorXd rest;
  };

  /// What the forms of a set let change.
  struct RawPlaces {
    std::vector<Eigen::Index> columns;     ///< raw ones
    std::vector<Eigen::Index> places;      ///< of each in an answer of all parameters
    std::vector<std::size_t> forms;        ///< of each
    std::vector<Eigen::Index> parameters;  ///< of each: its place in its candidate
    Eigen::Index all = 0;                  ///< parameters of an answer
  };

  /// Parameters over their lengths, averaged over the scatter.
  struct Fitted {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    std::vector<bool> seen;
  };

  void drop_absent();
  void join_equal();
  void make_forms(const ChangeSet& beside);
  void add_form(ChangeForm form, std::vector<Eigen::MatrixXd>& mixes);
  [[nodiscard]] double prior(const ChangeSet& set) const;
  [[nodiscard]] double body_price(const ChangeSet& set) const;
  /// What sizes beyond their bounds cost.
  [[nodiscard]] double bounds_price(const ChangeSet& set) const;
  [[nodiscard]] BodyEvidence evidence_of_load(std::size_t form, const ChangeSet& beside) const;
  [[nodiscard]] RawPlaces raw_places(const ChangeSet& set) const;
  [[nodiscard]] std::vector<Eigen::Index> columns_of(const ChangeSet& set) const;
  [[nodiscard]] double log_likelihood(const Level& level, const std::vector<Eigen::Index>& columns,
                                      const Eigen::VectorXd& slabs) const;
  [[nodiscard]] std::vector<double> level_weights(const ChangeSet& set) const;
  /// @param raw  columns
  [[nodiscard]] Fitted fitted(const std::vector<Eigen::Index>& raw,
                              const std::vector<double>& weights) const;
  [[nodiscard]] Eigen::VectorXd reference_beside(const std::vector<Eigen::Index>& raw,
                                                 const Eigen::VectorXd& mean) const;
  [[nodiscard]] Eigen::VectorXd slabs_of(const ChangeSet& set) const;

  const std::vector<SessionEquations>& sessions_;
  SessionScatter scatter_;
  Eigen::Index common_;
  std::vector<ChangeCandidate> candidates_;
  std::vector<Eigen::Index> first_;  ///< raw column of each candidate's first parameter
  Eigen::MatrixXd columns_;          ///< (K x raw) of later sessions, each over its length
  Eigen::MatrixXd reference_;        ///< the same of the reference: 0, but of effects of both sides
  Eigen::VectorXd length_;           ///< (raw) at the estimated scatter, before projection
  std::vector<Level> levels_;
  std::size_t centre_ = 0;
  std::vector<ChangeForm> forms_;
  ChangeRules rules_;
  double cost_ = 0;          ///< -log prior odds of a candidate
  double cost_of_both_ = 0;  ///< the same of an effect of both sides, which accuses nobody
};

}  // namespace dyngen::runtime

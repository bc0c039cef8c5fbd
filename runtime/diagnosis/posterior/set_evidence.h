// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace dyngen::runtime {

/// Columns that can be part of a model: one form of an effect, or structure without a name.
struct Candidate {
  Eigen::Index columns = 0;    ///< consecutive ones
  std::size_t hypothesis = 0;  ///< at most one candidate of a hypothesis is in a set
  double log_odds = 0;         ///< of being in a set, before the data
};

/// A set of candidates: their places, ascending.
using CandidateSet = std::vector<std::size_t>;

/// The log evidence of sets of candidates, over that of the empty set: with G = X'X and b = X'y of
/// whitened columns X beside a torque y, and independent normal coefficients of variance s2 a
/// column (the slab) in an orthonormal basis of each candidate,
///
///     1/2 b_g' (G_gg + I / s2)^-1 b_g - 1/2 log det(I + s2 G_gg) + sum of log_odds
///
/// (O'Hagan 1994, Kendall's Advanced Theory of Statistics 2B, 9.9; noise of variance 1).
class SetEvidence {
 public:
  /// @param G           (k x k) positive semidefinite   @param b  (k)
  /// @param candidates  whose columns are all k, in their order
  /// @param slab        s2 > 0, in units of the noise's variance
  /// @throws std::invalid_argument
  SetEvidence(const Eigen::MatrixXd& G, const Eigen::VectorXd& b, std::vector<Candidate> candidates,
              double slab);

  [[nodiscard]] std::size_t size() const { return candidates_.size(); }
  [[nodiscard]] const Candidate& candidate(std::size_t place) const { return candidates_[place]; }
  /// -infinity: two candidates are of one hypothesis.
  [[nodiscard]] double of(const CandidateSet& set) const;
  /// (size()) The same of the set with each other candidate; -infinity of those that cannot join.
  [[nodiscard]] Eigen::VectorXd with_each(const CandidateSet& set) const;
  /// (size() x size()) 0 .. 1: the largest correlation between columns of two candidates.
  [[nodiscard]] Eigen::MatrixXd likeness() const;

 private:
  [[nodiscard]] bool meets(const CandidateSet& set, std::size_t place) const;
  [[nodiscard]] std::vector<Eigen::Index> columns_of(const CandidateSet& set) const;
  /// G_gg + I / s2 of the set's columns.
  [[nodiscard]] Eigen::MatrixXd regularised(const std::vector<Eigen::Index>& columns) const;

  std::vector<Candidate> candidates_;
  double slab_;
  Eigen::MatrixXd G_;  // in orthonormal bases
  Eigen::VectorXd b_;
  std::vector<Eigen::Index> begin_;  // of each candidate's columns; and the end
};

}  // namespace dyngen::runtime

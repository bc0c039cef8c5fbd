// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_rows.h"
#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {

/// A direction below this part of the largest one, columns of unit norm, is not determined: far
/// above the rounding of a decomposition, far below what a recording moves.
inline constexpr double kRankTolerance = 1e-9;

/// How equations of each joint are made white and of unit variance.
struct Whitening {
  std::vector<JointNoise> joints;

  /// Joints times a weight, nothing more. @param weights  (n) 1/sigma
  static Whitening by_weights(const Eigen::VectorXd& weights);
};

/// Equations of all joints and runs as one system: joint by joint, in each run by run.
class EquationStack {
 public:
  EquationStack(const EffectRecordings& data, const Whitening& whitening);

  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  /// Of one joint over all runs: the first row and how many there are.
  [[nodiscard]] Eigen::Index first(int joint) const { return joint * of_joint_; }
  [[nodiscard]] Eigen::Index of_joint() const { return of_joint_; }

  /// J of all equations, and tau in the last column. @return (rows x size + 1)
  [[nodiscard]] Eigen::MatrixXd stacked(const EffectEquations& equations) const;
  /// Torque of an effect, and its derivatives by parameters, N m or N. @return (rows x 1 + np)
  [[nodiscard]] Eigen::MatrixXd plain(EffectSignals& signals, const EffectInstance& effect) const;
  /// The same, whitened. @param columns  of plain()
  [[nodiscard]] Eigen::MatrixXd whitened(Eigen::MatrixXd columns) const;

 private:
  /// A column of one joint and one run, whitened in place. Equations that do not count are 0.
  void whiten(Eigen::Ref<Eigen::MatrixXd> columns, std::size_t run, int joint) const;

  const EffectRecordings& data_;
  std::vector<std::vector<Whitener>> whiteners_;  // of each joint in each run
  std::vector<Eigen::Index> run_starts_;
  Eigen::Index of_joint_ = 0, rows_ = 0;
};

/// Orthonormal columns of the same span.
/// @param W  (m x k); directions below kRankTolerance are not counted
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& W);

/// Takes out of columns what others explain.
class Projection {
 public:
  /// As orthonormal().
  explicit Projection(const Eigen::MatrixXd& W) : basis_(orthonormal(W)) {}

  /// What is left of columns at right angles to W. @param columns  (m x any)
  [[nodiscard]] Eigen::MatrixXd rest(const Eigen::MatrixXd& columns) const;
  [[nodiscard]] Eigen::Index rank() const { return basis_.cols(); }

 private:
  Eigen::MatrixXd basis_;  ///< orthonormal columns
};

}  // namespace dyngen::runtime

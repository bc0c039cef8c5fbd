// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// Takes many columns out of others, each of which is 0 but for a few consecutive rows (impulses):
/// Householder's reflections, one for each column and as short as it is, turn all they span into
/// rows of their own, and these rows are dropped. What is left has the same inner products as what
/// a projection leaves, at a cost that grows with the columns' number and not with its square.
class LocalReflections {
 public:
  /// @param columns  (rows x k); those that depend on others are found and left out
  explicit LocalReflections(const Eigen::MatrixXd& columns);

  /// Turned, and 0 in the rows that are dropped. @param rows  (rows x any), in place
  void take_out_of(Eigen::Ref<Eigen::MatrixXd> rows) const;
  /// Back from there: what the projection leaves. @param rows  (rows x any), in place
  void turn_back(Eigen::Ref<Eigen::MatrixXd> rows) const;
  /// How many independent columns there were.
  [[nodiscard]] Eigen::Index rank() const { return static_cast<Eigen::Index>(reflections_.size()); }

 private:
  struct Reflection {
    Eigen::Index first = 0;    ///< row
    Eigen::Index dropped = 0;  ///< row
    Eigen::VectorXd normal;    ///< of unit length, from that first row on
  };
  static void reflect(const Reflection& reflection, Eigen::Ref<Eigen::MatrixXd> rows);

  std::vector<Reflection> reflections_;
};

}  // namespace dyngen::runtime

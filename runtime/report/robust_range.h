// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// What a chart shows of its values: few that are far off must not press all others into a line.
class RobustRange {
 public:
  /// Values that are shown; those that are not finite are none.
  void add(const Eigen::VectorXd& values);
  /// From the quantile of 0.5 % to that of 99.5 %, and as far again on both sides; all values where
  /// none is beyond. To be called once, after add().
  void settle();

  /// Values beyond the range become NaN, and are counted. @return  the others as they are
  Eigen::VectorXd without_outside(Eigen::VectorXd values);
  /// Values beyond the range become its ends, and are counted.
  Eigen::VectorXd cut(Eigen::VectorXd values);

  /// " 12 values up to 345 N m lie outside."; empty: none does.
  [[nodiscard]] std::string words(const std::string& unit) const;

 private:
  std::vector<double> values_;
  double low_ = 0, high_ = 0, farthest_ = 0;
  long outside_ = 0;
};

}  // namespace dyngen::runtime

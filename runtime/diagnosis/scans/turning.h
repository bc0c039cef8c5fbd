// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// cos and sin of n x for rising n, by turning them on: no sine is computed after the first.
class Turning {
 public:
  Turning(const Eigen::ArrayXd& x, double first, double step)
      : c_((first * x).cos()),
        s_((first * x).sin()),
        turn_c_((step * x).cos()),
        turn_s_((step * x).sin()) {}

  [[nodiscard]] const Eigen::ArrayXd& cosine() const { return c_; }
  [[nodiscard]] const Eigen::ArrayXd& sine() const { return s_; }
  void next() {
    const Eigen::ArrayXd c = c_ * turn_c_ - s_ * turn_s_;
    s_ = s_ * turn_c_ + c_ * turn_s_;
    c_ = c;
  }

 private:
  Eigen::ArrayXd c_, s_, turn_c_, turn_s_;
};

}  // namespace dyngen::runtime

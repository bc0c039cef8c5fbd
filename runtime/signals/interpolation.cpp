// SPDX-License-Identifier: MIT
#include "runtime/signals/interpolation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd shifted(const VectorXd& x, double shift) {
  const double whole = std::floor(shift);
  const double part = shift - whole;
  // a raised cosine holds the sinc to its reach
  VectorXd taps(2 * kSincReach);
  for (Index i = 0; i < taps.size(); ++i) {
    const double at = static_cast<double>(i - kSincReach + 1) - part;
    const double angle = std::numbers::pi * at;
    const double window = 0.5 + 0.5 * std::cos(angle / static_cast<double>(kSincReach + 1));
    taps[i] = (at == 0 ? 1 : std::sin(angle) / angle) * window;
  }
  taps /= taps.sum();
  const Index last = x.size() - 1;
  VectorXd result(x.size());
  for (Index k = 0; k < x.size(); ++k) {
    const Index first = k + static_cast<Index>(whole) - kSincReach + 1;
    if (first >= 0 && first + taps.size() - 1 <= last) {
      result[k] = taps.dot(x.segment(first, taps.size()));
      continue;
    }
    double sum = 0;
    for (Index i = 0; i < taps.size(); ++i)
      sum += taps[i] * x[std::clamp(first + i, Index{0}, last)];
    result[k] = sum;
  }
  return result;
}

namespace {

/// Halfway between samples i and i + 1, of four or two of them.
double halfway(const VectorXd& x, Index i) {
  if (i < 1 || i + 2 >= x.size()) return 0.5 * (x[i] + x[i + 1]);
  return (9 * (x[i] + x[i + 1]) - x[i - 1] - x[i + 2]) / 16;  // Lagrange's cubic
}

}  // namespace

MatrixXd of_every_other(const MatrixXd& x, int parity) {
  MatrixXd result = x;
  const Index kept = (x.rows() - parity + 1) / 2;
  for (Index j = 0; j < x.cols(); ++j) {
    VectorXd own(kept);
    for (Index i = 0; i < kept; ++i) own[i] = x(2 * i + parity, j);
    const VectorXd between = shifted(own, 0.5);
    for (Index i = 0; i + 1 < kept; ++i) {
      const bool near_end = i < kSincReach || i + kSincReach >= kept;
      result(2 * i + parity + 1, j) = near_end ? halfway(own, i) : between[i];
    }
  }
  return result;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/recordings/spline.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

void check_sizes(const char* function, const Eigen::VectorXd& time,
                 const Eigen::Ref<const Eigen::MatrixXd>& values) {
  if (time.size() < 2 || values.rows() != time.size()) {
    throw std::invalid_argument(
        fmt::format("{}(): {} times and {} rows of values, expected as many of both, at least 2",
                    function, time.size(), values.rows()));
  }
}

/// The piece that holds `at`: time(piece) <= at < time(piece + 1), or the nearest one.
Index find_piece(const Eigen::VectorXd& time, double at, Index hint) {
  const Index last = time.size() - 2;
  Index piece = std::clamp<Index>(hint, 0, last);
  if (at < time(piece) || (piece < last && at >= time(piece + 1))) {
    const double* begin = time.data();
    piece = std::upper_bound(begin, begin + time.size(), at) - begin - 1;
  }
  return std::clamp<Index>(piece, 0, last);
}

/// Second derivatives at the samples: continuous first derivatives inside, and the third
/// derivative continuous across the second and the last but one sample.
Eigen::MatrixXd second_derivatives(const Eigen::VectorXd& time,
                                   const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const Index n = time.size();
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(n, values.cols());
  if (n == 2) return second;
  const Eigen::VectorXd h = time.tail(n - 1) - time.head(n - 1);
  const auto slope = [&](Index i) -> Eigen::RowVectorXd {
    return (values.row(i + 1) - values.row(i)) / h(i);
  };
  if (n == 3) {
    second.rowwise() = 2 * (slope(1) - slope(0)) / (h(0) + h(1));
    return second;
  }
  // Rows 1 .. n-2 of the tridiagonal system; the end conditions give second(0) and second(n-1):
  // second(0) = (1 + a) second(1) - a second(2), a = h(0) / h(1), and likewise at the other end.
  const double a = h(0) / h(1);
  const double b = h(n - 2) / h(n - 3);
  Eigen::VectorXd upper(n);
  Eigen::RowVectorXd previous = slope(0);
  double last_upper = 0;
  for (Index i = 1; i <= n - 2; ++i) {
    double low = h(i - 1), middle = 2 * (h(i - 1) + h(i)), high = h(i);
    if (i == 1) {
      middle += (1 + a) * low;
      high -= a * low;
      low = 0;
    }
    if (i == n - 2) {
      middle += (1 + b) * h(i);
      low -= b * h(i);
      high = 0;
    }
    const Eigen::RowVectorXd next = slope(i);
    const double pivot = middle - low * last_upper;
    second.row(i) = (6 * (next - previous) - low * second.row(i - 1)) / pivot;
    upper(i) = last_upper = high / pivot;
    previous = next;
  }
  for (Index i = n - 3; i >= 1; --i) second.row(i) -= upper(i) * second.row(i + 1);
  second.row(0) = (1 + a) * second.row(1) - a * second.row(2);
  second.row(n - 1) = (1 + b) * second.row(n - 2) - b * second.row(n - 3);
  return second;
}

}  // namespace

Eigen::MatrixXd interpolate_spline(const Eigen::VectorXd& time,
                                   const Eigen::Ref<const Eigen::MatrixXd>& values,
                                   const Eigen::VectorXd& at) {
  check_sizes("interpolate_spline", time, values);
  const Eigen::MatrixXd second = second_derivatives(time, values);
  Eigen::MatrixXd result(at.size(), values.cols());
  Index piece = 0;
  for (Index k = 0; k < at.size(); ++k) {
    piece = find_piece(time, at(k), piece);
    const double h = time(piece + 1) - time(piece);
    const double right = (at(k) - time(piece)) / h;
    const double left = 1 - right;
    const double left_weight = (left * left * left - left) * h * h / 6;
    const double right_weight = (right * right * right - right) * h * h / 6;
    result.row(k) = left * values.row(piece) + right * values.row(piece + 1) +
                    left_weight * second.row(piece) + right_weight * second.row(piece + 1);
  }
  return result;
}

Eigen::MatrixXd differentiate_spline(const Eigen::VectorXd& time,
                                     const Eigen::Ref<const Eigen::MatrixXd>& values) {
  check_sizes("differentiate_spline", time, values);
  const Eigen::MatrixXd second = second_derivatives(time, values);
  Eigen::MatrixXd result(values.rows(), values.cols());
  const Index last = time.size() - 1;
  for (Index k = 0; k <= last; ++k) {
    const Index left = std::min(k, last - 1), right = left + 1;
    const double h = time(right) - time(left);
    // at the left end of a piece, or at the right end of the last one
    const double left_weight = k == last ? h / 6 : -h / 3,
                 right_weight = k == last ? h / 3 : -h / 6;
    result.row(k) = (values.row(right) - values.row(left)) / h + left_weight * second.row(left) +
                    right_weight * second.row(right);
  }
  return result;
}

Eigen::MatrixXd interpolate_linear(const Eigen::VectorXd& time,
                                   const Eigen::Ref<const Eigen::MatrixXd>& values,
                                   const Eigen::VectorXd& at) {
  check_sizes("interpolate_linear", time, values);
  Eigen::MatrixXd result(at.size(), values.cols());
  Index piece = 0;
  for (Index k = 0; k < at.size(); ++k) {
    piece = find_piece(time, at(k), piece);
    const double right = (at(k) - time(piece)) / (time(piece + 1) - time(piece));
    result.row(k) = (1 - right) * values.row(piece) + right * values.row(piece + 1);
  }
  return result;
}

}  // namespace dyngen::runtime

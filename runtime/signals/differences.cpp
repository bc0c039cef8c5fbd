// SPDX-License-Identifier: MIT
#include "runtime/signals/differences.h"

#include <fmt/format.h>

#include <stdexcept>

namespace dyngen::runtime {
namespace {

void check(const char* function, Eigen::Index rows, Eigen::Index needed, double sample_time) {
  if (rows < needed) {
    throw std::invalid_argument(
        fmt::format("{}(): {} samples, at least {} are needed", function, rows, needed));
  }
  if (!(sample_time > 0)) {
    throw std::invalid_argument(
        fmt::format("{}(): sample_time {} s is not positive", function, sample_time));
  }
}

}  // namespace

// The ends are written as differences from the first sample, so that a constant gives zero exactly.

Eigen::MatrixXd first_difference(const Eigen::MatrixXd& columns, double sample_time) {
  const Eigen::Index N = columns.rows();
  check("first_difference", N, 3, sample_time);
  const double scale = 0.5 / sample_time;
  Eigen::MatrixXd result(N, columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const auto x = columns.col(j);
    auto d = result.col(j);
    d.segment(1, N - 2) = scale * (x.tail(N - 2) - x.head(N - 2));
    d[0] = scale * (4 * (x[1] - x[0]) - (x[2] - x[0]));
    d[N - 1] = scale * ((x[N - 3] - x[N - 1]) - 4 * (x[N - 2] - x[N - 1]));
  }
  return result;
}

Eigen::MatrixXd second_difference(const Eigen::MatrixXd& columns, double sample_time) {
  const Eigen::Index N = columns.rows();
  check("second_difference", N, 4, sample_time);
  const double scale = 1 / (sample_time * sample_time);
  Eigen::MatrixXd result(N, columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const auto x = columns.col(j);
    auto d = result.col(j);
    const auto middle = x.segment(1, N - 2);
    d.segment(1, N - 2) = scale * ((x.tail(N - 2) - middle) - (middle - x.head(N - 2)));
    d[0] = scale * (-5 * (x[1] - x[0]) + 4 * (x[2] - x[0]) - (x[3] - x[0]));
    const double last = x[N - 1];
    d[N - 1] = scale * (-5 * (x[N - 2] - last) + 4 * (x[N - 3] - last) - (x[N - 4] - last));
  }
  return result;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/recursive/gain.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

void check_regressors(const char* caller, const Eigen::MatrixXd& W, int joints) {
  if (joints < 1) {
    throw std::invalid_argument(
        fmt::format("{}(): joints = {}, expected 1 or more", caller, joints));
  }
  if (W.size() == 0 || W.rows() % joints != 0) {
    throw std::invalid_argument(fmt::format("{}(): W is {} x {}, expected samples x {} joints rows",
                                            caller, W.rows(), W.cols(), joints));
  }
  if (!W.allFinite()) {
    throw std::invalid_argument(fmt::format("{}(): W has values that are not finite", caller));
  }
}

void check_correlation(const char* caller, const Eigen::MatrixXd& R) {
  if (R.size() == 0 || R.rows() != R.cols()) {
    throw std::invalid_argument(
        fmt::format("{}(): R is {} x {}, expected a square", caller, R.rows(), R.cols()));
  }
  // What a sum of outer products loses to rounding.
  const double asymmetry = (R - R.transpose()).cwiseAbs().maxCoeff();
  if (!R.allFinite() || asymmetry > 1e-9 * R.cwiseAbs().maxCoeff()) {
    throw std::invalid_argument(fmt::format("{}(): R is not finite and symmetric", caller));
  }
  if (R.diagonal().minCoeff() < 0) {
    throw std::invalid_argument(fmt::format("{}(): R has a negative diagonal entry", caller));
  }
}

/// Ascending eigenvalues of diag(scale) R diag(scale).
Eigen::VectorXd scaled_eigenvalues(const Eigen::MatrixXd& R, const Eigen::VectorXd& scale) {
  const Eigen::MatrixXd scaled = scale.asDiagonal() * R * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace

Eigen::MatrixXd regressor_correlation(const Eigen::MatrixXd& W, int joints) {
  check_regressors("regressor_correlation", W, joints);
  const Eigen::Index rows = W.rows() / joints;  // of each joint
  const auto samples = static_cast<double>(rows);
  return W.transpose() * W / samples;
}

Eigen::VectorXd propose_gain(const Eigen::MatrixXd& R, double fraction) {
  check_correlation("propose_gain", R);
  if (!(fraction > 0 && fraction < 2)) {
    throw std::invalid_argument(
        fmt::format("propose_gain(): fraction = {}, expected between 0 and 2", fraction));
  }
  const Eigen::VectorXd inverse =
      R.diagonal().unaryExpr([](double r) { return r > 0 ? 1 / r : 0; });
  const double largest = scaled_eigenvalues(R, inverse.cwiseSqrt()).maxCoeff();
  if (!(largest > 0)) throw std::invalid_argument("propose_gain(): R is zero: nothing is excited");
  return fraction / largest * inverse;
}

double peak_gain(const Eigen::VectorXd& gain, const Eigen::MatrixXd& W, int joints) {
  check_regressors("peak_gain", W, joints);
  if (gain.size() != W.cols() || !gain.allFinite() || gain.minCoeff() < 0) {
    throw std::invalid_argument(fmt::format(
        "peak_gain(): {} gains for {} columns of W, all must be >= 0", gain.size(), W.cols()));
  }
  double peak = 0;
  for (Eigen::Index row = 0; row < W.rows(); row += joints) {
    const Eigen::MatrixXd B = W.middleRows(row, joints) * gain.cwiseSqrt().asDiagonal();
    const Eigen::MatrixXd G = B * B.transpose();
    peak = std::max(peak, scaled_eigenvalues(G, Eigen::VectorXd::Ones(joints)).maxCoeff());
  }
  return peak;
}

double slowest_time_constant(const Eigen::VectorXd& gain, const Eigen::MatrixXd& R,
                             double sample_time) {
  check_correlation("slowest_time_constant", R);
  if (gain.size() != R.rows() || !gain.allFinite() || !(gain.minCoeff() > 0)) {
    throw std::invalid_argument(
        fmt::format("slowest_time_constant(): {} gains for {} parameters, all must be > 0",
                    gain.size(), R.rows()));
  }
  if (!(sample_time > 0)) {
    throw std::invalid_argument(
        fmt::format("slowest_time_constant(): sample_time = {} s, expected > 0", sample_time));
  }
  const double smallest = scaled_eigenvalues(R, gain.cwiseSqrt()).minCoeff();
  return smallest > 0 ? sample_time / smallest : std::numeric_limits<double>::infinity();
}

}  // namespace dyngen::runtime

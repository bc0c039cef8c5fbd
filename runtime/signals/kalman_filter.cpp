// SPDX-License-Identifier: MIT
#include "runtime/signals/kalman_filter.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "runtime/signals/kalman_steps.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

void check(const char* function, const Eigen::VectorXd& y, double sample_time) {
  if (y.size() < 3 || !y.allFinite() || !(sample_time > 0)) {
    throw std::invalid_argument(
        fmt::format("{}(): {} samples of {} s, needed: at least three, finite, of positive length",
                    function, y.size(), sample_time));
  }
}

double ratio_of(double sample_time, const KalmanOptions& options) {
  return options.jerk_intensity * std::pow(sample_time, 5) / options.measurement_variance;
}

/// A filtered run, in samples, positions from the first one: no digits are lost on where a joint
/// is.
struct Pass {
  KalmanStates result;
  std::vector<KalmanUpdate> updates;
  KalmanStart start;
  double ratio = 0;
};

void set_row(KalmanStates& result, Index k, const Vector3d& state, const Matrix3d& covariance) {
  result.states.row(k) = state.transpose();
  result.variances.row(k) = covariance.diagonal().transpose();
}

/// Samples 1 and 0, seen from sample 2.
void set_first_two(KalmanStates& result, const Eigen::VectorXd& y, double ratio,
                   const Matrix3d& covariance) {
  KalmanRetreat known{result.states.row(2).transpose(), covariance};
  for (int k = 1; k >= 0; --k) {
    known = kalman_retreat(ratio, k, 0, y[1] - y[0], known);
    set_row(result, k, known.state, known.covariance);
  }
}

Pass forward(const Eigen::VectorXd& y, double sample_time, const KalmanOptions& options) {
  const Index N = y.size();
  Pass pass;
  pass.ratio = ratio_of(sample_time, options);
  pass.updates = kalman_updates(pass.ratio, N);
  pass.start = kalman_start(pass.ratio);
  KalmanStates& result = pass.result;
  result.states.resize(N, 3);
  result.variances.resize(N, 3);
  Vector3d x = pass.start.from_samples * (y.head<3>().array() - y[0]).matrix();
  set_row(result, 2, x, pass.start.covariance);
  double cost = 0;
  for (Index k = 3; k < N; ++k) {
    const KalmanUpdate& step = update_at(pass.updates, k);
    x = kalman_advance(x);
    const double innovation = y[k] - y[0] - x[0];
    const double variance = options.measurement_variance * (step.predicted(0, 0) + 1);
    cost += std::log(2 * std::numbers::pi * variance) + innovation * innovation / variance;
    x += innovation * step.gain;
    set_row(result, k, x, step.filtered);
  }
  result.log_likelihood = -0.5 * cost;
  return pass;
}

/// From samples and standard deviations to seconds and radians.
KalmanStates in_units(KalmanStates result, double origin, double sample_time, double variance) {
  double scale = 1;
  for (int column = 0; column < 3; ++column, scale /= sample_time) {
    result.states.col(column) *= scale;
    result.variances.col(column) *= scale * scale * variance;
  }
  result.states.col(0).array() += origin;
  return result;
}

}  // namespace

void KalmanOptions::validate() const {
  for (const double value : {jerk_intensity, measurement_variance}) {
    if (!(value > 0) || !std::isfinite(value)) {
      throw std::invalid_argument(fmt::format(
          "KalmanOptions: jerk_intensity {} and measurement_variance {} must be positive",
          jerk_intensity, measurement_variance));
    }
  }
}

double encoder_variance(double step) { return step * step / 12; }

KalmanStates kalman_filter(const Eigen::VectorXd& y, double sample_time,
                           const KalmanOptions& options) {
  check("kalman_filter", y, sample_time);
  options.validate();
  Pass pass = forward(y, sample_time, options);
  set_first_two(pass.result, y, pass.ratio, pass.start.covariance);
  return in_units(std::move(pass.result), y[0], sample_time, options.measurement_variance);
}

KalmanStates kalman_smoother(const Eigen::VectorXd& y, double sample_time,
                             const KalmanOptions& options) {
  check("kalman_smoother", y, sample_time);
  options.validate();
  const Index N = y.size();
  Pass pass = forward(y, sample_time, options);
  KalmanStates& result = pass.result;
  const Matrix3d A = kalman_transition(), Q = kalman_process_noise(pass.ratio);
  const Index steady =
      2 + static_cast<Index>(pass.updates.size());  // the sample of the last update
  const auto filtered = [&](Index k) -> const Matrix3d& {
    return k > 2 ? update_at(pass.updates, k).filtered : pass.start.covariance;
  };
  Vector3d x = result.states.row(N - 1).transpose();
  Matrix3d P = filtered(N - 1);
  Matrix3d G = Matrix3d::Zero(), own = Matrix3d::Zero();
  for (Index k = N - 2; k >= 2; --k) {
    if (k == N - 2 || k < steady) {
      const Matrix3d& predicted = update_at(pass.updates, k + 1).predicted;
      G = predicted.ldlt().solve(A * filtered(k)).transpose();
      const Matrix3d left = Matrix3d::Identity() - G * A;
      own = left * filtered(k) * left.transpose() + G * Q * G.transpose();
    }
    const Vector3d here = result.states.row(k).transpose();
    x = here + G * (x - kalman_advance(here));
    P = G * P * G.transpose() + own;  // Joseph's form of P[k|k] + G (P[k+1|N] - P[k+1|k]) G^T
    set_row(result, k, x, P);
  }
  set_first_two(result, y, pass.ratio, P);
  return in_units(std::move(result), y[0], sample_time, options.measurement_variance);
}

Eigen::Vector3d steady_gain(double sample_time, const KalmanOptions& options) {
  options.validate();
  if (!(sample_time > 0)) throw std::invalid_argument("steady_gain(): sample_time is not positive");
  constexpr Index kEnough = 1'000'000;
  const Vector3d gain = kalman_updates(ratio_of(sample_time, options), kEnough).back().gain;
  return {gain[0], gain[1] / sample_time, gain[2] / (sample_time * sample_time)};
}

}  // namespace dyngen::runtime

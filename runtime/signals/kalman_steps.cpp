// SPDX-License-Identifier: MIT
#include "runtime/signals/kalman_steps.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace dyngen::runtime {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSteady = 1e-12;  // relative change of a gain that has settled

Matrix3d backward_transition() {
  Matrix3d A;
  A << 1, -1, 0.5, 0, 1, -1, 0, 0, 1;
  return A;
}

KalmanUpdate update(const Matrix3d& filtered, const Matrix3d& Q) {
  const Matrix3d A = kalman_transition();
  KalmanUpdate result;
  const Matrix3d P = A * filtered * A.transpose() + Q;
  result.predicted = 0.5 * (P + P.transpose());
  result.gain = result.predicted.col(0) / (result.predicted(0, 0) + 1);
  Matrix3d left = Matrix3d::Identity();  // I - K C
  left.col(0) -= result.gain;
  result.filtered =
      left * result.predicted * left.transpose() + result.gain * result.gain.transpose();
  return result;
}

}  // namespace

Matrix3d kalman_transition() {
  Matrix3d A;
  A << 1, 1, 0.5, 0, 1, 1, 0, 0, 1;
  return A;
}

Matrix3d kalman_process_noise(double ratio) {
  Matrix3d Q;
  Q << 1.0 / 20, 1.0 / 8, 1.0 / 6, 1.0 / 8, 1.0 / 3, 1.0 / 2, 1.0 / 6, 1.0 / 2, 1;
  return ratio * Q;
}

KalmanStart kalman_start(double ratio) {
  const Matrix3d back = backward_transition();
  const Matrix3d Q = kalman_process_noise(ratio);
  const Eigen::RowVector3d one = back.row(0), two = (back * back).row(0);
  Matrix3d H, S = Matrix3d::Identity();
  H << two, one, 1, 0, 0;
  // y1 = C A^-1 (x2 - w1) + e1,  y0 = C A^-1 (A^-1 (x2 - w1) - w0) + e0
  S(0, 0) += (two * Q * two.transpose() + one * Q * one.transpose()).value();
  S(0, 1) += (two * Q * one.transpose()).value();
  S(1, 0) = S(0, 1);
  S(1, 1) += (one * Q * one.transpose()).value();
  KalmanStart start;
  start.from_samples = H.inverse();
  start.covariance = start.from_samples * S * start.from_samples.transpose();
  return start;
}

std::vector<KalmanUpdate> kalman_updates(double ratio, Eigen::Index samples) {
  std::vector<KalmanUpdate> result;
  const Matrix3d Q = kalman_process_noise(ratio);
  Matrix3d filtered = kalman_start(ratio).covariance;
  Vector3d before = Vector3d::Zero();
  for (Eigen::Index k = 3; k < samples; ++k) {
    result.push_back(update(filtered, Q));
    filtered = result.back().filtered;
    const Vector3d& gain = result.back().gain;
    if (((gain - before).array().abs() <= kSteady * gain.array().abs()).all()) break;
    before = gain;
  }
  return result;
}

KalmanRetreat kalman_retreat(double ratio, int sample, double y0, double y1,
                             const KalmanRetreat& next) {
  const Matrix3d A = kalman_transition(), back = backward_transition();
  const Matrix3d Q = kalman_process_noise(ratio);
  // What y[0..sample] say of x[sample], as information: y1 = C x1 + e1, y0 = C A^-1 (x1 - w0) + e0.
  Eigen::Matrix<double, 2, 3> H = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Vector2d y(y1, y0), weight(1, 1);
  H(0, 0) = 1;
  if (sample == 1) {
    H.row(1) = back.row(0);
    weight[1] = 1 / (1 + (back.row(0) * Q * back.row(0).transpose()).value());
  } else {
    y = {y0, 0};
  }
  const Matrix3d information = H.transpose() * weight.asDiagonal() * H;
  // x[k+1] = A x[k] + w[k] says A^T Q^-1 A more.
  const Matrix3d flow = A.transpose() * Q.ldlt().solve(A);
  const Matrix3d own = (information + flow).ldlt().solve(Matrix3d::Identity());
  const Vector3d carried = back * next.state;
  const Matrix3d from_next = back - own * information * back;
  KalmanRetreat result;
  result.state = carried + own * (H.transpose() * weight.asDiagonal() * (y - H * carried));
  result.covariance = own + from_next * next.covariance * from_next.transpose();
  return result;
}

}  // namespace dyngen::runtime

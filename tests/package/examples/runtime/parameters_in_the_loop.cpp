// SPDX-License-Identifier: MIT
// Estimators that take one sample of a running arm at a time.
#include <cmath>

#include "../pendulum.h"
#include "runtime/recursive/convergent_mode_lms.h"
#include "runtime/recursive/gain.h"
#include "runtime/recursive/lms.h"
#include "runtime/recursive/minimum_variance.h"
#include "runtime/recursive/rls.h"

using namespace dyngen::runtime;

int main() {
  const Eigen::Vector3d truth(pendulum::kInertia, pendulum::kMoment, pendulum::kViscous);
  constexpr int kSamples = 5000;
  Eigen::MatrixXd W(kSamples, 3);
  Eigen::VectorXd tau(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    const pendulum::State state = pendulum::motion_at(0.01 * k);
    Eigen::RowVector3d Y;
    pendulum::base_regressor(&state.q, &state.dq, &state.ddq, Y.data());
    W.row(k) = Y;
    tau[k] = Y.dot(truth);
  }

  MinimumVarianceOptions known;
  known.prior_covariance = Eigen::MatrixXd::Identity(3, 3);
  known.measurement_covariance = Eigen::MatrixXd::Constant(1, 1, 1e-4);
  MinimumVariance minimum_variance(known);
  Rls rls(1, 3);
  LmsOptions small;
  small.gain = propose_gain(regressor_correlation(W, 1), 0.1);
  if (peak_gain(small.gain, W, 1) >= 2) return 2;
  Lms lms(1, small);
  ConvergentModeOptions mode;
  mode.gain = small.gain;
  ConvergentModeLms mode_lms(1, mode);
  for (int k = 0; k < kSamples; ++k) {
    const Eigen::RowVector3d Y = W.row(k);
    if (!minimum_variance.update(Y.data(), &tau[k]) || !rls.update(Y.data(), &tau[k]) ||
        !lms.update(Y.data(), &tau[k]) || !mode_lms.update(Y.data(), &tau[k])) {
      return 3;
    }
  }
  const auto off = [&](const Eigen::VectorXd& beta) { return (beta - truth).norm(); };
  return off(minimum_variance.beta()) < 0.01 && off(rls.beta()) < 1e-6 && off(lms.beta()) < 0.3 &&
                 off(mode_lms.beta()) < 1
             ? 0
             : 1;
}

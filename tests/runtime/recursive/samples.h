// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <random>

#include "runtime/recursive/sample.h"

namespace dyngen::test {

/// A million updates are 10 rounds of so many passes over 100 samples; with sanitizers, which make
/// them some hundred times slower, one per cent of it.
#ifdef DYNGEN_SHORT_LOOPS
constexpr int kPassesOfARound = 10;
#else
constexpr int kPassesOfARound = 1000;
#endif

/// Regressors and torques of N samples as an estimator gets them: one after the other.
struct Samples {
  int joints = 0;
  runtime::RowMajorMatrix W;  ///< (N*n x nb), sample-major: rows k*n .. k*n + n - 1 are Y_k
  Eigen::VectorXd tau;        ///< (N*n)
  Eigen::VectorXd beta;       ///< (nb) what tau was made with

  [[nodiscard]] Eigen::Index size() const { return W.rows() / joints; }
  [[nodiscard]] const double* Y(Eigen::Index k) const { return W.row(k * joints).data(); }
  [[nodiscard]] const double* torque(Eigen::Index k) const { return tau.data() + k * joints; }
};

Eigen::VectorXd normal_vector(std::mt19937_64& random, Eigen::Index size);

/// Normal regressors and parameters, noise of standard deviation `noise`. Prints the seed.
Samples random_samples(unsigned seed, int joints, int parameters, int samples, double noise);

/// The 100 stored samples of the three-joint PUMA (15 base parameters, Table 7.1 of the thesis),
/// torques from the table and noise of standard deviation `noise` N m. Prints the seed.
Samples puma3_samples(unsigned seed, double noise);

/// Gives an estimator all samples, in order, `passes` times. Returns how many it has used.
template <typename Estimator>
Eigen::Index feed(Estimator& estimator, const Samples& samples, int passes = 1) {
  Eigen::Index used = 0;
  for (int pass = 0; pass < passes; ++pass) {
    for (Eigen::Index k = 0; k < samples.size(); ++k) {
      used += estimator.update(samples.Y(k), samples.torque(k)) ? 1 : 0;
    }
  }
  return used;
}

/// |beta - true| / |true|
double relative_distance(const Eigen::VectorXd& beta, const Eigen::VectorXd& truth);

}  // namespace dyngen::test

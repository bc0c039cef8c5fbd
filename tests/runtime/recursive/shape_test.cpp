// SPDX-License-Identifier: MIT
// What all estimators have in common, without a base class.
#include <gtest/gtest.h>

#include <concepts>
#include <limits>

#include "runtime/recursive/convergent_mode_lms.h"
#include "runtime/recursive/lms.h"
#include "runtime/recursive/minimum_variance.h"
#include "runtime/recursive/rls.h"
#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

template <typename E>
concept RecursiveEstimator = requires(E& e, const E& fixed, const double* values) {
  { e.update(values, values) }
  noexcept->std::same_as<bool>;
  { fixed.beta() }
  noexcept->std::same_as<const Eigen::VectorXd&>;
  { fixed.samples() }
  noexcept->std::same_as<std::int64_t>;
};
static_assert(RecursiveEstimator<runtime::Lms>);
static_assert(RecursiveEstimator<runtime::ConvergentModeLms>);
static_assert(RecursiveEstimator<runtime::Rls>);
static_assert(RecursiveEstimator<runtime::MinimumVariance>);

constexpr int kJoints = 2, kParameters = 3;

template <typename E>
E make() {
  if constexpr (std::same_as<E, runtime::Lms>) {
    return E(kJoints, {.gain = Eigen::VectorXd::Constant(kParameters, 0.1)});
  } else if constexpr (std::same_as<E, runtime::ConvergentModeLms>) {
    return E(kJoints, {.gain = Eigen::VectorXd::Constant(kParameters, 0.1)});
  } else if constexpr (std::same_as<E, runtime::Rls>) {
    return E(kJoints, kParameters);
  } else {
    runtime::MinimumVarianceOptions options;
    options.prior_covariance = Eigen::MatrixXd::Identity(kParameters, kParameters);
    options.measurement_covariance = Eigen::MatrixXd::Identity(kJoints, kJoints);
    return E(options);
  }
}

template <typename E>
class Estimator : public testing::Test {};
using Estimators = testing::Types<runtime::Lms, runtime::ConvergentModeLms, runtime::Rls,
                                  runtime::MinimumVariance>;
TYPED_TEST_SUITE(Estimator, Estimators);

TYPED_TEST(Estimator, RefusesASampleThatIsNotFiniteAndGoesOnAsIfItHadNotBeen) {
  const Samples samples = random_samples(5, kJoints, kParameters, 20, 0.1);
  TypeParam disturbed = make<TypeParam>(), calm = make<TypeParam>();
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  for (Eigen::Index k = 0; k < samples.size(); ++k) {
    for (const double value : bad) {
      runtime::RowMajorMatrix Y = samples.W.middleRows(k * kJoints, kJoints);
      Eigen::VectorXd tau = samples.tau.segment(k * kJoints, kJoints);
      Y(1, k % kParameters) = value;
      EXPECT_FALSE(disturbed.update(Y.data(), tau.data()));
      tau[k % kJoints] = value;
      EXPECT_FALSE(disturbed.update(samples.Y(k), tau.data()));
    }
    EXPECT_FALSE(disturbed.update(nullptr, samples.torque(k)));
    EXPECT_FALSE(disturbed.update(samples.Y(k), nullptr));
    EXPECT_EQ(disturbed.beta(), calm.beta());
    EXPECT_TRUE(disturbed.update(samples.Y(k), samples.torque(k)));
    EXPECT_TRUE(calm.update(samples.Y(k), samples.torque(k)));
    EXPECT_EQ(disturbed.beta(), calm.beta());
  }
  EXPECT_EQ(disturbed.samples(), samples.size());
}

TYPED_TEST(Estimator, RefusesASampleThatOverflows) {
  const Samples samples = random_samples(6, kJoints, kParameters, 20, 0.1);
  TypeParam estimator = make<TypeParam>();
  feed(estimator, samples);
  const Eigen::VectorXd before = estimator.beta();
  runtime::RowMajorMatrix Y = 1e300 * samples.W.topRows(kJoints);
  const Eigen::VectorXd tau = Eigen::VectorXd::Constant(kJoints, -1e300);
  EXPECT_FALSE(estimator.update(Y.data(), tau.data()));
  EXPECT_EQ(estimator.beta(), before);
  EXPECT_TRUE(estimator.update(samples.Y(0), samples.torque(0)));
  EXPECT_TRUE(estimator.beta().allFinite());
}

}  // namespace
}  // namespace dyngen::test

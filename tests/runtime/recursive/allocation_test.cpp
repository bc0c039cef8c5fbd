// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>

#include "runtime/recursive/convergent_mode_lms.h"
#include "runtime/recursive/gain.h"
#include "runtime/recursive/lms.h"
#include "runtime/recursive/minimum_variance.h"
#include "runtime/recursive/rls.h"
#include "tests/runtime/recursive/allocation_count.h"
#include "tests/runtime/recursive/samples.h"

namespace dyngen::test {
namespace {

TEST(AllocationCount, SeesAVectorAndAnObject) {
  const long before = allocation_count();
  const Eigen::VectorXd vector = Eigen::VectorXd::Zero(100);
  EXPECT_GT(allocation_count(), before);
  const long between = allocation_count();
  const auto object = std::make_unique<Eigen::Vector2d>(0, 0);
  EXPECT_GT(allocation_count(), between);
  EXPECT_EQ(vector.sum(), object->sum());
}

struct Size {
  int joints, parameters;
};

class Allocation : public testing::TestWithParam<Size> {
 protected:
  Samples samples_ = random_samples(11, GetParam().joints, GetParam().parameters, 100, 0.1);
  int n_ = GetParam().joints;
  Eigen::Index nb_ = GetParam().parameters;
  Eigen::VectorXd gain_ =
      runtime::propose_gain(runtime::regressor_correlation(samples_.W, n_), 0.01);

  /// 1000 updates, all used.
  template <typename Estimator>
  void expect_none(Estimator& estimator) {
    const long before = allocation_count();
    const Eigen::Index used = feed(estimator, samples_, 10);
    const long after = allocation_count();
    EXPECT_EQ(after - before, 0);
    EXPECT_EQ(used, 1000);
  }
};

TEST_P(Allocation, LmsHasNone) {
  runtime::Lms lms(n_, {.gain = gain_});
  expect_none(lms);
  runtime::LmsOptions normalised{.gain = gain_};
  normalised.normalised = true;
  runtime::Lms nlms(n_, normalised);
  expect_none(nlms);
}

TEST_P(Allocation, ConvergentModeLmsHasNone) {
  runtime::ConvergentModeOptions options{.gain = gain_};
  runtime::ConvergentModeLms one(n_, options);
  expect_none(one);
  options.modes = runtime::KeptModes::kAllStable;
  runtime::ConvergentModeLms all(n_, options);
  expect_none(all);
}

TEST_P(Allocation, RlsHasNone) {
  runtime::Rls plain(n_, static_cast<int>(nb_));
  expect_none(plain);
  runtime::RlsOptions options;
  options.forgetting = 0.999;
  options.prior_covariance = Eigen::MatrixXd::Identity(nb_, nb_);
  options.max_stddev = Eigen::VectorXd::Ones(nb_);
  runtime::Rls forgetful(n_, static_cast<int>(nb_), options);
  expect_none(forgetful);
}

TEST_P(Allocation, MinimumVarianceHasNone) {
  runtime::MinimumVarianceOptions options;
  options.prior_covariance = Eigen::MatrixXd::Identity(nb_, nb_);
  options.measurement_covariance = Eigen::MatrixXd::Identity(n_, n_);
  runtime::MinimumVariance constant(options);
  expect_none(constant);
  options.walk_covariance = 1e-6 * Eigen::MatrixXd::Identity(nb_, nb_);
  runtime::MinimumVariance walking(options);
  expect_none(walking);
}

INSTANTIATE_TEST_SUITE_P(Arms, Allocation, testing::Values(Size{6, 52}, Size{7, 62}),
                         [](const testing::TestParamInfo<Size>& arm) {
                           return std::to_string(arm.param.joints) + "Joints" +
                                  std::to_string(arm.param.parameters) + "Parameters";
                         });

}  // namespace
}  // namespace dyngen::test

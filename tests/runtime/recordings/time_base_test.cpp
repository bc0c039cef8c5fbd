// SPDX-License-Identifier: MIT
#include "runtime/recordings/time_base.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "runtime/recordings/spline.h"

namespace dyngen::test {
namespace {

using runtime::Recording;
using runtime::TimeBase;

Recording with_time(const Eigen::VectorXd& time) {
  Recording recording;
  recording.time = time;
  recording.q = time;
  recording.tau = time;
  recording.run_starts = {0};
  return recording;
}

Eigen::VectorXd grid(Eigen::Index samples, double step) {
  return Eigen::VectorXd::LinSpaced(samples, 0, static_cast<double>(samples - 1)) * step;
}

Eigen::VectorXd printed(const Eigen::VectorXd& time, double unit) {
  return (time / unit).array().round() * unit;
}

TEST(TimeBase, AGridIsUniform) {
  const TimeBase base = runtime::examine_time_base(with_time(grid(10000, 0.0002)));
  EXPECT_TRUE(base.uniform);
  EXPECT_EQ(base.sample_time, 0.0002);
  EXPECT_LT(base.jitter, 1e-9);
  EXPECT_EQ(base.message, "uniformly sampled every 0.0002 s");
}

TEST(TimeBase, RoundingOfPrintedTimesIsNoJitter) {
  const TimeBase base =
      runtime::examine_time_base(with_time(printed(grid(9001, 1.0 / 3000), 1e-4)));
  EXPECT_TRUE(base.uniform) << base.message;
  EXPECT_NEAR(base.sample_time, 1.0 / 3000, 1e-4 / 9000);
}

TEST(TimeBase, JitterIsNotUniform) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> off(-0.05, 0.05);
  Eigen::VectorXd time = grid(1000, 0.01);
  for (double& t : time) t += 0.01 * off(generator);
  const TimeBase base = runtime::examine_time_base(with_time(time));
  EXPECT_FALSE(base.uniform);
  EXPECT_NEAR(base.sample_time, 0.01, 1e-4);
  EXPECT_NEAR(base.jitter, 0.1 / std::sqrt(6.0), 0.005);  // difference of two uniform numbers
}

TEST(TimeBase, AMissingSampleIsNotUniform) {
  Eigen::VectorXd time = grid(1000, 0.01);
  time.tail(500).array() += 0.01;
  const TimeBase base = runtime::examine_time_base(with_time(time));
  EXPECT_FALSE(base.uniform);
  EXPECT_NEAR(base.worst_step, 0.02, 1e-9);
}

TEST(TimeBase, RunsMayStartAnywhereButShareTheirStep) {
  Recording recording = with_time(grid(1000, 0.01));
  recording.time.tail(400).array() += 77.1234;
  recording.run_starts = {0, 600};
  EXPECT_TRUE(runtime::examine_time_base(recording).uniform);
  recording.time.tail(400) = grid(400, 0.02);
  EXPECT_FALSE(runtime::examine_time_base(recording).uniform);
}

TEST(Resample, ReproducesACubicAndLines) {
  Recording recording;
  recording.time.resize(200);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> off(-0.3, 0.3);
  for (Eigen::Index k = 0; k < 200; ++k) {
    recording.time(k) = 5 + 0.01 * (static_cast<double>(k) + (k % 199 == 0 ? 0 : off(generator)));
  }
  const auto cubic = [](double t) { return 1 + t * (2 + t * (-3 + 4 * t)); };
  const auto line = [](double t) { return 3 - 2 * t; };
  recording.q = recording.time.unaryExpr(cubic);
  recording.dq = 2 * recording.q;
  recording.tau = recording.time.unaryExpr(line);
  recording.temperature = recording.tau;
  recording.run_starts = {0, 100};

  const Recording result = runtime::resample(recording, 0.005);
  ASSERT_EQ(result.run_starts.size(), 2U);
  for (std::size_t run = 0; run < 2; ++run) {
    const Eigen::Index first = result.run_starts[run];
    const double start = recording.time(recording.run_starts[run]);
    for (Eigen::Index k = first; k < runtime::run_end(result, run); ++k) {
      ASSERT_EQ(result.time(k), start + static_cast<double>(k - first) * 0.005);
      const double value = cubic(result.time(k));
      // rounding of values of 500 and of divided differences over 0.004 s
      ASSERT_NEAR(result.q(k, 0), value, 1e-10);
      ASSERT_NEAR(result.dq(k, 0), 2 * value, 2e-10);
      ASSERT_NEAR(result.tau(k, 0), line(result.time(k)), 1e-12);
    }
    EXPECT_LE(result.time(runtime::run_end(result, run) - 1),
              recording.time(runtime::run_end(recording, run) - 1) + 1e-8);
  }
  EXPECT_EQ(result.temperature, result.tau);
  EXPECT_EQ(result.ddq.size(), 0);
}

TEST(Resample, WantsAPositiveStep) {
  EXPECT_THROW(runtime::resample(with_time(grid(20, 0.1)), 0), std::invalid_argument);
  EXPECT_THROW(runtime::resample(with_time(grid(20, 0.1)), std::nan("")), std::invalid_argument);
}

TEST(Spline, OfFewPointsIsTheirPolynomial) {
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(9, -0.5, 3);
  for (Eigen::Index n = 2; n <= 5; ++n) {
    Eigen::VectorXd time(n);
    for (Eigen::Index k = 0; k < n; ++k) time(k) = 0.7 * static_cast<double>(k + k * k);
    const auto degree = static_cast<int>(std::min<Eigen::Index>(n - 1, 3));
    const auto polynomial = [&](double t) { return 2 + std::pow(t, degree); };
    const Eigen::MatrixXd values = time.unaryExpr(polynomial);
    const Eigen::MatrixXd found = runtime::interpolate_spline(time, values, at);
    EXPECT_LT((found.col(0) - at.unaryExpr(polynomial)).cwiseAbs().maxCoeff(), 1e-10) << n;
  }
}

TEST(Spline, ErrorOfASineFallsWithTheFourthPower) {
  const auto error = [](Eigen::Index n) {
    const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(n, 0, 6);
    const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(1001, 0, 6);
    const Eigen::MatrixXd values = time.array().sin();
    return (runtime::interpolate_spline(time, values, at) - at.array().sin().matrix())
        .cwiseAbs()
        .maxCoeff();
  };
  EXPECT_GT(error(51) / error(101), 12);
}

TEST(PrintUnit, IsThatOfTheLastDecimal) {
  EXPECT_EQ(runtime::print_unit(printed(grid(1000, 0.0123), 1e-4)), 1e-4);
  EXPECT_EQ(runtime::print_unit(grid(1000, 3)), 1);
  EXPECT_EQ(runtime::print_unit(grid(1000, M_PI)), 0);
}

}  // namespace
}  // namespace dyngen::test

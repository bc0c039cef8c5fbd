// SPDX-License-Identifier: MIT
#include "runtime/excitation/excitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/excitation/constrained_minimum.h"
#include "tests/runtime/excitation/small_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(ConstrainedMinimum, OfASquareBesideALine) {
  const auto at = [](const VectorXd& x) {
    SmoothPoint point;
    point.value = (x - Eigen::Vector2d(2, 1)).squaredNorm();
    point.gradient = 2 * (x - Eigen::Vector2d(2, 1));
    point.constraints = VectorXd::Constant(1, x.sum() - 1);
    point.jacobian = MatrixXd::Ones(1, 2);
    return point;
  };
  const Minimum minimum =
      constrained_minimum(at, Eigen::Vector2d(-3, 5), {.tolerance = 1e-12, .violation = 1e-9});
  EXPECT_NEAR(minimum.x[0], 1, 1e-6);
  EXPECT_NEAR(minimum.x[1], 0, 1e-6);
  EXPECT_LE(minimum.violation, 1e-9);
}

TEST(ConstrainedMinimum, KeepsThePointThatViolatesLeast) {
  const auto at = [](const VectorXd& x) {
    SmoothPoint point{x[0], VectorXd::Ones(1), VectorXd::Constant(1, 1 + x[0] * x[0]),
                      MatrixXd::Constant(1, 1, 2 * x[0])};
    return point;
  };
  const Minimum minimum = constrained_minimum(at, VectorXd::Constant(1, 3), {});
  EXPECT_LE(minimum.violation, 10);
  EXPECT_GE(minimum.violation, 1);
}

MotionLimits limits_with_torque() {
  MotionLimits limits = test::small_arm_limits();
  limits.torque = Eigen::Vector2d(9, 5);
  limits.beta = Eigen::Vector4d(1, 3, 0.5, 0.4);
  // an arm of 0.5 m and one of 0.4 m in a vertical plane
  KeepOutBox box{.lower = {0.6, -1, -1}, .upper = {1, 1, 0.2}};
  box.tool = [](const VectorXd& q) {
    const double a = q[0], b = q[0] + q[1];
    ToolPoint point;
    point.position = {0.5 * std::cos(a) + 0.4 * std::cos(b), 0,
                      0.5 * std::sin(a) + 0.4 * std::sin(b)};
    point.jacobian.resize(3, 2);
    point.jacobian.col(1) << -0.4 * std::sin(b), 0, 0.4 * std::cos(b);
    point.jacobian.col(0) = point.jacobian.col(1);
    point.jacobian.col(0) += Eigen::Vector3d(-0.5 * std::sin(a), 0, 0.5 * std::cos(a));
    return point;
  };
  limits.box = box;
  return limits;
}

TEST(MotionConstraints, AreNeverBelowTheLargestShare) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = limits_with_torque();
  const TrajectoryFamily family;
  const TrajectoryBasis basis = basis_at(family, period_times(family, 200));
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::srand(seed);
    const JointMotion motion = basis.motion(MatrixXd::Random(family.size(), 2));
    const LimitShares shares = limit_shares(model, limits, motion);
    for (const double sharpness : {50.0, 1000.0}) {
      const VectorXd c = constraints_of(model, limits, motion, sharpness).values;
      ASSERT_EQ(c.size(), 8);
      const double slack = std::log(400.0) / sharpness;
      for (const auto& [at, share] :
           {std::pair{c[0], shares.position[0]}, std::pair{c[1], shares.speed[0]},
            std::pair{c[2], shares.acceleration[0]}, std::pair{c[6], shares.torque.maxCoeff()}}) {
        EXPECT_GE(at, share - 1);
        EXPECT_LE(at, share - 1 + slack);
      }
      EXPECT_GE(c[7], -10 * shares.distance);
    }
  }
}

TEST(MotionConstraints, GradientsEqualDifferences) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = limits_with_torque();
  const TrajectoryFamily family{.duration = 4, .harmonics = 3};
  const TrajectoryBasis basis = basis_at(family, period_times(family, 60));
  MatrixXd x(5, 2);
  x << 0.3, -0.2, 0.4, 0.7, -0.5, 0.1, 0.2, 0.6, 0.3, -0.4;
  const MotionConstraints at = constraints_of(model, limits, basis.motion(x), 30, 0.9);
  const double h = 1e-6;
  for (Index k = 0; k < x.size(); ++k) {
    MatrixXd after = x, before = x;
    after.data()[k] += h;
    before.data()[k] -= h;
    const VectorXd difference =
        (constraints_of(model, limits, basis.motion(after), 30, 0.9).values -
         constraints_of(model, limits, basis.motion(before), 30, 0.9).values) /
        (2 * h);
    for (Index c = 0; c < difference.size(); ++c) {
      JointMotion gradient = at.by_motion[static_cast<std::size_t>(c)];
      for (MatrixXd* part : {&gradient.q, &gradient.dq, &gradient.ddq}) {
        if (part->size() == 0) *part = MatrixXd::Zero(60, 2);
      }
      EXPECT_NEAR(basis.pull_back(gradient).data()[k], difference[c], 1e-5) << c;
    }
  }
}

ExcitationOptions short_search() {
  ExcitationOptions options;
  options.family = {.duration = 6, .harmonics = 3};
  options.starts = 2;
  options.evaluations = 300;
  return options;
}

TEST(Excite, ImprovesOnItsStartsWithinAllLimits) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = limits_with_torque();
  for (const TrajectoryForm form : {TrajectoryForm::kFourier, TrajectoryForm::kSpline}) {
    ExcitationOptions options = short_search();
    options.family.form = form;
    const Excitation found = excite(model, limits, options);
    ASSERT_TRUE(found.found) << found.message;
    const LimitShares shares = shares_at_rate(
        model, limits, options.family.duration,
        [&](const VectorXd& time) { return basis_at(options.family, time).motion(found.x); },
        10000);
    EXPECT_LE(shares.largest(), 1);
    EXPECT_GE(shares.distance, 0);
    const TrajectoryBasis basis = basis_at(options.family, period_times(options.family, 500));
    const double condition = condition_number(model, basis.motion(found.x), {});
    for (const ExcitationStart& start : found.starts) EXPECT_LT(condition, 0.8 * start.random);
    EXPECT_LE(found.evaluations, 300 + 8);  // every stage looks at its start
  }
}

TEST(Excite, IsRepeatedExactlyWhenEvaluationsEndIt) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = test::small_arm_limits();
  const Excitation one = excite(model, limits, short_search());
  const Excitation two = excite(model, limits, short_search());
  EXPECT_EQ(one.x, two.x);
  ExcitationOptions other = short_search();
  other.seed = 77;
  EXPECT_NE(one.x, excite(model, limits, other).x);
}

TEST(Excite, EveryCriterionIsBestByItsOwnMeasure) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = test::small_arm_limits();
  std::vector<Criterion> criteria = {Criterion::kCondition, Criterion::kDeterminant,
                                     Criterion::kTrace, Criterion::kSmallest};
  std::vector<MatrixXd> information;
  for (const Criterion criterion : criteria) {
    ExcitationOptions options = short_search();
    options.evaluations = 600;
    options.criterion.criterion = criterion;
    const Excitation found = excite(model, limits, options);
    ASSERT_TRUE(found.found);
    const TrajectoryBasis basis = basis_at(options.family, period_times(options.family, 500));
    information.push_back(information_of(model, basis.motion(found.x), {}).R);
  }
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    const CriterionOptions own{.criterion = criteria[i], .power = 1e4};
    for (const MatrixXd& other : information) {
      // local minima may differ a little
      EXPECT_LE(evaluate(information[i], own).value, evaluate(other, own).value + 0.1) << i;
    }
  }
}

TEST(Excite, PriorInformationDrawsTheTrajectoryToWhatIsNotKnown) {
  const LinearModel model = test::small_arm();
  const MotionLimits limits = test::small_arm_limits();
  ExcitationOptions options = short_search();
  options.criterion.criterion = Criterion::kTrace;
  const auto last_deviation = [&](const Excitation& found) {
    const TrajectoryBasis basis = basis_at(options.family, period_times(options.family, 500));
    return standard_deviations(information_of(model, basis.motion(found.x), {}).R)[3];
  };
  const double without = last_deviation(excite(model, limits, options));
  options.information.prior = 1e6 * MatrixXd::Identity(4, 4);
  options.information.prior(3, 3) = 0;
  EXPECT_LT(last_deviation(excite(model, limits, options)), 0.9 * without);
}

TEST(Excite, SaysThatNothingKeepsTheLimits) {
  const LinearModel model = test::small_arm();
  MotionLimits limits = limits_with_torque();
  limits.torque[0] = 1e-3;  // less than what holds the arm
  limits.box.reset();
  const Excitation found = excite(model, limits, short_search());
  EXPECT_FALSE(found.found);
  EXPECT_NE(found.message.find("torque"), std::string::npos);
}

TEST(Excite, RefusesWrongOptions) {
  const LinearModel model = test::small_arm();
  MotionLimits limits = test::small_arm_limits();
  ExcitationOptions options = short_search();
  options.starts = 0;
  EXPECT_THROW(excite(model, limits, options), std::invalid_argument);
  limits.upper[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(excite(model, limits, short_search()), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime

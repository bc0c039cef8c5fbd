// SPDX-License-Identifier: MIT
#include "runtime/control/controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "puma560.h"
#include "runtime/control/velocity_filter.h"
#include "runtime/recordings/trajectory_file.h"
#include "tests/runtime/recursive/allocation_count.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

constexpr int kJoints = PUMA560_NQ;

ModelFunctions puma() {
  return {"puma560",       kJoints,         {puma560_joint_names, puma560_joint_names + kJoints},
          puma560_id,      puma560_gravity, puma560_coriolis,
          puma560_friction};
}

struct State {
  VectorXd q, dq, q_ref, dq_ref, ddq_ref;

  [[nodiscard]] ControlInput input() const {
    return {q.data(), dq.data(), q_ref.data(), dq_ref.data(), ddq_ref.data()};
  }
};

State random_state(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-2, 2);
  const auto vector = [&] {
    return VectorXd::NullaryExpr(kJoints, [&] { return uniform(random); }).eval();
  };
  return {vector(), vector(), vector(), vector(), vector()};
}

ControllerOptions options(ControlLaw law, bool friction = false) {
  ControllerOptions result;
  result.law = law;
  result.gains = acceleration_gains(kJoints, 2, 0.7);
  result.friction = friction;
  return result;
}

VectorXd step(Controller& controller, const State& state) {
  VectorXd tau(kJoints);
  controller.step(state.input(), tau.data());
  return tau;
}

TEST(Controller, ComputesItsLaw) {
  std::mt19937_64 random(11);
  const ModelFunctions model = puma();
  for (int k = 0; k < 20; ++k) {
    const State s = random_state(random);
    const Gains gains = options(ControlLaw::kPd).gains;
    const VectorXd feedback =
        gains.kp.cwiseProduct(s.q_ref - s.q) + gains.kd.cwiseProduct(s.dq_ref - s.dq);
    const auto rigid = [&](const VectorXd& q, const VectorXd& dq, const VectorXd& ddq) {
      return (inverse_dynamics(model, q, dq, ddq) - friction(model, dq)).eval();
    };
    const auto law = [&](ControlLaw which) {
      Controller controller(control_model(model), options(which));
      return step(controller, s);
    };
    EXPECT_TRUE(law(ControlLaw::kPd).isApprox(feedback, 1e-13));
    EXPECT_TRUE(law(ControlLaw::kGravity).isApprox(feedback + gravity(model, s.q), 1e-13));
    EXPECT_TRUE(law(ControlLaw::kFeedforward)
                    .isApprox(feedback + rigid(s.q_ref, s.dq_ref, s.ddq_ref), 1e-13));
    EXPECT_TRUE(
        law(ControlLaw::kComputedTorque).isApprox(rigid(s.q, s.dq, s.ddq_ref + feedback), 1e-13));
  }
}

TEST(Controller, AddsFrictionAtTheVelocityAskedFor) {
  std::mt19937_64 random(12);
  const ModelFunctions model = puma();
  State s = random_state(random);
  for (const ControlLaw law :
       {ControlLaw::kGravity, ControlLaw::kFeedforward, ControlLaw::kComputedTorque}) {
    Controller without(control_model(model), options(law));
    ControllerOptions with = options(law, true);
    Controller reference(control_model(model), with);
    with.friction_velocity = FrictionVelocity::kMeasured;
    Controller measured(control_model(model), with);
    EXPECT_TRUE((step(reference, s) - step(without, s)).isApprox(friction(model, s.dq_ref), 1e-10));
    EXPECT_TRUE((step(measured, s) - step(without, s)).isApprox(friction(model, s.dq), 1e-10));
  }
}

TEST(FrictionCompensation, IsContinuousAndLinearInItsBand) {
  const ControlModel model = control_model(puma());
  const VectorXd band = VectorXd::LinSpaced(kJoints, 0.01, 0.1);
  FrictionCompensation compensation(model, band);
  const auto at = [&](const VectorXd& dq) {
    VectorXd tau = VectorXd::Zero(kJoints);
    compensation.add(dq.data(), tau.data());
    return tau;
  };
  const VectorXd upper = at(band), lower = at(-band);
  EXPECT_EQ(upper, friction(puma(), band));
  EXPECT_EQ(lower, friction(puma(), -band));
  for (const double share : {-0.9, -0.3, 0.0, 0.2, 0.8}) {
    const VectorXd expected = (upper + lower) / 2 + share * (upper - lower) / 2;
    EXPECT_TRUE((at(share * band) - expected).isZero(1e-12));
  }
  EXPECT_TRUE(at((1 - 1e-12) * band).isApprox(upper, 1e-9));
}

/// The largest jump of torque between cycles of a joint that stands, with a noisy velocity.
double chatter(Controller& controller, double noise) {
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal(0, noise);
  State s{VectorXd::Zero(kJoints), VectorXd::Zero(kJoints), VectorXd::Zero(kJoints),
          VectorXd::Zero(kJoints), VectorXd::Zero(kJoints)};
  double worst = 0;
  VectorXd before = step(controller, s);
  for (int k = 0; k < 1000; ++k) {
    for (double& dq : s.dq) dq = normal(random);
    const VectorXd tau = step(controller, s);
    worst = std::max(worst, (tau - before).cwiseAbs().maxCoeff());
    before = tau;
  }
  return worst;
}

TEST(Controller, ComputedTorqueDoesNotChatterAtRest) {
  ControllerOptions quiet = options(ControlLaw::kComputedTorque, true);
  quiet.gains = {VectorXd::Ones(kJoints), VectorXd::Ones(kJoints)};
  quiet.friction_velocity = FrictionVelocity::kMeasured;
  Controller with_band(control_model(puma()), quiet);
  // 26 N m of Coulomb friction at joint 1; 26 / 0.02 N m s/rad times 1e-5 rad/s of noise
  EXPECT_LT(chatter(with_band, 1e-5), 0.12);
  quiet.friction_band = VectorXd::Constant(kJoints, 1e-9);
  Controller without_band(control_model(puma()), quiet);
  EXPECT_GT(chatter(without_band, 1e-5), 40);  // so the test can see chatter
}

TEST(Controller, KeepsTorqueLimits) {
  std::mt19937_64 random(14);
  const State s = random_state(random);
  Controller free(control_model(puma()), options(ControlLaw::kComputedTorque));
  const VectorXd asked = step(free, s);
  ControllerOptions limited = options(ControlLaw::kComputedTorque);
  limited.torque_limit = VectorXd::Constant(kJoints, std::numeric_limits<double>::infinity());
  limited.torque_limit[1] = std::abs(asked[1]) / 2;
  limited.torque_limit[2] = std::abs(asked[2]) * 2;
  Controller controller(control_model(puma()), limited);
  VectorXd tau(kJoints);
  EXPECT_EQ(controller.step(s.input(), tau.data()), 1);
  VectorXd expected = asked;
  expected[1] /= 2;
  EXPECT_EQ(tau, expected);
}

TEST(Controller, RefusesWhatItCannotDo) {
  const ControlModel model = control_model(puma());
  EXPECT_THROW(Controller(model, options(ControlLaw::kPd, true)), std::invalid_argument);
  ControllerOptions wrong = options(ControlLaw::kPd);
  wrong.gains.kp[3] = -1;
  EXPECT_THROW(Controller(model, wrong), std::invalid_argument);
  wrong = options(ControlLaw::kPd);
  wrong.torque_limit = VectorXd::Zero(kJoints);
  EXPECT_THROW(Controller(model, wrong), std::invalid_argument);
  wrong = options(ControlLaw::kFeedforward, true);
  wrong.friction_band = VectorXd::Ones(2);
  EXPECT_THROW(Controller(model, wrong), std::invalid_argument);
  ControlModel empty;
  empty.joints = kJoints;
  EXPECT_NO_THROW(Controller(empty, options(ControlLaw::kPd)));
  EXPECT_THROW(Controller(empty, options(ControlLaw::kGravity)), std::invalid_argument);
  EXPECT_THROW(Controller(empty, options(ControlLaw::kComputedTorque)), std::invalid_argument);
  ModelFunctions no_friction = puma();
  no_friction.friction = nullptr;
  EXPECT_THROW(control_model(no_friction), std::invalid_argument);
  EXPECT_THROW(torque_gains(VectorXd::Zero(2), 1, 1), std::invalid_argument);
  EXPECT_THROW(acceleration_gains(2, 0, 1), std::invalid_argument);
}

TEST(Controller, StepsWithoutAllocation) {
  std::mt19937_64 random(15);
  const State s = random_state(random);
  VectorXd tau(kJoints);
  for (const ControlLaw law : {ControlLaw::kPd, ControlLaw::kGravity, ControlLaw::kFeedforward,
                               ControlLaw::kComputedTorque}) {
    ControllerOptions all = options(law, law != ControlLaw::kPd);
    all.torque_limit = VectorXd::Constant(kJoints, 50);
    Controller controller(control_model(puma()), all);
    VelocityFilter filter({}, s.q, s.dq);
    const Trajectory trajectory{Eigen::Vector2d(0, 1), Eigen::MatrixXd::Zero(2, kJoints),
                                Eigen::MatrixXd::Zero(2, kJoints),
                                Eigen::MatrixXd::Zero(2, kJoints)};
    VectorXd q(kJoints), dq(kJoints), ddq(kJoints);
    const long before = test::allocation_count();
    for (int k = 0; k < 1000; ++k) {
      motion_at(trajectory, 1e-3 * k, q.data(), dq.data(), ddq.data());
      filter.update(s.q_ref.data());
      controller.step(s.input(), tau.data());
    }
    EXPECT_EQ(test::allocation_count() - before, 0) << law_name(law);
  }
}

}  // namespace
}  // namespace dyngen::runtime

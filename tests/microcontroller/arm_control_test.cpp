// SPDX-License-Identifier: MIT
// The example for microcontrollers against the double code of a workstation.
#include "arm_control.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>

#include "puma560.h"
#include "runtime/control/controller.h"

namespace dyngen::test {
namespace {

using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr int kJoints = MCU_ARM_NQ;
static_assert(MCU_ARM_NQ == PUMA560_NQ);

runtime::ModelFunctions puma() {
  return {"puma560",       kJoints,         {puma560_joint_names, puma560_joint_names + kJoints},
          puma560_id,      puma560_gravity, puma560_coriolis,
          puma560_friction};
}

TEST(Microcontroller, TorqueIsThatOfTheDoubleCode) {
  std::mt19937_64 random(20261121);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto values = [&](float range) {
    return VectorXf::NullaryExpr(kJoints, [&] { return range * uniform(random); }).eval();
  };
  for (const arm_law law : {ARM_GRAVITY, ARM_FEEDFORWARD}) {
    arm_control control{};
    control.law = law;
    control.friction_band = 0.05F;
    runtime::ControllerOptions options;
    options.law =
        law == ARM_GRAVITY ? runtime::ControlLaw::kGravity : runtime::ControlLaw::kFeedforward;
    options.friction = true;
    options.friction_band = VectorXd::Constant(kJoints, static_cast<double>(control.friction_band));
    options.gains = {VectorXd(kJoints), VectorXd(kJoints)};
    options.torque_limit = VectorXd(kJoints);
    for (int j = 0; j < kJoints; ++j) {
      options.gains.kp[j] = control.kp[j] = 100.0F / static_cast<float>(1 + j);
      options.gains.kd[j] = control.kd[j] = 10.0F / static_cast<float>(1 + j);
      options.torque_limit[j] = control.torque_limit[j] = 80.0F / static_cast<float>(1 + j);
    }
    runtime::Controller controller(runtime::control_model(puma()), options);
    int limited = 0, in_band = 0;
    for (int k = 0; k < 2000; ++k) {
      arm_reference reference{};
      const VectorXf q = values(3), dq = values(2), ddq_ref = values(5);
      const VectorXf q_ref = q + values(0.2F);
      const VectorXf dq_ref = values(k % 2 == 0 ? 2.0F : 0.06F);
      std::copy_n(q_ref.data(), kJoints, reference.q);
      std::copy_n(dq_ref.data(), kJoints, reference.dq);
      std::copy_n(ddq_ref.data(), kJoints, reference.ddq);
      VectorXf tau(kJoints);
      limited += arm_control_step(&control, &reference, q.data(), dq.data(), tau.data());
      in_band += static_cast<int>((dq_ref.array().abs() < control.friction_band).any());

      const VectorXd qd = q.cast<double>(), dqd = dq.cast<double>(), qr = q_ref.cast<double>(),
                     dqr = dq_ref.cast<double>(), ddqr = ddq_ref.cast<double>();
      VectorXd exact(kJoints);
      controller.step({qd.data(), dqd.data(), qr.data(), dqr.data(), ddqr.data()}, exact.data());
      // of some 200 operations on numbers up to 100 N m, each rounded to 6e-8
      EXPECT_LT((tau.cast<double>() - exact).cwiseAbs().maxCoeff(), 2e-4) << k;
    }
    EXPECT_GT(limited, 100);
    EXPECT_LT(limited, 2000 * kJoints / 2);
    EXPECT_GT(in_band, 500);
  }
}

}  // namespace
}  // namespace dyngen::test

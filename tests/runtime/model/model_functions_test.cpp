// SPDX-License-Identifier: MIT
#include "runtime/model/model_functions.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

#include "puma560.h"

namespace dyngen::runtime {
namespace {

ModelFunctions puma() {
  return {"puma560",       PUMA560_NQ,      {puma560_joint_names, puma560_joint_names + PUMA560_NQ},
          puma560_id,      puma560_gravity, puma560_coriolis,
          puma560_friction};
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(ModelFunctions, AnswersAsTheGeneratedCode) {
  const ModelFunctions robot = puma();
  EXPECT_NO_THROW(robot.validate());
  EXPECT_EQ(robot.joint_names[1], "shoulder");
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -1, 1.5);
  const Eigen::VectorXd dq = Eigen::VectorXd::LinSpaced(6, 2, -1);
  const Eigen::VectorXd ddq = Eigen::VectorXd::LinSpaced(6, -3, 4);
  Eigen::VectorXd tau(6);
  puma560_id(q.data(), dq.data(), ddq.data(), tau.data());
  EXPECT_EQ(inverse_dynamics(robot, q, dq, ddq), tau);
  puma560_gravity(q.data(), tau.data());
  EXPECT_EQ(gravity(robot, q), tau);
  puma560_coriolis(q.data(), dq.data(), tau.data());
  EXPECT_EQ(coriolis(robot, q, dq), tau);
  puma560_friction(dq.data(), tau.data());
  EXPECT_EQ(friction(robot, dq), tau);
}

TEST(ModelFunctions, SumOfPartsIsInverseDynamicsWithoutAcceleration) {
  const ModelFunctions robot = puma();
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -2, 3);
  const Eigen::VectorXd dq = Eigen::VectorXd::LinSpaced(6, 3, -2);
  const Eigen::VectorXd whole = inverse_dynamics(robot, q, dq, Eigen::VectorXd::Zero(6));
  const Eigen::VectorXd parts = gravity(robot, q) + coriolis(robot, q, dq) + friction(robot, dq);
  // some hundred roundings of numbers no larger than the largest torque
  EXPECT_LT((whole - parts).cwiseAbs().maxCoeff(), 1e-13 * whole.cwiseAbs().maxCoeff());
}

TEST(ModelFunctions, NamesTheVectorOfWrongSize) {
  const ModelFunctions robot = puma();
  const Eigen::VectorXd six = Eigen::VectorXd::Zero(6), five = Eigen::VectorXd::Zero(5);
  EXPECT_EQ(message_of([&] { inverse_dynamics(robot, six, five, six); }),
            "inverse_dynamics(): dq has 5 values, puma560 has 6 joints");
  EXPECT_EQ(message_of([&] { gravity(robot, five); }),
            "gravity(): q has 5 values, puma560 has 6 joints");
}

TEST(ModelFunctions, NamesTheFunctionThatWasNotGenerated) {
  ModelFunctions robot = puma();
  robot.coriolis = nullptr;
  EXPECT_NO_THROW(robot.validate());
  const Eigen::VectorXd six = Eigen::VectorXd::Zero(6);
  EXPECT_EQ(message_of([&] { coriolis(robot, six, six); }),
            "coriolis(): puma560 was generated without this function; add it to FUNCTIONS of "
            "dyngen_add_robot");
}

TEST(ModelFunctions, ValidateRefusesWhatIsNotAModel) {
  ModelFunctions robot = puma();
  robot.joint_names.pop_back();
  EXPECT_EQ(message_of([&] { robot.validate(); }),
            "ModelFunctions: puma560 has 5 joint names, nq = 6");
  robot = puma();
  robot.nq = 0;
  EXPECT_EQ(message_of([&] { robot.validate(); }),
            "ModelFunctions: puma560 has nq = 0, expected 1 or more");
  const ModelFunctions empty{.name = "empty", .nq = 1, .joint_names = {"joint1"}};
  EXPECT_EQ(message_of([&] { empty.validate(); }), "ModelFunctions: empty has no function");
}

}  // namespace
}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
// Random robots: what is pruned, regrouped and merged must not change a torque.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

// 12 joints in double against a judge in double: rounding grows with the chain.
constexpr double kTolerance = 1e-10;

double thousandths(int range) { return *rc::gen::inRange(-range, range + 1) / 1000.0; }

/// Angles that matter to pruning: right ones, straight ones, 60 degrees, and any.
double random_angle() {
  const double pi = std::acos(-1.0);
  switch (*rc::gen::inRange(0, 7)) {
    case 0:
    case 1:
      return 0;
    case 2:
      return pi / 2;
    case 3:
      return -pi / 2;
    case 4:
      return pi;
    case 5:
      return pi / 3;
    default:
      return thousandths(3000);
  }
}

/// Zero half of the time.
double random_or_zero(int range) { return *rc::gen::arbitrary<bool>() ? thousandths(range) : 0.0; }

NumericRobot random_robot() {
  NumericRobot robot;
  robot.standard = *rc::gen::arbitrary<bool>();
  const int joints = *rc::gen::inRange(1, 13);
  const bool tree = *rc::gen::inRange(0, 4) == 0;
  for (int j = 1; j <= joints; ++j) {
    NumericJoint joint;
    const int kind = *rc::gen::inRange(0, 10);
    joint.sigma = kind < 7 ? 0 : kind < 9 ? 1 : 2;
    if (j == joints && kind == 9) joint.sigma = 0;  // something must move
    joint.parent = tree ? *rc::gen::inRange(0, j) : j - 1;
    joint.alpha = random_angle();
    joint.theta = random_angle();
    joint.d = random_or_zero(800);
    joint.r = random_or_zero(800);
    for (double& value : joint.inertial) value = random_or_zero(2000);
    if (joint.sigma != 2) {
      joint.IA = random_or_zero(1000);
      joint.Fs = random_or_zero(1000);
      joint.Fv = random_or_zero(1000);
      joint.off = random_or_zero(1000);
    }
    robot.joints.push_back(joint);
  }
  robot.base_acceleration = {random_or_zero(9810), random_or_zero(9810), random_or_zero(9810)};
  return robot;
}

const std::vector<std::string> kFunctions = {"id", "id_rigid", "gravity", "coriolis", "friction"};

void check_functions(const RobotModel& model, const NumericRobot& numbers,
                     const EvaluatedModel& evaluated) {
  for (const std::string& function : kFunctions) {
    RelativeError error;
    error.add(1.0, 1.0);  // a robot without any torque is judged against 1 N m
    for (const MotionSample& sample : random_samples(model.coordinate_count, 5, 7)) {
      error.add(evaluated.call(function, sample), judge(model, numbers, function, sample));
    }
    RC_ASSERT(error.value() < kTolerance);
  }
}

RC_GTEST_PROP(RandomRobot, PrunedAndRegroupedEqualsTheJudge, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel model = robot_model(numbers);
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    for (const bool regroup : {true, false}) {
      GeneratorOptions options;
      options.functions = kFunctions;
      options.parameters = mode;
      options.regroup = regroup;
      check_functions(model, numbers, EvaluatedModel(model, options));
    }
  }
}

RC_GTEST_PROP(RandomRobot, UnprunedCodeFedWithZerosEqualsTheJudge, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel values = robot_model(numbers);
  const RobotModel unpruned = with_unknown_parameters(values, false);
  for (const bool regroup : {true, false}) {
    GeneratorOptions options;
    options.functions = kFunctions;
    options.regroup = regroup;
    NumericRobot without_offset = numbers;  // offsets are not part of the unknown set
    for (NumericJoint& joint : without_offset.joints) joint.off = 0;
    check_functions(values, without_offset, EvaluatedModel(unpruned, values, options));
  }
}

RC_GTEST_PROP(RandomRobot, RunTimeLengthsEqualKnownOnes, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel values = robot_model(numbers);
  RobotModel symbolic = values;
  for (JointModel& joint : symbolic.joints) {
    if (*rc::gen::arbitrary<bool>()) joint.d.unknown = true;
    if (*rc::gen::arbitrary<bool>()) joint.r.unknown = true;
  }
  symbolic.gravity[2].unknown = *rc::gen::arbitrary<bool>();
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    for (const bool regroup : {true, false}) {
      GeneratorOptions options;
      options.functions = kFunctions;
      options.parameters = mode;
      options.regroup = regroup;
      check_functions(values, numbers, EvaluatedModel(symbolic, values, options));
    }
  }
}

}  // namespace
}  // namespace dyngen::test

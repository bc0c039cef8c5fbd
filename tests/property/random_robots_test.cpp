// SPDX-License-Identifier: MIT
// Random robots: what is pruned, regrouped and merged must not change a torque.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/frame_error.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/random_robot.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::random_robots_tests {
namespace {

// 12 joints in double against a judge in double: rounding grows with the chain.
constexpr double kTolerance = 1e-10;

const std::vector<std::string> kFunctions = {"id",       "id_rigid", "gravity",
                                             "coriolis", "friction", "mass_matrix"};

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

RobotModel with_some_lengths_unknown(RobotModel model) {
  for (JointModel& joint : model.joints) {
    if (*rc::gen::arbitrary<bool>()) joint.d.unknown = true;
    if (*rc::gen::arbitrary<bool>()) joint.r.unknown = true;
  }
  return model;
}

RC_GTEST_PROP(RandomRobot, FramesEqualTheJudge, ()) {
  const RobotModel values = robot_model(random_robot());
  const RobotModel model = *rc::gen::arbitrary<bool>() ? with_some_lengths_unknown(values) : values;
  // 12 products in double, lengths of some metres
  RC_ASSERT(frame_error(model, values, {}, 3) < 1e-12);
}

RC_GTEST_PROP(RandomRobot, RunTimeLengthsEqualKnownOnes, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel values = robot_model(numbers);
  RobotModel symbolic = with_some_lengths_unknown(values);
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
}  // namespace dyngen::test::random_robots_tests

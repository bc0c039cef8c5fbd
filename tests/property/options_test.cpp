// SPDX-License-Identifier: MIT
// Gravity, a wrench on the last link and a payload as arguments, against the judge: a robot with
// other numbers, and the transpose of the Jacobian.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "tests/support/body_robots.h"
#include "tests/support/compiled_model.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::options_tests {
namespace {

constexpr double kTolerance = 1e-10;
constexpr int kSamples = 4;

const std::vector<std::string> kFunctions = {"id", "id_rigid", "gravity", "coriolis", "friction"};

/// J' w of the wrench (force and moment about O_n, in frame n) on the last link: what its virtual
/// work is per unit of each coordinate.
std::vector<double> wrench_torque(const NumericRobot& robot, const MotionSample& sample) {
  std::vector<double> q;
  std::size_t coordinate = 0;
  for (const NumericJoint& joint : robot.joints) {
    q.push_back(joint.sigma == 2 ? 0 : sample.q[coordinate++]);
  }
  const std::vector<Transform<double>> frames = forward_kinematics(robot, q);
  const Eigen::Matrix3d R = frames.back().topLeftCorner<3, 3>();
  const Eigen::Vector3d tip = frames.back().topRightCorner<3, 1>();
  const Eigen::Vector3d force = R * Eigen::Vector3d(sample.wrench.data());
  const Eigen::Vector3d moment = R * Eigen::Vector3d(sample.wrench.data() + 3);

  std::vector<bool> carries(robot.size(), false);  // the last link
  for (auto j = static_cast<int>(robot.size()); j > 0;) {
    carries[static_cast<std::size_t>(j - 1)] = true;
    j = robot.joints[static_cast<std::size_t>(j - 1)].parent;
  }
  std::vector<double> torque;
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const NumericJoint& joint = robot.joints[j];
    if (joint.sigma == 2) continue;
    Transform<double> axis_frame = frames[j];
    if (robot.standard) {  // the axis is z of the frame before
      axis_frame = joint.parent == 0 ? Transform<double>(Transform<double>::Identity())
                                     : frames[static_cast<std::size_t>(joint.parent - 1)];
    }
    const Eigen::Vector3d axis = axis_frame.block<3, 1>(0, 2);
    const Eigen::Vector3d arm = tip - axis_frame.block<3, 1>(0, 3);
    const double work = joint.sigma == 0 ? axis.dot(moment + arm.cross(force)) : axis.dot(force);
    torque.push_back(carries[j] ? work : 0);
  }
  return torque;
}

struct Arguments {
  bool gravity, wrench, payload;
};

const std::vector<Arguments> kArguments = {
    {true, false, false}, {false, true, false}, {false, false, true}, {true, true, true}};

GeneratorOptions options_of(const Arguments& arguments, ParameterMode mode, bool regroup) {
  GeneratorOptions options;
  options.functions = kFunctions;
  options.gravity = arguments.gravity;
  options.wrench = arguments.wrench;
  options.payload = arguments.payload;
  options.parameters = mode;
  options.regroup = regroup;
  return options;
}

std::vector<double> expected(const RobotModel& values, const Arguments& arguments,
                             const std::string& function, const MotionSample& sample) {
  NumericRobot robot = numeric_robot(values);
  if (arguments.gravity) {
    std::copy_n(sample.gravity.begin(), 3, robot.base_acceleration.begin());
  }
  if (arguments.payload) {
    for (std::size_t k = 0; k < 10; ++k) robot.joints.back().inertial[k] += sample.payload[k];
  }
  std::vector<double> torque = judge(values, robot, function, sample);
  if (arguments.wrench && function.starts_with("id")) {
    const std::vector<double> of_wrench = wrench_torque(robot, sample);
    for (std::size_t i = 0; i < torque.size(); ++i) torque[i] -= of_wrench[i];
  }
  return torque;
}

/// The largest error of all functions. @param model  what is generated: may leave numbers unknown
template <class Model>
double error_of(const RobotModel& values, const Arguments& arguments, const Model& call) {
  RelativeError error;
  error.add(1.0, 1.0);  // a robot without any torque is judged against 1 N m
  for (const MotionSample& sample : random_samples(values.coordinate_count, kSamples, 17)) {
    for (const std::string& function : kFunctions) {
      error.add(call(function, sample), expected(values, arguments, function, sample));
    }
  }
  return error.value();
}

double evaluated_error(const RobotModel& model, const RobotModel& values,
                       const Arguments& arguments, const GeneratorOptions& options) {
  const EvaluatedModel evaluated(model, values, options);
  return error_of(values, arguments, [&](const std::string& function, const MotionSample& sample) {
    return evaluated.call(function, sample);
  });
}

std::vector<NamedRobot> robots() {
  std::vector<NamedRobot> result = random_chains();
  const std::vector<NamedRobot> trees = random_trees();
  result.insert(result.end(), trees.begin(), trees.end());
  return result;
}

TEST(ArgumentOptions, EvaluatedEqualsTheJudgeInEveryMode) {
  for (const auto& [name, robot] : robots()) {
    const RobotModel model = robot_model(robot);
    for (const Arguments& arguments : kArguments) {
      for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
        for (const bool regroup : {true, false}) {
          const GeneratorOptions options = options_of(arguments, mode, regroup);
          EXPECT_LT(evaluated_error(model, model, arguments, options), kTolerance)
              << name << " gravity " << arguments.gravity << " wrench " << arguments.wrench
              << " payload " << arguments.payload << " regroup " << regroup;
        }
      }
    }
  }
}

TEST(ArgumentOptions, RunTimeLengthsGoWithThem) {
  const Arguments all = {true, true, true};
  for (const auto& [name, robot] : robots()) {
    const RobotModel values = robot_model(robot);
    RobotModel model = values;
    for (JointModel& joint : model.joints) joint.d.unknown = joint.r.unknown = true;
    model.gravity[1].unknown = true;
    for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
      EXPECT_LT(evaluated_error(model, values, all, options_of(all, mode, true)), kTolerance)
          << name;
    }
  }
}

TEST(ArgumentOptions, UnknownParametersGoWithThem) {
  const Arguments all = {true, true, true};
  for (const std::string path : {"robots/panda.robot", "robots/tx40.robot",
                                 "robots/sarcos_grla.robot", "tests/robots/odd_angles.robot"}) {
    const RobotModel model = read_model(path);
    const RobotModel values = with_random_values(model, 4);
    for (const bool regroup : {true, false}) {
      EXPECT_LT(
          evaluated_error(model, values, all, options_of(all, ParameterMode::kBaked, regroup)),
          kTolerance)
          << path;
    }
  }
}

TEST(ArgumentOptions, CompiledEqualsTheJudge) {
  const std::vector<NamedRobot> all = robots();
  for (std::size_t r = 0; r < all.size(); r += 5) {
    const auto& [name, robot] = all[r];
    const RobotModel model = robot_model(robot);
    for (const Arguments& arguments : kArguments) {
      const ParameterMode mode = r % 2 == 0 ? ParameterMode::kBaked : ParameterMode::kRuntime;
      const GeneratorOptions options = options_of(arguments, mode, r % 3 != 0);
      const CompiledModel compiled(model, options);
      const std::vector<double> chi = EvaluatedModel(model, options).chi();
      EXPECT_LT(error_of(model, arguments,
                         [&](const std::string& function, const MotionSample& sample) {
                           return compiled.call(function, sample, chi);
                         }),
                kTolerance)
          << name;
    }
  }
}

TEST(ArgumentOptions, ComparisonFailsOnOneWrongArgument) {
  const Arguments all = {true, true, true};
  const RobotModel model = robot_model(random_chains()[6].robot);
  const EvaluatedModel evaluated(model, options_of(all, ParameterMode::kBaked, true));
  const auto error_with = [&](const auto& spoil) {
    return error_of(model, all, [&](const std::string& function, MotionSample sample) {
      spoil(sample);
      return evaluated.call(function, sample);
    });
  };
  EXPECT_LT(error_with([](MotionSample&) {}), kTolerance);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(error_with([k](MotionSample& sample) { sample.gravity[k] += 1e-6; }), kTolerance);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_GT(error_with([k](MotionSample& sample) { sample.wrench[k] += 1e-6; }), kTolerance);
  }
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_GT(error_with([k](MotionSample& sample) { sample.payload[k] += 1e-6; }), kTolerance);
  }
}

}  // namespace
}  // namespace dyngen::test::options_tests

// SPDX-License-Identifier: MIT
// Forward dynamics undoes inverse dynamics, and solves what the judge's mass matrix says.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <stdexcept>
#include <string>
#include <vector>

#include "gen/algorithms/mass_matrix/determinacy.h"
#include "gen/diagnostic/diagnostic.h"
#include "tests/support/model_bridge.h"
#include "tests/support/physical_robot.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::forward_dynamics_tests {
namespace {

// Links that could be built, of like size: the condition of M costs three digits or so.
constexpr double kTolerance = 1e-9;

double round_trip_error(const EvaluatedModel& evaluated, const std::vector<MotionSample>& samples) {
  RelativeError error;
  for (MotionSample sample : samples) {
    sample.tau = evaluated.call("id", sample);
    error.add(evaluated.call("fd", sample), sample.ddq);
  }
  return error.value();
}

class ForwardDynamicsOfFile : public testing::TestWithParam<std::string> {};

TEST_P(ForwardDynamicsOfFile, UndoesInverseDynamics) {
  const RobotModel model = read_model(GetParam());
  for (GeneratorOptions options : every_mode({"id", "fd"})) {
    for (const bool arguments : {false, true}) {
      options.gravity = options.wrench = arguments;
      const EvaluatedModel evaluated(model, options);
      EXPECT_LT(round_trip_error(evaluated, random_samples(model.coordinate_count, 20, 5)),
                kTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, ForwardDynamicsOfFile,
                         testing::Values("robots/planar2r.robot", "robots/puma560.robot",
                                         "robots/rx90.robot", "robots/scara.robot",
                                         "robots/stanford.robot", "tests/robots/rp.robot",
                                         "tests/robots/panda7_oracle.robot",
                                         "tests/robots/ur10e_oracle.robot",
                                         "tests/robots/puma560_corke_std.robot"),
                         [](const auto& path) {
                           const std::size_t begin = path.param.rfind('/') + 1;
                           return path.param.substr(begin, path.param.rfind('.') - begin);
                         });

TEST(ForwardDynamics, UndoesInverseDynamicsOfTrees) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const RobotModel model = robot_model(physical_robot(seed, 3 + static_cast<int>(seed) % 6));
    for (const GeneratorOptions& options : every_mode({"id", "fd"})) {
      const EvaluatedModel evaluated(model, options);
      EXPECT_LT(round_trip_error(evaluated, random_samples(model.coordinate_count, 10, seed)),
                kTolerance)
          << "seed " << seed;
    }
  }
}

TEST(ForwardDynamics, UndoesInverseDynamicsWithRunTimeLengths) {
  for (unsigned seed = 41; seed <= 46; ++seed) {
    const RobotModel values = robot_model(physical_robot(seed, 5));
    RobotModel symbolic = values;
    for (JointModel& joint : symbolic.joints) joint.d.unknown = joint.r.unknown = true;
    for (const GeneratorOptions& options : every_mode({"id", "fd"})) {
      const EvaluatedModel evaluated(symbolic, values, options);
      EXPECT_LT(round_trip_error(evaluated, random_samples(values.coordinate_count, 10, seed)),
                kTolerance)
          << "seed " << seed;
    }
  }
}

TEST(ForwardDynamics, SolvesTheJudgesEquations) {
  for (unsigned seed = 61; seed <= 70; ++seed) {
    const NumericRobot numbers = physical_robot(seed, 3 + static_cast<int>(seed) % 6);
    const RobotModel model = robot_model(numbers);
    for (const GeneratorOptions& options : every_mode({"id", "fd"})) {
      const EvaluatedModel evaluated(model, options);
      RelativeError error;
      for (MotionSample sample : random_samples(model.coordinate_count, 10, seed)) {
        const auto n = static_cast<Eigen::Index>(sample.q.size());
        const std::vector<double> ddq = evaluated.call("fd", sample);
        MotionSample still = sample;
        still.ddq.assign(still.ddq.size(), 0.0);
        const std::vector<double> bias = judge(model, numbers, "id", still);
        const std::vector<double> M = judge(model, numbers, "mass_matrix", sample);
        const Eigen::VectorXd net = Eigen::Map<const Eigen::VectorXd>(sample.tau.data(), n) -
                                    Eigen::Map<const Eigen::VectorXd>(bias.data(), n);
        const Eigen::VectorXd expected =
            Eigen::Map<const Eigen::MatrixXd>(M.data(), n, n).llt().solve(net);
        error.add(ddq, std::vector<double>(expected.begin(), expected.end()));
      }
      EXPECT_LT(error.value(), kTolerance) << "seed " << seed;
    }
  }
}

TEST(ForwardDynamics, DividesOnceForEachJoint) {
  const RobotModel model = with_unknown_parameters(read_model("robots/puma560.robot"), true);
  GeneratorOptions options;
  options.functions = {"fd"};
  options.parameters = ParameterMode::kRuntime;
  CodeModel code = make_code_model(model, options);
  EXPECT_EQ(write_functions(code, options)[0].trace.count().divisions, 6);
}

TEST(ForwardDynamics, RobotWithAJointThatMovesNothingHasNone) {
  RobotModel model = read_model("robots/planar2r.robot");
  model.file_name = "planar2r.robot";
  for (Quantity& parameter : model.joints[1].chi) parameter = Quantity{};
  const auto functions_of = [&](const std::vector<std::string>& functions) {
    GeneratorOptions options;
    options.functions = functions;
    CodeModel code = make_code_model(model, options);
    return write_functions(code, options);
  };
  for (const RobotFunction& function : functions_of({})) EXPECT_NE(function.name, "fd");
  try {
    functions_of({"id", "fd"});
    FAIL() << "no message";
  } catch (const ModelError& error) {
    EXPECT_STREQ(
        error.what(),
        "planar2r.robot: error: --functions: 'fd': joint 2, with the joints that it carries, has "
        "a motion that moves neither mass nor rotor: accelerations are not determined\n");
  }
}

TEST(ForwardDynamics, RobotWithAMotionThatMovesNothingHasNone) {
  // two slides along one direction, and a mass on the second alone
  const RobotModel model = parse_model("NUMBER_LINK 2\nsigma 1 1\nd 0 0.3\nm 0 2\ngz 9.81\nstop\n");
  GeneratorOptions options;
  const CodeModel code = make_code_model(model, options);
  EXPECT_EQ(undetermined_joint(code), 1);
  EXPECT_EQ(undetermined_joint(make_code_model(read_model("robots/puma560.robot"), options)), 0);
}

}  // namespace
}  // namespace dyngen::test::forward_dynamics_tests

// SPDX-License-Identifier: MIT
// Centre of mass, its Jacobian and momentum against differences of the judge's poses, and the
// reasons why a robot has none.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "tests/support/body_robots.h"
#include "tests/support/compiled_model.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_centroid.h"
#include "tests/support/relative_error.h"

#ifdef DYNGEN_WITH_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_robot.h"
#endif

namespace dyngen::test::centroid_tests {
namespace {

// Products of 12 matrices in double against differences good to 1e-15 or so.
constexpr double kTolerance = 1e-10;

const std::vector<std::string> kFunctions = {"com", "com_jacobian", "momentum"};

struct Mode {
  ParameterMode parameters;
  bool regroup;
};

// base parameters at run time do not show bodies
const std::vector<Mode> kModes = {{ParameterMode::kBaked, true},
                                  {ParameterMode::kBaked, false},
                                  {ParameterMode::kRuntime, false}};

/// All outputs, each against its own largest element or 1.
double centroid_error(const RobotModel& model, const RobotModel& values, const Mode& mode,
                      bool payload, int samples) {
  GeneratorOptions options;
  options.functions = kFunctions;
  options.parameters = mode.parameters;
  options.regroup = mode.regroup;
  options.payload = payload;
  const EvaluatedModel evaluated(model, values, options);
  std::vector<RelativeError> errors(4);
  for (RelativeError& error : errors) error.add(1.0, 1.0);
  for (const MotionSample& sample : random_samples(model.coordinate_count, samples, 21)) {
    NumericRobot robot = numeric_robot(values);
    if (payload) {
      for (std::size_t k = 0; k < 10; ++k) robot.joints.back().inertial[k] += sample.payload[k];
    }
    const NumericCentroid expected = numeric_centroid(values, robot, sample);
    const auto list = [](const auto& array) {
      return std::vector<long double>(array.begin(), array.end());
    };
    errors[0].add(evaluated.call("com", sample), list(expected.center));
    errors[1].add(evaluated.call("com", sample, "mass")[0], expected.mass);
    errors[2].add(evaluated.call("com_jacobian", sample), expected.jacobian);
    errors[3].add(evaluated.call("momentum", sample), list(expected.momentum));
  }
  double largest = 0;
  for (const RelativeError& error : errors) largest = std::max(largest, error.value());
  return largest;
}

TEST(Centroid, OfEveryRobotEqualsTheJudge) {
  for (const auto& [name, robot] : robots_of_files()) {
    const RobotModel model = robot_model(robot);
    for (const Mode& mode : kModes) {
      EXPECT_LT(centroid_error(model, model, mode, false, 5), kTolerance) << name;
    }
  }
}

TEST(Centroid, OfRandomRobotsWithPayloadAndRunTimeLengthsEqualsTheJudge) {
  std::vector<NamedRobot> robots = random_chains();
  const std::vector<NamedRobot> trees = random_trees();
  robots.insert(robots.end(), trees.begin(), trees.end());
  for (const auto& [name, robot] : robots) {
    const RobotModel values = robot_model(robot);
    RobotModel model = values;
    for (JointModel& joint : model.joints) joint.d.unknown = joint.r.unknown = true;
    for (const Mode& mode : kModes) {
      // the sample's payload may take mass away: the sum stays far from zero
      EXPECT_LT(centroid_error(values, values, mode, true, 3), 10 * kTolerance) << name;
      EXPECT_LT(centroid_error(model, values, mode, false, 3), kTolerance) << name;
    }
  }
}

TEST(Centroid, MomentumIsMassTimesTheVelocityOfTheCentre) {
  const RobotModel model = robot_model(random_trees()[3].robot);
  GeneratorOptions options;
  options.functions = kFunctions;
  const EvaluatedModel evaluated(model, options);
  const auto n = static_cast<std::size_t>(model.coordinate_count);
  RelativeError error;
  for (const MotionSample& sample : random_samples(model.coordinate_count, 10, 4)) {
    const double mass = evaluated.call("com", sample, "mass")[0];
    const std::vector<double> J = evaluated.call("com_jacobian", sample);
    const std::vector<double> h = evaluated.call("momentum", sample);
    for (std::size_t k = 0; k < 3; ++k) {
      double velocity = 0;
      for (std::size_t j = 0; j < n; ++j) velocity += J[k * n + j] * sample.dq[j];
      error.add(mass * velocity, h[k]);
    }
  }
  EXPECT_LT(error.value(), 1e-12);
}

TEST(Centroid, CompiledWithEveryOptionEqualsEvaluated) {
  const RobotModel model = robot_model(random_trees()[2].robot, "tree");
  for (const bool fold : {false, true}) {
    for (const Scalar scalar : {Scalar::kDouble, Scalar::kFloat}) {
      GeneratorOptions options;
      options.functions = kFunctions;
      options.parameters = ParameterMode::kRuntime;
      options.regroup = false;
      options.payload = true;
      options.fold = fold;
      options.scalar = scalar;
      const CompiledModel compiled(model, options);
      const EvaluatedModel evaluated(model, options);
      for (const std::string& function : kFunctions) {
        RelativeError error;
        for (const MotionSample& sample : random_samples(model.coordinate_count, 5, 6)) {
          error.add(compiled.call(function, sample, evaluated.chi()),
                    evaluated.call(function, sample));
        }
        EXPECT_LT(error.value(), scalar == Scalar::kFloat ? 1e-4 : 1e-13) << function;
      }
    }
  }
}

/// What the message says where the function is asked for by its name.
std::string refusal(const RobotModel& model, const GeneratorOptions& options) {
  GeneratorOptions asked = options;
  asked.functions = {"com"};
  try {
    generate(model, asked);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

const char* const kArm =
    "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nm 2 3\nmX 0.4 0.6\nZZ 0.1 0.2\n";

TEST(Centroid, IsRefusedWithAReason) {
  const RobotModel arm = parse_model(std::string(kArm) + "gz 9.81\nstop\n");
  EXPECT_EQ(refusal(arm, {}), "");
  GeneratorOptions runtime;
  runtime.parameters = ParameterMode::kRuntime;
  EXPECT_NE(refusal(arm, runtime).find("chi holds base parameters"), std::string::npos);
  runtime.regroup = false;
  EXPECT_EQ(refusal(arm, runtime), "");

  const RobotModel base = parse_model(
      "name arm\nnumber_link 2\nparameters base\nsigma 0 0\nal 0 0\nd 0 0.5\nm 2 3\nmX 0.4 0.6\n"
      "ZZ 0.1 0.2\ngz 9.81\nstop\n");
  EXPECT_NE(refusal(base, {}).find("are base parameters"), std::string::npos) << refusal(base, {});

  const RobotModel unknown = parse_model(
      "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nm 2 *\nmX 0.4 0.6\nZZ 0.1 0.2\n"
      "gz 9.81\nstop\n");
  EXPECT_NE(refusal(unknown, {}).find("M2 is unknown"), std::string::npos);
  GeneratorOptions standard;
  standard.regroup = false;
  EXPECT_EQ(refusal(unknown, standard), "");

  const RobotModel partly = parse_model(
      "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nm 2 0\nmX 0.4 0.1\nZZ 0.1 0.2\n"
      "gz 9.81\nstop\n");
  EXPECT_NE(refusal(partly, {}).find("link 2 has first moments and no mass"), std::string::npos);

  const RobotModel nothing =
      parse_model("name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nIA 1 1\ngz 9.81\nstop\n");
  EXPECT_NE(refusal(nothing, {}).find("the mass of the whole robot is 0"), std::string::npos);
}

TEST(Centroid, SaysWhichLinksHaveNoMass) {
  GeneratorOptions options;
  options.functions = {"com"};
  const CText text = generate(read_model("robots/puma560.robot"), with_short_search(options));
  EXPECT_NE(text.header.find("Without mass in the robot file:"), std::string::npos) << text.header;
}

TEST(Centroid, IsLeftOutWithoutAWordWhereNobodyAskedForIt) {
  const RobotModel model = read_model("robots/planar2r.robot");
  GeneratorOptions options;
  options.parameters = ParameterMode::kRuntime;
  int told = 0;
  options.left_out = [&](const std::string&, const std::string&) { ++told; };
  const CText text = generate(model, with_short_search(options));
  EXPECT_EQ(text.header.find("planar2r_com("), std::string::npos);
  EXPECT_NE(text.header.find("planar2r_external_torque("), std::string::npos);
  EXPECT_EQ(told, 0);
}

#ifdef DYNGEN_WITH_RAPIDCHECK
RC_GTEST_PROP(CentroidOfRandomRobots, EqualsTheJudge, ()) {
  const RobotModel model = robot_model(random_robot());
  GeneratorOptions options;
  if (make_code_model(model, options).bodies.why_absent.empty()) {
    const auto mode = *rc::gen::inRange<std::size_t>(0, kModes.size());
    RC_ASSERT(centroid_error(model, model, kModes[mode], false, 3) < kTolerance);
  }
}
#endif

}  // namespace
}  // namespace dyngen::test::centroid_tests

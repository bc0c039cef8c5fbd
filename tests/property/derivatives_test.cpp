// SPDX-License-Identifier: MIT
// Derivatives of inverse dynamics against differences of the judge's torques: robot files, random
// chains and trees, every mode, every argument.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gen/symbols/exact.h"
#include "tests/support/body_robots.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_derivatives.h"
#include "tests/support/relative_error.h"

#ifdef DYNGEN_WITH_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_robot.h"
#endif

namespace dyngen::test::derivatives_tests {
namespace {

// Double arithmetic, some 3000 operations; the reference is good to 1e-13 or so.
constexpr double kTolerance = 1e-10;

const std::vector<std::string> kFunctions = {"id_dq_pos", "id_dq", "id_ddq", "id_derivatives"};

/// The judge's robot as the arguments of a sample make it.
NumericRobot as_asked(NumericRobot robot, const GeneratorOptions& options,
                      const MotionSample& sample) {
  if (options.gravity) std::copy_n(sample.gravity.begin(), 3, robot.base_acceleration.begin());
  if (options.payload) {
    for (std::size_t k = 0; k < 10; ++k) robot.joints.back().inertial[k] += sample.payload[k];
  }
  return robot;
}

/// The largest error of all four functions, each matrix against its own largest element or 1.
double derivative_error(const RobotModel& model, const RobotModel& values, GeneratorOptions options,
                        int samples) {
  options.functions = kFunctions;
  const EvaluatedModel evaluated(model, values, options);
  const NumericRobot numbers = numeric_robot(values);
  std::vector<RelativeError> errors(6);
  for (RelativeError& error : errors) error.add(1.0, 1.0);
  for (const MotionSample& sample : random_samples(model.coordinate_count, samples, 12)) {
    MotionSample judged = sample;
    if (!options.wrench) judged.wrench.clear();
    const TorqueDerivatives expected =
        torque_derivatives(values, as_asked(numbers, options, sample), judged);
    errors[0].add(evaluated.call("id_dq_pos", sample), expected.position);
    errors[1].add(evaluated.call("id_dq", sample), expected.velocity);
    errors[2].add(evaluated.call("id_ddq", sample), expected.acceleration);
    errors[3].add(evaluated.call("id_derivatives", sample, "D_q"), expected.position);
    errors[4].add(evaluated.call("id_derivatives", sample, "D_dq"), expected.velocity);
    errors[5].add(evaluated.call("id_derivatives", sample, "D_ddq"), expected.acceleration);
  }
  double largest = 0;
  for (const RelativeError& error : errors) largest = std::max(largest, error.value());
  return largest;
}

class Derivatives : public testing::TestWithParam<std::string> {};

TEST_P(Derivatives, EqualDifferencesOfTheJudge) {
  const RobotModel model = read_model(GetParam());
  for (const GeneratorOptions& options : every_mode()) {
    EXPECT_LT(derivative_error(model, with_random_values(model, 4), options, 8), kTolerance);
  }
}

TEST_P(Derivatives, OfUnknownParametersEqualDifferencesOfTheJudge) {
  const RobotModel model = with_unknown_parameters(read_model(GetParam()), false);
  GeneratorOptions options;
  EXPECT_LT(derivative_error(model, with_random_values(model, 5), options, 8), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, Derivatives,
    testing::Values("robots/planar2r.robot", "robots/puma560.robot", "robots/puma560_3dof.robot",
                    "robots/rx90.robot", "robots/tx40.robot", "robots/ur10e.robot",
                    "robots/panda.robot", "robots/stanford.robot", "robots/scara.robot",
                    "robots/sarcos_grla.robot", "robots/kuka_iiwa14.robot",
                    "tests/robots/puma560_corke_std.robot", "tests/robots/odd_angles.robot",
                    "tests/robots/flip3r.robot", "tests/robots/rp.robot",
                    "tests/robots/pendulum.robot"),
    [](const auto& entry) {
      const std::string path = entry.param;
      const std::size_t begin = path.rfind('/') + 1;
      return path.substr(begin, path.rfind('.') - begin);
    });

TEST(DerivativesOfRandomRobots, WithEveryArgumentEqualDifferencesOfTheJudge) {
  std::vector<NamedRobot> robots = random_chains();
  const std::vector<NamedRobot> trees = random_trees();
  robots.insert(robots.end(), trees.begin(), trees.end());
  for (const auto& [name, robot] : robots) {
    const RobotModel values = robot_model(robot);
    RobotModel model = values;
    for (JointModel& joint : model.joints) joint.d.unknown = joint.r.unknown = name.size() % 2 == 0;
    for (GeneratorOptions options : every_mode()) {
      options.gravity = options.wrench = options.payload = true;
      EXPECT_LT(derivative_error(model, values, options, 3), kTolerance) << name;
    }
  }
}

TEST(DerivativesOfRandomRobots, ComparisonFailsOnAWrongModel) {
  const RobotModel model = read_model("robots/puma560.robot");
  for (const std::size_t joint : {1U, 3U, 5U}) {
    RobotModel wrong = model;
    wrong.joints[joint].chi[index(Chi::kXX)].value += GiNaC::numeric(1, 1000000);
    GeneratorOptions options;
    options.parameters = ParameterMode::kRuntime;
    options.functions = {"id_dq_pos"};
    const EvaluatedModel evaluated(model, wrong, options);
    RelativeError error;
    for (const MotionSample& sample : random_samples(model.coordinate_count, 3, 1)) {
      MotionSample judged = sample;
      judged.wrench.clear();
      error.add(evaluated.call("id_dq_pos", sample),
                torque_derivatives(model, numeric_robot(model), judged).position);
    }
    EXPECT_GT(error.value(), kTolerance) << joint;
  }
}

/// dM/dt - 2 C is skew where C dq = c and C is half of dc/ddq: what energy asks of c.
TEST(DerivativesOfRandomRobots, VelocityDerivativeAndMassMatrixKeepEnergy) {
  const RobotModel model = read_model("robots/panda.robot");
  GeneratorOptions options;
  options.functions = {"mass_matrix", "coriolis", "id_dq"};
  const RobotModel values = with_random_values(model, 3);
  const EvaluatedModel evaluated(model, values, options);
  const std::size_t n = static_cast<std::size_t>(model.coordinate_count);
  const auto friction = [&](std::size_t i) {  // FV stands on the diagonal too
    return to_double(values.joints[i].chi[index(Chi::kFV)].value);
  };
  RelativeError skew, homogeneous;
  for (const MotionSample& sample : random_samples(model.coordinate_count, 10, 2)) {
    const std::vector<double> D = evaluated.call("id_dq", sample);
    const std::vector<double> c = evaluated.call("coriolis", sample);
    const auto moved = [&](double time) {
      MotionSample later = sample;
      for (std::size_t i = 0; i < n; ++i) later.q[i] += time * sample.dq[i];
      return evaluated.call("mass_matrix", later);
    };
    const double h = 1e-4;  // rounding 1e-16 / h, truncation h^2: 1e-8 of M
    const std::vector<double> before = moved(-h), after = moved(h);
    for (std::size_t i = 0; i < n; ++i) {
      double product = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double own = i == j ? friction(i) : 0;
        product += (D[i * n + j] - own) * sample.dq[j];
        skew.add(D[i * n + j] + D[j * n + i] - 2 * own, (after[i * n + j] - before[i * n + j]) / h);
      }
      homogeneous.add(product, 2 * c[i]);  // c is of degree 2
    }
  }
  EXPECT_LT(skew.value(), 1e-6);
  EXPECT_LT(homogeneous.value(), kTolerance);
}

#ifdef DYNGEN_WITH_RAPIDCHECK
RC_GTEST_PROP(DerivativesOfRandomRobots, EqualDifferencesOfTheJudge, ()) {
  const RobotModel values = robot_model(random_robot());
  RobotModel model = values;
  if (*rc::gen::arbitrary<bool>()) {
    for (JointModel& joint : model.joints) {
      joint.d.unknown = *rc::gen::arbitrary<bool>();
      joint.r.unknown = *rc::gen::arbitrary<bool>();
    }
  }
  const std::vector<GeneratorOptions> modes = every_mode();
  const auto mode = *rc::gen::inRange<std::size_t>(0, modes.size());
  RC_ASSERT(derivative_error(model, values, modes[mode], 3) < kTolerance);
}
#endif

}  // namespace
}  // namespace dyngen::test::derivatives_tests

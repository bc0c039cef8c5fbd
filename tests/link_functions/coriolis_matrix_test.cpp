// SPDX-License-Identifier: MIT
// Coriolis matrices against Christoffel symbols of the judge's mass matrix: robot files, random
// chains and trees, every mode.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/body_robots.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_centroid.h"
#include "tests/support/relative_error.h"

#ifdef DYNGEN_WITH_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_robot.h"
#endif

namespace dyngen::test::coriolis_matrix_tests {
namespace {

// Double arithmetic, some 1000 operations; the reference is good to 1e-13 or so.
constexpr double kTolerance = 1e-10;

const std::vector<std::string> kMatrices = {"coriolis_matrix", "coriolis_matrix_fast"};

NumericRobot with_payload(NumericRobot robot, const MotionSample& sample) {
  for (std::size_t k = 0; k < 10; ++k) robot.joints.back().inertial[k] += sample.payload[k];
  return robot;
}

struct CoriolisErrors {
  RelativeError christoffel;  ///< of coriolis_matrix
  RelativeError skew;         ///< C + C' against dM/dt, of coriolis_matrix
  RelativeError torque;       ///< C dq of both against the judge's c
};

/// All against the largest element or 1.
CoriolisErrors coriolis_errors(const RobotModel& model, const RobotModel& values,
                               GeneratorOptions options, int samples) {
  options.functions = kMatrices;
  const EvaluatedModel evaluated(model, values, options);
  CoriolisErrors errors;
  for (RelativeError* error : {&errors.christoffel, &errors.skew, &errors.torque}) {
    error->add(1.0, 1.0);
  }
  const auto n = static_cast<std::size_t>(model.coordinate_count);
  for (const MotionSample& sample : random_samples(model.coordinate_count, samples, 12)) {
    NumericRobot robot = numeric_robot(values);
    if (options.payload) robot = with_payload(robot, sample);
    const std::vector<double> C = evaluated.call("coriolis_matrix", sample);
    errors.christoffel.add(C, christoffel_matrix(values, robot, sample));
    const std::vector<long double> rate = mass_matrix_rate(values, robot, sample);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        errors.skew.add(C[i * n + j] + C[j * n + i], rate[i * n + j]);
      }
    }
    const std::vector<double> c = judge(values, robot, "coriolis", sample);
    for (const std::string& function : kMatrices) {
      const std::vector<double> matrix = evaluated.call(function, sample);
      for (std::size_t i = 0; i < n; ++i) {
        double product = 0;
        for (std::size_t j = 0; j < n; ++j) product += matrix[i * n + j] * sample.dq[j];
        errors.torque.add(product, c[i]);
      }
    }
  }
  return errors;
}

void expect_small(const CoriolisErrors& errors, const std::string& name) {
  EXPECT_LT(errors.christoffel.value(), kTolerance) << name;
  EXPECT_LT(errors.skew.value(), kTolerance) << name;
  EXPECT_LT(errors.torque.value(), kTolerance) << name;
}

class CoriolisMatrix : public testing::TestWithParam<std::string> {};

TEST_P(CoriolisMatrix, IsThatOfTheChristoffelSymbols) {
  const RobotModel model = read_model(GetParam());
  for (const GeneratorOptions& options : every_mode()) {
    expect_small(coriolis_errors(model, with_random_values(model, 4), options, 5), GetParam());
  }
}

TEST_P(CoriolisMatrix, OfUnknownParametersToo) {
  const RobotModel model = with_unknown_parameters(read_model(GetParam()), false);
  expect_small(coriolis_errors(model, with_random_values(model, 5), {}, 5), GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Robots, CoriolisMatrix,
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

TEST(CoriolisMatrixOfRandomRobots, WithAPayloadIsThatOfTheChristoffelSymbols) {
  std::vector<NamedRobot> robots = random_chains();
  const std::vector<NamedRobot> trees = random_trees();
  robots.insert(robots.end(), trees.begin(), trees.end());
  for (const auto& [name, robot] : robots) {
    const RobotModel values = robot_model(robot);
    RobotModel model = values;
    for (JointModel& joint : model.joints) joint.d.unknown = joint.r.unknown = name.size() % 2 == 0;
    GeneratorOptions options = every_mode()[name.size() % 4];
    options.payload = true;
    expect_small(coriolis_errors(model, values, options, 3), name);
  }
}

/// What the documents say of the other matrix: its column j reads no rate beyond joint j, and it is
/// not that of the Christoffel symbols.
TEST(FastCoriolisMatrix, ReadsNoRatesBeyondItsColumnAndIsNotSkew) {
  const RobotModel model = read_model("robots/puma560.robot");
  GeneratorOptions options;
  options.functions = kMatrices;
  const EvaluatedModel evaluated(model, options);
  const auto n = static_cast<std::size_t>(model.coordinate_count);
  RelativeError skew;
  for (const MotionSample& sample : random_samples(model.coordinate_count, 5, 2)) {
    const std::vector<double> C = evaluated.call("coriolis_matrix_fast", sample);
    const std::vector<long double> rate = mass_matrix_rate(model, numeric_robot(model), sample);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        skew.add(C[i * n + j] + C[j * n + i], rate[i * n + j]);
      }
    }
    for (std::size_t j = 0; j + 1 < n; ++j) {
      MotionSample other = sample;
      for (std::size_t k = j + 1; k < n; ++k) other.dq[k] += 1.0;
      const std::vector<double> changed = evaluated.call("coriolis_matrix_fast", other);
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(C[i * n + j], changed[i * n + j]) << i << j;
    }
  }
  EXPECT_GT(skew.value(), 0.1);
}

TEST(FastCoriolisMatrix, TakesFewerOperations) {
  for (const char* robot : {"robots/puma560.robot", "robots/panda.robot", "robots/ur10e.robot",
                            "robots/sarcos_grla.robot", "robots/kuka_iiwa14.robot"}) {
    const RobotModel model = with_unknown_parameters(read_model(robot), false);
    GeneratorOptions options;
    options.functions = kMatrices;
    const EvaluatedModel evaluated(model, with_random_values(model, 1), options);
    EXPECT_LT(evaluated.count("coriolis_matrix_fast").total(),
              evaluated.count("coriolis_matrix").total())
        << robot;
  }
}

TEST(CoriolisMatrixOfRandomRobots, ComparisonFailsOnAWrongModel) {
  const RobotModel model = read_model("robots/puma560.robot");
  RobotModel wrong = model;
  wrong.joints[2].chi[index(Chi::kXX)].value += GiNaC::numeric(1, 1000000);
  GeneratorOptions options;
  options.functions = kMatrices;
  const EvaluatedModel evaluated(wrong, options);
  RelativeError error;
  for (const MotionSample& sample : random_samples(model.coordinate_count, 3, 1)) {
    error.add(evaluated.call("coriolis_matrix", sample),
              christoffel_matrix(model, numeric_robot(model), sample));
  }
  EXPECT_GT(error.value(), kTolerance);
}

#ifdef DYNGEN_WITH_RAPIDCHECK
RC_GTEST_PROP(CoriolisMatrixOfRandomRobots, IsThatOfTheChristoffelSymbols, ()) {
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
  const CoriolisErrors errors = coriolis_errors(model, values, modes[mode], 3);
  RC_ASSERT(errors.christoffel.value() < kTolerance);
  RC_ASSERT(errors.skew.value() < kTolerance);
  RC_ASSERT(errors.torque.value() < kTolerance);
}
#endif

}  // namespace
}  // namespace dyngen::test::coriolis_matrix_tests

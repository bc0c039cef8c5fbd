// SPDX-License-Identifier: MIT
// The mass matrix of every robot file and of random trees, in every mode, against the judge and the
// oracles; what physics asks of it; how few operations it takes.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/model_bridge.h"
#include "tests/support/oracle_data.h"
#include "tests/support/physical_robot.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::mass_matrix_tests {
namespace {

// Double against double, some 300 operations.
constexpr double kTolerance = 1e-10;

Eigen::MatrixXd square(const std::vector<double>& values) {
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(values.size())));
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), n, n);
}

class MassMatrixOfFile : public testing::TestWithParam<std::string> {};

TEST_P(MassMatrixOfFile, IsTheJudges) {
  const RobotModel model = read_model(GetParam());
  const RobotModel values = with_random_values(model, 3);
  const NumericRobot numbers = numeric_robot(values);
  for (const GeneratorOptions& options : every_mode({"mass_matrix"})) {
    const EvaluatedModel evaluated(model, values, options);
    RelativeError error;
    for (const MotionSample& sample : random_samples(model.coordinate_count, 20, 5)) {
      error.add(evaluated.call("mass_matrix", sample),
                judge(values, numbers, "mass_matrix", sample));
    }
    EXPECT_LT(error.value(), kTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, MassMatrixOfFile,
                         testing::Values("robots/kuka_iiwa14.robot", "robots/panda.robot",
                                         "robots/planar2r.robot", "robots/puma560.robot",
                                         "robots/puma560_3dof.robot", "robots/rx90.robot",
                                         "robots/sarcos_grla.robot", "robots/scara.robot",
                                         "robots/stanford.robot", "robots/tx40.robot",
                                         "robots/ur10e.robot", "tests/robots/flip3r.robot",
                                         "tests/robots/odd_angles.robot", "tests/robots/rp.robot",
                                         "tests/robots/puma560_corke_std.robot"),
                         [](const auto& path) {
                           const std::size_t begin = path.param.rfind('/') + 1;
                           return path.param.substr(begin, path.param.rfind('.') - begin);
                         });

TEST(MassMatrix, IsTheOraclesWithRotorsOnTheDiagonal) {
  for (const std::string& name : oracle_names()) {
    const Oracle oracle = load_oracle(name);
    const RobotModel model = robot_model(oracle.robot, name);
    for (const GeneratorOptions& options : every_mode({"mass_matrix"})) {
      const EvaluatedModel evaluated(model, options);
      RelativeError error;
      for (const OracleState& state : oracle.states) {
        std::vector<double> expected = state.M;
        const std::size_t n = state.q.size();
        for (std::size_t j = 0; j < n; ++j) expected[j * n + j] += oracle.robot.joints[j].IA;
        MotionSample sample;
        sample.q = state.q;
        error.add(evaluated.call("mass_matrix", sample), expected);
      }
      EXPECT_LT(error.value(), kTolerance) << name;
    }
  }
}

TEST(MassMatrix, IsSymmetricAndPositiveDefiniteForRealLinks) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const NumericRobot numbers = physical_robot(seed, 3 + static_cast<int>(seed) % 6);
    const RobotModel model = robot_model(numbers);
    for (const GeneratorOptions& options : every_mode({"mass_matrix"})) {
      const EvaluatedModel evaluated(model, options);
      for (const MotionSample& sample : random_samples(model.coordinate_count, 10, seed)) {
        const Eigen::MatrixXd M = square(evaluated.call("mass_matrix", sample));
        EXPECT_EQ(M, M.transpose());
        EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(M).info(), Eigen::Success) << "seed " << seed;
      }
    }
  }
}

TEST(MassMatrix, TimesAccelerationIsWhatInverseDynamicsAdds) {
  for (unsigned seed = 21; seed <= 32; ++seed) {
    const RobotModel model = robot_model(physical_robot(seed, 3 + static_cast<int>(seed) % 6));
    for (const GeneratorOptions& options :
         every_mode({"id", "gravity", "coriolis", "friction", "mass_matrix"})) {
      const EvaluatedModel evaluated(model, options);
      RelativeError error;
      for (const MotionSample& sample : random_samples(model.coordinate_count, 10, seed)) {
        const Eigen::MatrixXd M = square(evaluated.call("mass_matrix", sample));
        const auto n = static_cast<Eigen::Index>(sample.q.size());
        Eigen::VectorXd torque = M * Eigen::Map<const Eigen::VectorXd>(sample.ddq.data(), n);
        for (const char* part : {"gravity", "coriolis", "friction"}) {
          torque += Eigen::Map<const Eigen::VectorXd>(evaluated.call(part, sample).data(), n);
        }
        error.add(std::vector<double>(torque.begin(), torque.end()), evaluated.call("id", sample));
      }
      EXPECT_LT(error.value(), kTolerance) << "seed " << seed;
    }
  }
}

/// Multiplications and additions, all ten inertial parameters of every link unknown, no rotor.
struct Limit {
  std::string path;
  int operations;
};

class MassMatrixCount : public testing::TestWithParam<Limit> {};

TEST_P(MassMatrixCount, IsWithinTheLimit) {
  const RobotModel model = with_unknown_parameters(read_model(GetParam().path), true);
  GeneratorOptions options;
  options.functions = {"mass_matrix"};
  options.parameters = ParameterMode::kRuntime;
  CodeModel code = make_code_model(model, options);
  EXPECT_LE(write_functions(code, options)[0].trace.count().total(), GetParam().operations);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, MassMatrixCount,
    testing::Values(Limit{"robots/puma560.robot", 235}, Limit{"robots/rx90.robot", 197},
                    Limit{"robots/ur10e.robot", 205}, Limit{"robots/panda.robot", 323}),
    [](const auto& limit) {
      const std::size_t begin = limit.param.path.rfind('/') + 1;
      return limit.param.path.substr(begin, limit.param.path.rfind('.') - begin);
    });

}  // namespace
}  // namespace dyngen::test::mass_matrix_tests

// SPDX-License-Identifier: MIT
// Generated functions against numbers from an independent route (tests/data/oracles).
#include <gtest/gtest.h>

#include "tests/support/model_bridge.h"
#include "tests/support/oracle_data.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::oracle_tests {
namespace {

// The oracles are good to 1e-14 of the largest torque; double arithmetic of some 600 operations
// loses a few digits more. 1e-10 is what the project promises.
constexpr double kTolerance = 1e-10;

struct Errors {
  double id, gravity, coriolis;
};

const std::vector<std::string> kFunctions = {"id", "gravity", "coriolis"};

GeneratorOptions usual_options() {
  GeneratorOptions options;
  options.functions = kFunctions;
  return options;
}

Errors errors_against(const Oracle& oracle, const EvaluatedModel& model) {
  RelativeError id, gravity, coriolis;
  for (const OracleState& state : oracle.states) {
    const MotionSample sample{state.q, state.dq, state.ddq};
    id.add(model.call("id", sample), state.tau);
    gravity.add(model.call("gravity", sample), state.g);
    coriolis.add(model.call("coriolis", sample), state.c);
  }
  return {id.value(), gravity.value(), coriolis.value()};
}

void expect_small(const Errors& errors, const std::string& what) {
  EXPECT_LT(errors.id, kTolerance) << what;
  EXPECT_LT(errors.gravity, kTolerance) << what;
  EXPECT_LT(errors.coriolis, kTolerance) << what;
}

struct RobotOfOracle {
  std::string oracle;
  std::string path;
};

class OracleRobot : public testing::TestWithParam<RobotOfOracle> {};

TEST_P(OracleRobot, FileGivesTheOraclesTorques) {
  const Oracle oracle = load_oracle(GetParam().oracle);
  const RobotModel model = read_model(GetParam().path);
  for (const GeneratorOptions& options : every_mode(kFunctions)) {
    expect_small(errors_against(oracle, EvaluatedModel(model, options)), GetParam().path);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, OracleRobot,
    testing::Values(RobotOfOracle{"planar2r", "robots/planar2r.robot"},
                    RobotOfOracle{"rp", "tests/robots/rp.robot"},
                    RobotOfOracle{"scara_rrpr", "robots/scara.robot"},
                    RobotOfOracle{"stanford", "robots/stanford.robot"},
                    RobotOfOracle{"rx90", "robots/rx90.robot"},
                    RobotOfOracle{"ur10e", "tests/robots/ur10e_oracle.robot"},
                    RobotOfOracle{"panda7", "tests/robots/panda7_oracle.robot"},
                    RobotOfOracle{"puma560_akb_mdh", "robots/puma560.robot"},
                    RobotOfOracle{"puma560_corke_std", "tests/robots/puma560_corke_std.robot"}),
    [](const auto& robot) { return robot.param.oracle; });

TEST(OracleRobot, StandardFramesGiveTheSameTorques) {
  for (const std::string& name : oracle_names()) {
    const Oracle oracle = load_oracle(name);
    if (!oracle.standard) continue;
    for (const GeneratorOptions& options : every_mode(kFunctions)) {
      const EvaluatedModel model(robot_model(*oracle.standard, name), options);
      expect_small(errors_against(oracle, model), name + " in standard frames");
    }
  }
}

TEST(OracleRobot, ComparisonFailsOnAWrongParameter) {
  const Oracle oracle = load_oracle("rx90");
  NumericRobot wrong = oracle.robot;
  wrong.joints[2].inertial[6] *= 1 + 1e-6;  // MX3
  const Errors errors = errors_against(oracle, EvaluatedModel(robot_model(wrong), usual_options()));
  EXPECT_GT(errors.id, kTolerance);
  EXPECT_GT(errors.gravity, kTolerance);
  EXPECT_GT(errors.coriolis, kTolerance);
}

TEST(OracleRobot, ComparisonFailsOnTheWrongConvention) {
  const Oracle oracle = load_oracle("puma560_corke_std");
  NumericRobot wrong = oracle.robot;
  wrong.standard = !wrong.standard;
  EXPECT_GT(errors_against(oracle, EvaluatedModel(robot_model(wrong), usual_options())).id, 1e-3);
}

TEST(Sarcos, GravityIsTheThesisListings) {
  const RobotModel robot = read_model("robots/sarcos_grla.robot");
  const Table table = load_sarcos_gravity();
  for (const GeneratorOptions& options : every_mode({"gravity"})) {
    const EvaluatedModel model(robot, options);
    RelativeError error;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const std::vector<double> zero(7, 0.0);
      const MotionSample sample{table.slice(row, "q1", 7), zero, zero};
      error.add(model.call("gravity", sample), table.slice(row, "g1", 7));
    }
    EXPECT_LT(error.value(), 1e-9);
  }
}

TEST(Puma3, TorqueIsTheThesisRegressorTimesTable71) {
  const EvaluatedModel model(read_model("robots/puma560_3dof.robot"), usual_options());
  const Table table = load_puma3_regressor();
  const NamedValues beta = load_table_7_1();
  RelativeError error;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const MotionSample sample{table.slice(row, "q1", 3), table.slice(row, "qd1", 3),
                              table.slice(row, "qdd1", 3)};
    std::vector<double> torque;
    for (int joint = 1; joint <= 3; ++joint) {
      const std::string first = "Y" + std::to_string(joint) + "_" + beta.names[0];
      const std::vector<double> columns = table.slice(row, first, beta.names.size());
      double sum = 0;
      for (std::size_t k = 0; k < columns.size(); ++k) sum += columns[k] * beta.values[k];
      torque.push_back(sum);
    }
    error.add(model.call("id", sample), torque);
  }
  EXPECT_LT(error.value(), kTolerance);
}

}  // namespace
}  // namespace dyngen::test::oracle_tests

// SPDX-License-Identifier: MIT
// The regressors: linear in the parameters, and column by column what one parameter does.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/oracle_data.h"
#include "tests/support/relative_error.h"

#ifdef DYNGEN_WITH_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_robot.h"
#endif

namespace dyngen::test::regressor_tests {
namespace {

// What the project promises; rounding of a long chain in double stays some digits below.
constexpr double kTolerance = 1e-10;

const std::vector<std::string> kFunctions = {"id", "gravity", "regressor", "base_regressor",
                                             "gravity_regressor"};

/// Y times a vector: its first entries for the columns that there are.
std::vector<double> times(const std::vector<double>& Y, const std::vector<double>& chi, int joints,
                          std::size_t columns) {
  std::vector<double> tau(static_cast<std::size_t>(joints), 0.0);
  for (std::size_t i = 0; i < tau.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) tau[i] += Y.at(i * columns + k) * chi.at(k);
  }
  return tau;
}

struct Mode {
  ParameterMode parameters;
  bool regroup;
};
std::vector<Mode> all_modes() {
  return {{ParameterMode::kBaked, true},
          {ParameterMode::kBaked, false},
          {ParameterMode::kRuntime, true},
          {ParameterMode::kRuntime, false}};
}

GeneratorOptions options_of(const Mode& mode) {
  GeneratorOptions options;
  options.functions = kFunctions;
  options.parameters = mode.parameters;
  options.regroup = mode.regroup;
  return options;
}

/// Base parameters of the model with these numbers: chi of the regrouped code.
std::vector<double> base_parameters(const RobotModel& model, const RobotModel& values) {
  GeneratorOptions options;
  options.functions = {"friction"};
  return EvaluatedModel(model, values, options).chi();
}

/// The largest error of Y chi, Y beta against id, and of the gravity regressor, over the modes.
/// @param numbers  of the judge
double product_error(const RobotModel& model, const RobotModel& values, const NumericRobot& numbers,
                     int samples, const std::vector<Mode>& modes = all_modes()) {
  const std::vector<double> beta = base_parameters(model, values);
  RelativeError dynamics, gravity;
  dynamics.add(1.0, 1.0);  // a robot without any torque is judged against 1 N m
  gravity.add(1.0, 1.0);
  const int n = model.coordinate_count;
  for (const Mode& mode : modes) {
    const EvaluatedModel code(model, values, options_of(mode));
    const std::size_t nbeta = code.code().beta.size();
    for (const MotionSample& sample : random_samples(n, samples, 11)) {
      const std::vector<double> tau = judge(values, numbers, "id", sample);
      dynamics.add(times(code.call("regressor", sample), code.chi(), n, code.chi().size()), tau);
      dynamics.add(times(code.call("base_regressor", sample), beta, n, nbeta), tau);
      gravity.add(times(code.call("gravity_regressor", sample), beta, n, nbeta),
                  judge(values, numbers, "gravity", sample));
    }
  }
  return std::max(dynamics.value(), gravity.value());
}

class RegressorOfFile : public testing::TestWithParam<std::string> {
 protected:
  RobotModel model_ = read_model(GetParam());
  RobotModel values_ = with_random_values(model_, 3);
};

TEST_P(RegressorOfFile, TimesParametersIsTheTorque) {
  EXPECT_LT(product_error(model_, values_, numeric_robot(values_), 20), kTolerance);
}

TEST_P(RegressorOfFile, AllParametersUnknown) {
  const RobotModel unknown = with_unknown_parameters(model_, false);
  const RobotModel values = with_random_values(unknown, 4);
  EXPECT_LT(product_error(unknown, values, numeric_robot(values), 20), kTolerance);
}

TEST_P(RegressorOfFile, LengthsOfTheRunTime) {
  RobotModel symbolic = model_;
  for (JointModel& joint : symbolic.joints) {
    if (!joint.d.known_zero()) joint.d.unknown = true;
    joint.r.unknown = true;
  }
  symbolic.gravity[2].unknown = true;
  EXPECT_LT(product_error(symbolic, values_, numeric_robot(values_), 5), kTolerance);
}

// The axis of joint 8 is along those of joints 5 and 6 in every position, across a slide.
TEST(Regressor, AxesAlongTheLastOneKeepTheirColumns) {
  const RobotModel model = parse_model(
      "name along\nnumber_link 8\nsigma 0 0 0 0 0 0 1 0\n"
      "al pi/3 -pi/2 0 pi/3 pi/3 0 pi/2 pi/2\nth pi/3 0 0 pi/3 0 0 0 0\n"
      "d -0.489 0.44 0 0.027 0.292 0 0 -0.431\nr -0.119 0.427 0.144 0 0 -0.792 0 -0.473\n"
      "XX 0 -1.06 -1.002 0 0 0 0 0.918\nXY -0.135 0 0 -1.636 0 0 -1.452 0\n"
      "XZ 0 0 0 -0.92 1.098 0 0 0\nYY 0 -0.994 0 0 0 -0.062 -1.612 0\n"
      "YZ -0.176 -0.21 0 0 0.615 0.499 0 0\nZZ 0.611 0 -0.869 0 0 0.605 0 -1.734\n"
      "mX 0 0 0 0 0 0.048 -1.987 -0.299\nmY 0.913 0 0.834 0.571 -0.363 0 0 -1.855\n"
      "mZ -1.223 -0.731 -1.006 -0.841 0 0 0 0\nm 0.652 0 0 0 0 0 0 1.621\n"
      "IA 0 0 0 0.175 0 0 0.154 0\ngz 0\nstop\n");
  EXPECT_LT(product_error(model, model, numeric_robot(model), 5), kTolerance);
}

/// The judge's torque of one parameter alone; with gravity, without other links.
std::vector<double> unit_torque(const RobotModel& model, NumericRobot robot, const Column& column,
                                const MotionSample& sample) {
  for (NumericJoint& joint : robot.joints) {
    joint.inertial.fill(0.0);
    joint.IA = joint.Fs = joint.Fv = joint.off = 0;
  }
  NumericJoint& own = robot.joints[static_cast<std::size_t>(column.link - 1)];
  if (index(column.kind) < kInertialCount) own.inertial[index(column.kind)] = 1;
  if (column.kind == Chi::kIA) own.IA = 1;
  if (column.kind == Chi::kFS) own.Fs = 1;
  if (column.kind == Chi::kFV) own.Fv = 1;
  if (column.kind == Chi::kOFF) own.off = 1;
  return judge(model, robot, "id", sample);
}

/// One column of a row-major matrix.
std::vector<double> column_of(const std::vector<double>& Y, std::size_t column,
                              std::size_t columns) {
  std::vector<double> result;
  for (std::size_t k = column; k < Y.size(); k += columns) result.push_back(Y[k]);
  return result;
}

/// Of files in modified frames: with others the columns belong to the internal frames.
class ColumnsOfFile : public RegressorOfFile {};

TEST_P(ColumnsOfFile, AreTheTorquesOfOneParameter) {
  RobotModel unknown = with_unknown_parameters(model_, false);
  for (JointModel& joint : unknown.joints) {
    joint.chi[index(Chi::kOFF)].unknown = joint.coordinate >= 0;
  }
  const RobotModel values = with_random_values(unknown, 4);
  const NumericRobot numbers = numeric_robot(values);
  for (const bool regroup : {true, false}) {
    const EvaluatedModel code(unknown, values, options_of({ParameterMode::kBaked, regroup}));
    const std::size_t nchi = code.code().chi.size(), nbeta = code.code().beta.size();
    RelativeError error;
    for (const MotionSample& sample : random_samples(model_.coordinate_count, 5, 12)) {
      const auto Y = code.call("regressor", sample), base = code.call("base_regressor", sample);
      for (std::size_t k = 0; k < code.code().chi_columns.size(); ++k) {
        const Column& column = code.code().chi_columns[k];
        error.add(column_of(Y, k, nchi), unit_torque(model_, numbers, column, sample));
      }
      for (std::size_t k = 0; k < nbeta; ++k) {
        const Column& column = code.code().beta_columns[k];
        error.add(column_of(base, k, nbeta), unit_torque(model_, numbers, column, sample));
      }
    }
    EXPECT_LT(error.value(), kTolerance) << (regroup ? "regrouped" : "standard");
  }
}

TEST_P(RegressorOfFile, GravityColumnsAreThoseAtRest) {
  const RobotModel unknown = with_unknown_parameters(model_, false);
  const RobotModel values = with_random_values(unknown, 4);
  const EvaluatedModel code(unknown, values, options_of({ParameterMode::kRuntime, true}));
  RelativeError error;
  error.add(1.0, 1.0);
  for (MotionSample sample : random_samples(model_.coordinate_count, 10, 13)) {
    std::fill(sample.dq.begin(), sample.dq.end(), 0.0);
    std::fill(sample.ddq.begin(), sample.ddq.end(), 0.0);
    error.add(code.call("gravity_regressor", sample), code.call("base_regressor", sample));
  }
  EXPECT_LT(error.value(), kTolerance);
}

std::string name_of(const testing::TestParamInfo<std::string>& robot) {
  const std::string name = robot.param.substr(robot.param.rfind('/') + 1);
  return name.substr(0, name.find('.'));
}

INSTANTIATE_TEST_SUITE_P(Robots, ColumnsOfFile,
                         testing::Values("robots/panda.robot", "robots/puma560.robot",
                                         "robots/scara.robot", "robots/stanford.robot",
                                         "robots/ur10e.robot", "tests/robots/rp.robot",
                                         "tests/robots/odd_angles.robot"),
                         name_of);

INSTANTIATE_TEST_SUITE_P(
    Robots, RegressorOfFile,
    testing::Values("robots/kuka_iiwa14.robot", "robots/panda.robot", "robots/planar2r.robot",
                    "robots/puma560.robot", "robots/puma560_3dof.robot", "robots/rx90.robot",
                    "robots/sarcos_grla.robot", "robots/scara.robot", "robots/stanford.robot",
                    "robots/tx40.robot", "robots/ur10e.robot", "tests/robots/rp.robot",
                    "tests/robots/odd_angles.robot", "tests/robots/puma560_corke_std.robot"),
    name_of);

TEST(Regressor, ComparisonFailsOnAWrongParameter) {
  const RobotModel model = read_model("robots/puma560.robot");
  NumericRobot wrong = numeric_robot(model);
  wrong.joints[3].inertial[4] += 1e-6;  // YZ4, kg m^2
  EXPECT_GT(product_error(model, model, wrong, 5), kTolerance);
}

TEST(Regressor, ColumnsAreTheThesissOfThePuma) {
  const EvaluatedModel code(read_model("robots/puma560_3dof.robot"), GeneratorOptions{});
  const Table table = load_puma3_regressor();
  const std::size_t nbeta = code.code().beta.size();
  RelativeError error;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const MotionSample sample{.q = table.slice(row, "q1", 3),
                              .dq = table.slice(row, "qd1", 3),
                              .ddq = table.slice(row, "qdd1", 3)};
    const std::vector<double> Y = code.call("base_regressor", sample);
    for (std::size_t k = 0; k < nbeta; ++k) {
      const Column& column = code.code().beta_columns[k];
      for (std::size_t joint = 0; joint < 3; ++joint) {
        const std::string name =
            "Y" + std::to_string(joint + 1) + "_" + chi_name(column.kind, column.link);
        error.add(Y[joint * nbeta + k], table.slice(row, name, 1)[0]);
      }
    }
  }
  EXPECT_EQ(nbeta, 15U);
  EXPECT_LT(error.value(), kTolerance);
}

struct Limit {
  std::string robot;
  int base_regressor, gravity_regressor, energy_regressor;
};

/// Rigid bodies, all ten inertial parameters of every link unknown.
TEST(Regressor, OperationCountsStayBelowTheirLimits) {
  const Limit limits[] = {{"puma560", 631, 43, 155},
                          {"rx90", 575, 43, 140},
                          {"ur10e", 522, 27, 146},
                          {"panda", 1042, 98, 186}};
  for (const Limit& limit : limits) {
    const RobotModel model =
        with_unknown_parameters(read_model("robots/" + limit.robot + ".robot"), true);
    GeneratorOptions options;
    options.parameters = ParameterMode::kRuntime;
    options.functions = {"base_regressor", "gravity_regressor", "energy_regressor"};
    const EvaluatedModel code(model, with_random_values(model, 1), options);
    EXPECT_LE(code.count("base_regressor").total(), limit.base_regressor) << limit.robot;
    EXPECT_LE(code.count("gravity_regressor").total(), limit.gravity_regressor) << limit.robot;
    EXPECT_LE(code.count("energy_regressor").total(), limit.energy_regressor) << limit.robot;
  }
}

#ifdef DYNGEN_WITH_RAPIDCHECK
RC_GTEST_PROP(RegressorOfRandomRobot, TimesParametersIsTheTorque, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel model = robot_model(numbers);
  const Mode mode = *rc::gen::elementOf(all_modes());
  RC_ASSERT(product_error(model, model, numbers, 3, {mode}) < kTolerance);
}

RC_GTEST_PROP(RegressorOfRandomRobot, LengthsOfTheRunTime, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel values = robot_model(numbers);
  RobotModel symbolic = values;
  for (JointModel& joint : symbolic.joints) {
    joint.d.unknown = *rc::gen::arbitrary<bool>();
    joint.r.unknown = *rc::gen::arbitrary<bool>();
  }
  const Mode mode = *rc::gen::elementOf(all_modes());
  RC_ASSERT(product_error(symbolic, values, numbers, 3, {mode}) < kTolerance);
}
#endif

}  // namespace
}  // namespace dyngen::test::regressor_tests

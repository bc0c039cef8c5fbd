// SPDX-License-Identifier: MIT
// The energy model: H beta is the energy, and what the motors do is stored in it or lost as P beta.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

#ifdef DYNGEN_WITH_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/support/random_robot.h"
#endif

namespace dyngen::test::energy_tests {
namespace {

constexpr double kTolerance = 1e-10;

/// Kinetic and potential energy from the judge's mass matrix and forward kinematics.
double judge_energy(const RobotModel& model, const NumericRobot& robot,
                    const MotionSample& sample) {
  const std::vector<double> q = per_joint(model, sample.q), dq = per_joint(model, sample.dq);
  const auto M = mass_matrix(robot, q);
  const auto frames = forward_kinematics(robot, q);
  double energy = 0;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    for (std::size_t j = 0; j < robot.size(); ++j) {
      energy += dq[i] * M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * dq[j] / 2;
    }
    const auto& inertial = robot.joints[i].inertial;
    const Eigen::Vector4d moment(inertial[6], inertial[7], inertial[8], inertial[9]);
    const Eigen::Vector4d in_base = frames[i] * moment;
    for (int k = 0; k < 3; ++k) {
      energy += robot.base_acceleration[static_cast<std::size_t>(k)] * in_base[k];
    }
  }
  return energy;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b.at(k);
  return sum;
}

/// The energy functions of one robot and its base parameters.
class EnergyModel {
 public:
  EnergyModel(const RobotModel& model, const RobotModel& values, const GeneratorOptions& options)
      : code_(model, values, with_functions(options)) {
    GeneratorOptions regrouped = options;
    regrouped.functions = {"friction"};  // chi is the same for all functions
    regrouped.regroup = true;
    beta_ = options.regroup ? code_.chi() : EvaluatedModel(model, values, regrouped).chi();
  }

  [[nodiscard]] double energy(const MotionSample& sample) const {
    return dot(code_.call("energy_regressor", sample), beta_);
  }
  [[nodiscard]] double power(const MotionSample& sample) const {
    return dot(code_.call("power", sample), beta_);
  }

  /// d(H beta)/dt along q + dq t + ddq t^2 / 2, by central differences of eighth order.
  [[nodiscard]] double energy_rate(const MotionSample& sample, double step) const {
    constexpr double kWeights[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    double rate = 0;
    for (int k = 1; k <= 4; ++k) {
      rate += kWeights[k - 1] * (energy(at(sample, k * step)) - energy(at(sample, -k * step)));
    }
    return rate / step;
  }

 private:
  static GeneratorOptions with_functions(GeneratorOptions options) {
    options.functions = {"energy_regressor", "power"};
    return options;
  }
  static MotionSample at(MotionSample sample, double t) {
    for (std::size_t k = 0; k < sample.q.size(); ++k) {
      sample.q[k] += sample.dq[k] * t + sample.ddq[k] * t * t / 2;
      sample.dq[k] += sample.ddq[k] * t;
    }
    return sample;
  }

  EvaluatedModel code_;
  std::vector<double> beta_;
};

struct Errors {
  double energy, balance;
};

/// Energies against the judge's, less their difference at the first sample; the power balance
/// against the judge's torques.
Errors energy_errors(const RobotModel& model, const RobotModel& values, const NumericRobot& numbers,
                     const GeneratorOptions& options, int samples) {
  const EnergyModel energies(model, values, options);
  RelativeError energy, balance;
  energy.add(1.0, 1.0);  // a robot without any energy is judged against 1 J
  balance.add(1.0, 1.0);
  const std::vector<MotionSample> all = random_samples(model.coordinate_count, samples, 21);
  const double constant = energies.energy(all[0]) - judge_energy(values, numbers, all[0]);
  for (MotionSample sample : all) {
    energy.add(energies.energy(sample) - constant, judge_energy(values, numbers, sample));
    // Slow, so that the differences are exact: H changes with at most 2 x 12 joints x 0.3 rad/s =
    // 7 rad/s, where their error is (7 h)^8 / 630 = 4e-15 with h = 5 ms; rounding gives 1e-16 / h.
    for (double& rate : sample.dq) rate *= 0.1;
    for (double& rate : sample.ddq) rate *= 0.05;
    const double motors = dot(sample.dq, judge(values, numbers, "id", sample));
    balance.add(energies.energy_rate(sample, 0.005) + energies.power(sample), motors);
  }
  return {energy.value(), balance.value()};
}

class EnergyOfFile : public testing::TestWithParam<std::string> {
 protected:
  RobotModel model_ = read_model(GetParam());
  RobotModel values_ = with_random_values(model_, 3);

  void expect_small(const RobotModel& model, const RobotModel& values) {
    for (const GeneratorOptions& options : every_mode()) {
      const Errors errors = energy_errors(model, values, numeric_robot(values), options, 10);
      EXPECT_LT(errors.energy, kTolerance);
      EXPECT_LT(errors.balance, kTolerance);
    }
  }
};

TEST_P(EnergyOfFile, IsTheJudgesAndItsRateThePower) { expect_small(model_, values_); }

TEST_P(EnergyOfFile, AllParametersUnknown) {
  const RobotModel unknown = with_unknown_parameters(model_, false);
  expect_small(unknown, with_random_values(unknown, 4));
}

TEST_P(EnergyOfFile, LengthsOfTheRunTime) {
  RobotModel symbolic = model_;
  for (JointModel& joint : symbolic.joints) joint.d.unknown = joint.r.unknown = true;
  expect_small(symbolic, values_);
}

std::string name_of(const testing::TestParamInfo<std::string>& robot) {
  const std::string name = robot.param.substr(robot.param.rfind('/') + 1);
  return name.substr(0, name.find('.'));
}

INSTANTIATE_TEST_SUITE_P(Robots, EnergyOfFile,
                         testing::Values("robots/panda.robot", "robots/planar2r.robot",
                                         "robots/puma560.robot", "robots/rx90.robot",
                                         "robots/sarcos_grla.robot", "robots/scara.robot",
                                         "robots/stanford.robot", "robots/tx40.robot",
                                         "robots/ur10e.robot", "tests/robots/rp.robot",
                                         "tests/robots/odd_angles.robot",
                                         "tests/robots/puma560_corke_std.robot"),
                         name_of);

TEST(Energy, ComparisonFailsOnAWrongParameter) {
  const RobotModel model = read_model("robots/puma560.robot");
  NumericRobot wrong = numeric_robot(model);
  wrong.joints[2].inertial[6] += 1e-6;  // MX3, kg m
  const Errors errors = energy_errors(model, model, wrong, GeneratorOptions{}, 10);
  EXPECT_GT(errors.energy, kTolerance);
  EXPECT_GT(errors.balance, kTolerance);
}

TEST(Energy, ComparisonFailsOnWrongFriction) {
  const RobotModel model = read_model("robots/puma560.robot");
  NumericRobot wrong = numeric_robot(model);
  wrong.joints[2].Fs *= 1 + 1e-6;
  const Errors errors = energy_errors(model, model, wrong, GeneratorOptions{}, 10);
  EXPECT_LT(errors.energy, kTolerance);
  EXPECT_GT(errors.balance, kTolerance);
}

#ifdef DYNGEN_WITH_RAPIDCHECK
RC_GTEST_PROP(EnergyOfRandomRobot, IsTheJudgesAndItsRateThePower, ()) {
  const NumericRobot numbers = random_robot();
  const RobotModel model = robot_model(numbers);
  const GeneratorOptions options = *rc::gen::elementOf(every_mode());
  const Errors errors = energy_errors(model, model, numbers, options, 3);
  RC_ASSERT(errors.energy < kTolerance);
  RC_ASSERT(errors.balance < kTolerance);
}
#endif

}  // namespace
}  // namespace dyngen::test::energy_tests

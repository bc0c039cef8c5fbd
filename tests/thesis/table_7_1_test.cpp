// SPDX-License-Identifier: MIT
// Table 7.1 of the thesis: parameters of the 3-DOF Puma fitted to a full-order model of the arm.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <functional>
#include <random>

#include "gen/symbols/exact.h"
#include "tests/support/model_bridge.h"
#include "tests/support/oracle_data.h"

namespace dyngen::test {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kPoints = 200;

/// Torques of joints 1 to 3 of a full-order model with the wrist at zero, q in its own coordinates.
using FullOrderModel = std::function<std::vector<double>(const MotionSample&)>;

/// Motions whose second and third joint accelerate alike: those of the thesis's table.
MotionSample motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  MotionSample sample;
  for (int j = 0; j < 3; ++j) {
    sample.q.push_back(kPi * unit(random));
    sample.dq.push_back(2 * unit(random));
    sample.ddq.push_back(3 * unit(random));
  }
  sample.ddq[2] = sample.ddq[1];
  return sample;
}

/// Least squares with the generated regressor of the 3-DOF arm, whose zero position differs:
/// theta = theta_full + (pi, pi, -pi).
std::vector<double> fit(const FullOrderModel& full, const std::vector<std::string>& names) {
  GeneratorOptions options;
  options.functions = {"base_regressor"};
  const EvaluatedModel arm(read_model("robots/puma560_3dof.robot"), options);
  const auto& beta = arm.code().beta;
  const Eigen::Index columns = static_cast<Eigen::Index>(beta.size());
  Eigen::MatrixXd W(3 * kPoints, columns);
  Eigen::VectorXd tau(3 * kPoints);
  std::mt19937_64 random(71);
  for (Eigen::Index k = 0; k < kPoints; ++k) {
    const MotionSample own = motion(random);
    MotionSample shifted = own;
    shifted.q[0] += kPi;
    shifted.q[1] += kPi;
    shifted.q[2] -= kPi;
    const std::vector<double> Y = arm.call("base_regressor", shifted);
    const std::vector<double> torque = full(own);
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      tau[3 * k + joint] = torque[static_cast<std::size_t>(joint)];
      for (Eigen::Index c = 0; c < columns; ++c) {
        W(3 * k + joint, c) = Y[static_cast<std::size_t>(joint * columns + c)];
      }
    }
  }
  const Eigen::VectorXd solution = W.colPivHouseholderQr().solve(tau);
  std::vector<double> values;
  for (const std::string& name : names) {
    const auto place = std::find(beta.begin(), beta.end(), name);
    if (place == beta.end()) throw std::runtime_error("no base parameter " + name);
    values.push_back(solution[place - beta.begin()]);
  }
  return values;
}

/// The explicit model of Armstrong, Khatib and Burdick (1986) with theta 4..6 = 0: the terms of
/// M(q) and g(q) that are left of it, with their published constants.
class ExplicitPuma {
 public:
  ExplicitPuma() {
    using GiNaC::cos, GiNaC::sin, GiNaC::ex, GiNaC::numeric;
    const auto c = [](double value) { return ex(numeric(value)); };
    const ex S2 = sin(q_[1]), C2 = cos(q_[1]), S3 = sin(q_[2]), C3 = cos(q_[2]);
    const ex S23 = sin(q_[1] + q_[2]), C23 = cos(q_[1] + q_[2]);
    const ex I1 = c(1.43), I2 = c(1.75), I3 = c(1.38), I4 = c(0.69), I5 = c(0.372), I6 = c(0.333),
             I7 = c(0.298), I8 = c(-0.134), I9 = c(0.0238), I10 = c(-0.0213), I11 = c(-0.0142),
             I12 = c(-0.011), I13 = c(-0.00379), I15 = c(0.00125), I16 = c(0.00124),
             I18 = c(0.000431), I21 = c(-0.0001), I22 = c(-0.000058);
    const ex Im1 = c(1.14), Im2 = c(4.71), Im3 = c(0.827);
    M_[0][0] = Im1 + I1 + I3 * C2 * C2 + (I7 + I21 + 2 * I15) * S23 * S23 +
               (I10 + 2 * I22) * S23 * C23 + I11 * S2 * C2 +
               2 * ((I5 + I16) * C2 * S23 + I12 * C2 * C23);
    M_[0][1] = I4 * S2 + (I8 - I18) * C23 + I9 * C2 + I13 * S23;
    M_[0][2] = (I8 - I18) * C23 + I13 * S23;
    M_[1][1] = Im2 + I2 + I6 + 2 * ((I5 + I16) * S3 + I12 * C3 + I15);
    M_[1][2] = (I5 + I16) * S3 + I6 + I12 * C3 + 2 * I15;
    M_[2][2] = Im3 + I6 + 2 * I15;
    M_[1][0] = M_[0][1];
    M_[2][0] = M_[0][2];
    M_[2][1] = M_[1][2];
    gravity_[0] = 0;
    gravity_[2] = c(-8.44) * S23 + c(0.249) * C23 + c(-0.0282) * S23;
    gravity_[1] = c(-37.2) * C2 + c(1.02) * S2 + gravity_[2];
  }

  [[nodiscard]] std::vector<double> torque(const MotionSample& sample) const {
    GiNaC::exmap at;
    for (std::size_t j = 0; j < 3; ++j) at[q_[j]] = sample.q[j];
    std::vector<double> tau;
    for (std::size_t i = 0; i < 3; ++i) {
      GiNaC::ex sum = gravity_[i];
      for (std::size_t j = 0; j < 3; ++j) {
        sum += M_[i][j] * sample.ddq[j];
        for (std::size_t k = 0; k < 3; ++k) {  // Christoffel symbols
          const GiNaC::ex symbol = M_[i][j].diff(q_[k]) - M_[j][k].diff(q_[i]) / 2;
          sum += symbol * sample.dq[j] * sample.dq[k];
        }
      }
      tau.push_back(to_double(sum.subs(at).evalf()));
    }
    return tau;
  }

 private:
  std::array<GiNaC::symbol, 3> q_ = {GiNaC::symbol("q1"), GiNaC::symbol("q2"), GiNaC::symbol("q3")};
  std::array<std::array<GiNaC::ex, 3>, 3> M_;
  std::array<GiNaC::ex, 3> gravity_;
};

TEST(Table71, ComesOutOfTheExplicitModel) {
  const ExplicitPuma puma;
  const NamedValues table = load_table_7_1();
  const auto values =
      fit([&](const MotionSample& sample) { return puma.torque(sample); }, table.names);
  // four decimals are printed, of constants that have three digits
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], table.values[i], 1.2e-3) << table.names[i];
  }
}

TEST(Table71, ComesOutOfTheSixJointArmWhereItsLinkDataAgree) {
  const Oracle oracle = load_oracle("puma560_akb_mdh");
  NumericRobot robot = oracle.robot;
  for (std::size_t j = 0; j < 6; ++j) {
    robot.joints[j].Fs = robot.joints[j].Fv = 0;
    if (j >= 3) robot.joints[j].IA = 0;
  }
  GeneratorOptions options;
  options.functions = {"id"};
  const EvaluatedModel full(robot_model(robot), options);
  const NamedValues table = load_table_7_1();
  const auto values = fit(
      [&](const MotionSample& sample) {
        MotionSample six = sample;
        for (std::vector<double>* part : {&six.q, &six.dq, &six.ddq}) part->resize(6, 0.0);
        return full.call("id", six);
      },
      table.names);
  for (std::size_t i = 0; i < values.size(); ++i) {
    // the published I1 = 1.43 and I3 = 1.38 do not follow from the link data, which give 1.553 and
    // 1.602: ZZ1 and XX2 of the table came from the former
    if (table.names[i] == "ZZ1") {
      EXPECT_NEAR(values[i], 4.2951, 1e-4);
    } else if (table.names[i] == "XX2") {
      EXPECT_NEAR(values[i], -1.6019, 1e-4);
    } else {
      EXPECT_NEAR(values[i], table.values[i], 4e-3) << table.names[i];
    }
  }
}

}  // namespace
}  // namespace dyngen::test

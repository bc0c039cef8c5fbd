// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_signals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/effects/effect_rows.h"
#include "runtime/signals/differences.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

EffectRecordings recordings(MotionSource source, RowOptions options = {1, -1}) {
  return effect_recordings(test::planar_arm(), test::planar_arm_tangents(), {std::move(source)},
                           options);
}

MotionSource moving() {
  return test::measured({test::sines(5, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 1).front();
}

/// A law that only names variables.
EffectInstance reading(const std::vector<std::string>& variables, int joint, int other = -1) {
  EffectLaw law = test::algebraic_law("reader", variables, {},
                                      [](const VectorXd&, const VectorXd&) { return 0.0; });
  return test::unknown(law, joint, other);
}

TEST(EffectSignals, AreWhatTheirNamesSay) {
  const EffectRecordings data = recordings(moving());
  const VectorXd beta = test::planar_arm_values();
  EffectSignals signals(data);
  signals.set_beta(beta);
  const Motion& motion = data.runs[0].motion;
  const MatrixXd values = signals.variables(
      0,
      reading({"q", "qd", "qdd", "q_other", "qd_other", "qdd_other", "Fc", "Fv", "Ia", "torque",
               "tau_load", "torque_rate", "tau_load_acc", "t", "sign_qd"},
              1, 0),
      -1);
  EXPECT_EQ(values.col(0), motion.q.col(1));
  EXPECT_EQ(values.col(1), motion.dq.col(1));
  EXPECT_EQ(values.col(2), motion.ddq.col(1));
  EXPECT_EQ(values.col(3), motion.q.col(0));
  EXPECT_EQ(values.col(4), motion.dq.col(0));
  EXPECT_EQ(values.col(5), motion.ddq.col(0));
  EXPECT_EQ(values(7, 6), beta[8]);
  EXPECT_EQ(values(7, 7), beta[10]);
  EXPECT_EQ(values(7, 8), beta[6]);
  const MatrixXd torque = data.model.torque(motion.q, motion.dq, motion.ddq, beta);
  EXPECT_LT((values.col(9) - torque.col(1)).norm(), 1e-12 * torque.norm());
  VectorXd load_beta = beta;
  load_beta.tail(7).setZero();  // rotor, friction, offsets
  const MatrixXd load = data.model.torque(motion.q, motion.dq, motion.ddq, load_beta);
  EXPECT_LT((values.col(10) - load.col(1)).norm(), 1e-12 * load.norm());
  EXPECT_LT((values.col(11) - first_difference(torque.col(1), 0.01)).norm(), 1e-9);
  EXPECT_LT((values.col(12) - second_difference(load.col(1), 0.01)).norm(), 1e-7);
  EXPECT_NEAR(values(100, 13), 1.0, 1e-12);
  EXPECT_EQ(values(100, 14), motion.dq(100, 1) > 0 ? 1 : -1);
}

TEST(EffectSignals, TheDerivativeByTheModelIsThatOfFiniteDifferences) {
  const EffectRecordings data = recordings(moving());
  const VectorXd beta = test::planar_arm_values();
  const EffectLaw law = test::algebraic_law(
      "mixed", {"tau_load", "tau_load_other", "Fc", "Fv", "torque_rate", "qd"}, {},
      [](const VectorXd& v, const VectorXd&) {
        return v[0] * v[0] * 0.1 + 0.3 * v[1] + v[2] * v[5] - v[3] * 0.2 + 0.01 * v[4] * v[5];
      });
  const EffectInstance effect = test::unknown(law, 1, 0);
  EffectSignals signals(data);
  VectorXd no_state;
  const auto torque = [&](const VectorXd& at) -> VectorXd {
    signals.set_beta(at);
    return law.evaluate(signals.variables(0, effect, 1), VectorXd(), 0.01, no_state, {})
        .torque.col(0);
  };
  signals.set_beta(beta);
  const EffectTorque at = law.evaluate(signals.variables(0, effect, 1), VectorXd(), 0.01, no_state,
                                       {.by_variable = true});
  const ModelDerivative slope = signals.by_model(0, effect, 1, at.by_variable);
  for (int c = 0; c < data.model.size(); ++c) {
    VectorXd up = beta, down = beta;
    up[c] += 1e-4;
    down[c] -= 1e-4;
    const VectorXd expected = (torque(up) - torque(down)) / 2e-4;
    const auto place = std::find(slope.columns.begin(), slope.columns.end(), c);
    const VectorXd found = place == slope.columns.end()
                               ? VectorXd::Zero(expected.size()).eval()
                               : slope.values.col(place - slope.columns.begin()).eval();
    // derivatives of the hand-made law are differences too
    EXPECT_LT((found - expected).norm(), 1e-6 * (1 + expected.norm()))
        << data.model.parameters[static_cast<std::size_t>(c)].name;
  }
}

TEST(EffectSignals, ASignTurnsOnlyAfterAWay) {
  constexpr double kBand = 2.5e-3;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-1e-3, 1e-3);
  VectorXd q(600), dq(600);
  for (Index k = 0; k < 600; ++k) {
    // up, a long rest that trembles, down
    const double way = k < 200 ? 1e-3 * static_cast<double>(k)
                               : 0.2 - (k < 400 ? 0 : 1e-3 * static_cast<double>(k - 400));
    q[k] = way + jitter(random);
  }
  dq = first_difference(q, 1e-3);
  const VectorXd sign = travelled_sign(q, dq, kBand);
  int turns = 0;
  for (Index k = 1; k < 600; ++k) turns += sign[k] != sign[k - 1] ? 1 : 0;
  EXPECT_EQ(turns, 1);
  EXPECT_EQ(sign[0], 1);
  EXPECT_EQ(sign[390], 1);  // the trembling may have begun to go down a few samples before the way
  EXPECT_EQ(sign[410], -1);
  const VectorXd plain = travelled_sign(q, dq, 0);
  for (Index k = 0; k < 600; ++k) EXPECT_EQ(plain[k], dq[k] > 0 ? 1 : dq[k] < 0 ? -1 : 0);
}

TEST(EffectSignals, ASignTurnsWhereTheVelocityDoes) {
  // slow and exact: the band is only left a dozen samples after the turn
  VectorXd q(400), dq(400);
  for (Index k = 0; k < 400; ++k) {
    const double t = 1e-3 * (static_cast<double>(k) - 199.5);
    q[k] = -t * t;
    dq[k] = -2 * t;
  }
  const VectorXd sign = travelled_sign(q, dq, 1e-4);
  for (Index k = 0; k < 400; ++k) EXPECT_EQ(sign[k], k < 200 ? 1 : -1) << k;
}

TEST(EffectSignals, WhatARecordingLacksIsSaid) {
  const EffectRecordings data = recordings(moving());
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  EXPECT_THROW(signals.variables(0, reading({"temp"}, 0), -1), MissingSignalError);
  try {
    signals.variables(0, reading({"no_such"}, 0), -1);
    ADD_FAILURE() << "there is no such variable";
  } catch (const MissingSignalError&) {
    ADD_FAILURE() << "a name that no recording can have is the caller's error";
  } catch (const std::invalid_argument&) {
  }
  EffectRecordings without = data;
  without.robot.tangents = nullptr;
  EffectSignals bare(without);
  bare.set_beta(test::planar_arm_values());
  EXPECT_THROW(bare.variables(0, reading({"d_gx"}, 0), 0), MissingSignalError);
}

TEST(EffectSignals, ATemperatureOfEachJointIsFound) {
  Recording recording;
  const Motion motion = test::sines(5, 0.01);
  recording.time = motion.time;
  recording.q = motion.q;
  recording.dq = motion.dq;
  recording.ddq = motion.ddq;
  recording.tau = MatrixXd::Zero(motion.samples(), 2);
  recording.temperature = MatrixXd(motion.samples(), 2);
  recording.temperature << VectorXd::Constant(motion.samples(), 20),
      VectorXd::LinSpaced(motion.samples(), 25, 40);
  recording.run_starts = {0};
  MotionOptions options;
  options.state.method = StateMethod::kRecorded;
  options.average_periods = false;
  const EffectRecordings data = recordings(motion_of(recording, options));
  EffectSignals signals(data);
  signals.set_beta(test::planar_arm_values());
  EXPECT_EQ(signals.variables(0, reading({"temp"}, 1), -1), recording.temperature.col(1));
  EXPECT_NEAR(scales_of(data, test::planar_arm_values(), 1).temp_range, 15, 1e-9);
  EXPECT_EQ(scales_of(data, test::planar_arm_values(), 0).temp_range, 0);
}

TEST(EffectRows, AreThoseOfTheFilterThatRecordingsHave) {
  const MotionSource source = moving();
  const RowOptions options{4, 0.0};
  const EffectRecordings data = recordings(source, options);
  const LinearModel model = test::planar_arm();
  Index next = 0;
  rows_of(model, source, options)([&](const RowBlock& block) {
    EXPECT_EQ(data.runs[0].rows.Y.middleRows(next, block.Y.rows()), block.Y);
    EXPECT_EQ(data.runs[0].rows.tau.middleRows(next, block.Y.rows()), block.tau);
    next += block.Y.rows();
  });
  EXPECT_EQ(next, data.equations());
  EXPECT_GT(next, 50);
}

TEST(EffectRows, TheirJacobianIsThatOfFiniteDifferences) {
  const EffectRecordings data = recordings(moving(), {3, -1});
  EffectPoint point = at_rest(
      data, test::planar_arm_values(),
      {test::known(test::stribeck_law(), 0, {4.2, 0.11}),
       test::known(test::load_friction_law(), 1, {0.06}),
       test::known(test::slip_law(), 1, {40, 0.05}), test::known(test::lag_law(), -1, {0.006})});
  point.initial[0][2][0] = 0.01;
  EffectUnknowns unknowns = base_unknowns(point);
  for (auto& effect : unknowns.parameters) {
    for (int& place : effect) place = unknowns.size++;
  }
  unknowns.initial[0][2] = unknowns.size++;
  EffectSignals signals(data);
  const VectorXd x = values_of(point, unknowns);
  const auto rest = [&](const VectorXd& at) -> MatrixXd {
    const EffectPoint moved = with_values(point, unknowns, at);
    const EffectEquations equations = linearised(data, signals, moved, unknowns);
    return residual(equations.blocks[0], at);
  };
  const EffectEquations equations = linearised(data, signals, point, unknowns);
  const RowBlock& rows = equations.blocks[0];
  for (int c = 0; c < unknowns.size; ++c) {
    // where an element begins to slip is not smooth: a small step
    const double step = 1e-6 * std::max(1.0, std::abs(x[c]));
    VectorXd up = x, down = x;
    up[c] += step;
    down[c] -= step;
    const MatrixXd expected = (rest(down) - rest(up)) / (2 * step);
    for (Index j = 0; j < 2; ++j) {
      const VectorXd found = rows.Y.col(j * unknowns.size + c);
      EXPECT_LT((found - expected.col(j)).norm(), 2e-3 * (1e-3 + expected.col(j).norm()))
          << "unknown " << c << ", joint " << j + 1;
    }
  }
}

/// A joint whose torque is a sine of its position: what a shift of it makes of that, by the
/// derivative where the joint is and half way.
TEST(EffectSignals, DerivativesHalfWayAreRightToTheSecondOrder) {
  EffectRecordings data = recordings(moving());
  data.robot.tangents = [](const TangentKey& wanted, const JointMotion& motion,
                           const VectorXd& beta, double further) -> TangentColumns {
    MatrixXd torque = MatrixXd::Zero(motion.q.rows(), 2);
    torque.col(1) = beta[4] * (motion.q.col(1).array() + further).cos();
    return {{wanted, torque}};
  };
  EffectLaw law =
      test::algebraic_law("shift", {"d_q"}, {{"offset", EffectRole::kLinear, -0.5, 0.5, 0, 0.02}},
                          [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0]; });
  law.acts_on_all = true;
  EffectSignals signals(data);
  const VectorXd beta = test::planar_arm_values();
  signals.set_beta(beta);
  const VectorXd q = data.runs[0].motion.q.col(1);
  const auto error = [&](int midpoint, double offset) {
    law.midpoint = midpoint;
    EffectInstance shift = test::known(law, 1, {offset});
    shift.link = 2;
    const VectorXd torque = offset * signals.variables(0, shift, 1).col(0);
    const VectorXd exact = beta[4] * ((q.array() + offset).sin() - q.array().sin()).matrix();
    return (torque - exact).norm() / exact.norm();
  };
  for (const double offset : {0.3, -0.3, 0.1}) {
    EXPECT_GT(error(-1, offset), 0.2 * std::abs(offset)) << offset;
    EXPECT_LT(error(0, offset), offset * offset / 20) << offset;
  }
  EXPECT_LT(error(0, 1e-6), 1e-9);
}

}  // namespace
}  // namespace dyngen::runtime

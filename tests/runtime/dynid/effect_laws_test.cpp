// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gen/effect_file/effect_variables.h"
#include "tests/support/effect_names.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr unsigned kSeed = 20261121;
constexpr double kSampleTime = 1e-3;

/// Sizes of a joint of some industrial arm.
EffectScales usual_scales() {
  EffectScales scales;
  scales.Fc = 8;
  scales.Fv = 12;
  scales.Ia = 2;
  scales.v_max = 2;
  scales.v90 = 1.5;
  scales.q_range = 3;
  scales.tau_max = 100;
  scales.duration = 60;
  scales.position_step = 1e-5;
  scales.temp_range = 30;
  return scales;
}

/// A motion that reverses, with every variable as smooth as in reality.
MatrixXd motion_of(const EffectLaw& law, Index samples, double phase) {
  const EffectScales scales = usual_scales();
  const double w = 2 * std::numbers::pi / 0.08;
  MatrixXd variables(samples, static_cast<Index>(law.variables.size()));
  for (Index k = 0; k < samples; ++k) {
    const double t = kSampleTime * static_cast<double>(k);
    for (std::size_t v = 0; v < law.variables.size(); ++v) {
      const std::string& name = law.variables[v];
      const double shift = name.ends_with("_other") ? 1.1 : 0.0;
      const double q = 0.3 + 0.02 * std::sin(w * t + phase + shift);
      const double qd = 0.02 * w * std::cos(w * t + phase + shift);
      const double qdd = -w * w * (q - 0.3);
      double& value = variables(k, static_cast<Index>(v));
      if (name.starts_with("qdd")) {
        value = qdd;
      } else if (name.starts_with("qd")) {
        value = qd;
      } else if (name.starts_with("q")) {
        value = q;
      } else if (name == "sign_qd") {
        value = qd > 0 ? 1 : -1;
      } else if (name == "t") {
        value = 250 * t;  // so that windows open and close
      } else if (name == "temp") {
        value = 25 + 100 * t;
      } else if (name == "Fc") {
        value = scales.Fc;
      } else if (name == "Fv") {
        value = scales.Fv;
      } else if (name == "Ia") {
        value = scales.Ia;
      } else {
        // torques and derivatives of the rigid model: anything smooth that is not small
        value = 40 * std::cos(w / 3 * t + phase + static_cast<double>(v));
      }
    }
  }
  return variables;
}

/// Made once: the symbolic derivatives of a law take longer than most tests of it.
const EffectLaw& law_of(const std::string& name) {
  static const EffectCatalogue kCatalogue;
  static std::map<std::string, EffectLaw> laws;
  const auto found = laws.find(name);
  if (found != laws.end()) return found->second;
  return laws.emplace(name, effect_law(*kCatalogue.find(name))).first->second;
}

VectorXd still(const EffectLaw& law) {
  return VectorXd::Zero(static_cast<Index>(law.states.size()));
}

MatrixXd torque_of(const EffectLaw& law, const MatrixXd& motion, const VectorXd& parameters,
                   VectorXd state) {
  return law.evaluate(motion, parameters, kSampleTime, state, {}).torque;
}

class EveryEffect : public testing::TestWithParam<std::string> {
 protected:
  /// Typical sizes, none of them zero: a derivative at zero would say little.
  static VectorXd sizes(const EffectLaw& law) {
    const EffectSizes sizes = law.sizes(usual_scales());
    VectorXd parameters = sizes.typical;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> uniform(0.8, 1.2);
    for (Index k = 0; k < parameters.size(); ++k) {
      if (parameters[k] == 0) parameters[k] = 0.1;
      parameters[k] *= uniform(random);
      parameters[k] = std::clamp(parameters[k], sizes.min[k], sizes.max[k]);
    }
    return parameters;
  }
};

/// Where a derivative exists: away from the steps of signs, which differences would straddle.
double largest_difference(const MatrixXd& slope, const MatrixXd& above, const MatrixXd& below,
                          double step) {
  const MatrixXd difference = (above - below) / (2 * step);
  const double scale = std::max(difference.cwiseAbs().maxCoeff(), slope.cwiseAbs().maxCoeff());
  return scale == 0 ? 0 : (slope - difference).cwiseAbs().maxCoeff() / scale;
}

TEST_P(EveryEffect, HasDerivativesThatDifferencesAgreeWith) {
  const EffectLaw& law = law_of(GetParam());
  const VectorXd parameters = sizes(law);
  const MatrixXd motion = motion_of(law, 240, 0.4);
  VectorXd state = still(law);
  const EffectTorque found =
      law.evaluate(motion, parameters, kSampleTime, state, {.by_parameter = true});
  ASSERT_TRUE(found.torque.allFinite());
  for (Index k = 0; k < law.size(); ++k) {
    const auto& parameter = law.parameters[static_cast<std::size_t>(k)];
    if (parameter.name == "t_on" || parameter.name == "t_off") continue;  // a step has none
    const double step = 1e-5 * std::max(1e-4, std::abs(parameters[k]));
    VectorXd more = parameters, less = parameters;
    more[k] += step;
    less[k] -= step;
    const MatrixXd above = torque_of(law, motion, more, still(law));
    const MatrixXd below = torque_of(law, motion, less, still(law));
    for (Index o = 0; o < law.outputs; ++o) {
      EXPECT_LT(largest_difference(found.by_parameter.col(o * law.size() + k), above.col(o),
                                   below.col(o), step),
                3e-5)
          << parameter.name << ", output " << o;
    }
  }
  // a power of a state has no slope at zero: begin beside it
  constexpr double kBeside = 1e-4, kStep = 1e-7;
  const VectorXd beside = still(law).array() + kBeside;
  VectorXd moved = beside;
  const MatrixXd by_initial =
      law.evaluate(motion, parameters, kSampleTime, moved, {.by_initial = true}).by_initial;
  for (std::size_t s = 0; s < law.states.size(); ++s) {
    const auto at = static_cast<Index>(s);
    VectorXd more = beside, less = beside;
    more[at] += kStep;
    less[at] -= kStep;
    EXPECT_LT(largest_difference(by_initial.col(at), torque_of(law, motion, parameters, more),
                                 torque_of(law, motion, parameters, less), kStep),
              3e-5)
        << law.states[s];
  }
}

TEST_P(EveryEffect, SaysByLinearParametersAloneWhatItSaysByAll) {
  const EffectLaw& law = law_of(GetParam());
  const VectorXd parameters = sizes(law);
  const MatrixXd motion = motion_of(law, 240, 0.4);
  for (const bool held : {false, true}) {
    VectorXd state = still(law), again = still(law);
    const EffectTorque all = law.evaluate(motion, parameters, kSampleTime, state,
                                          {.by_parameter = true, .states_held = held});
    const EffectTorque some = law.evaluate(
        motion, parameters, kSampleTime, again,
        {.by_parameter = true, .torque = false, .linear_only = true, .states_held = held});
    EXPECT_EQ(some.torque.size(), 0);
    ASSERT_EQ(some.by_parameter.cols(), all.by_parameter.cols());
    for (Index c = 0; c < all.by_parameter.cols(); ++c) {
      const auto& parameter = law.parameters[static_cast<std::size_t>(c % law.size())];
      VectorXd expected = VectorXd::Zero(motion.rows());
      if (parameter.role == EffectRole::kLinear) expected = all.by_parameter.col(c);
      EXPECT_LE((some.by_parameter.col(c) - expected).cwiseAbs().maxCoeff(),
                1e-13 * expected.cwiseAbs().maxCoeff())
          << parameter.name;
    }
  }
}

TEST_P(EveryEffect, SaysWhetherItsTorqueIsProportionalToItsLinearParameters) {
  const EffectLaw& law = law_of(GetParam());
  VectorXd parameters = sizes(law);
  bool linear = false;
  for (Index k = 0; k < law.size(); ++k) {
    if (law.parameters[static_cast<std::size_t>(k)].role != EffectRole::kLinear) continue;
    parameters[k] = 0;
    linear = true;
  }
  const MatrixXd torque = torque_of(law, motion_of(law, 240, 0.4), parameters, still(law));
  EXPECT_EQ(law.proportional, linear && torque.isZero(0));
}

TEST_P(EveryEffect, IsLinearInWhatItsFileCallsLinear) {
  const EffectLaw& law = law_of(GetParam());
  const VectorXd parameters = sizes(law);
  const MatrixXd motion = motion_of(law, 100, 1.3);
  const MatrixXd whole = torque_of(law, motion, parameters, still(law));
  VectorXd none = parameters, twice = parameters;
  bool any = false;
  for (Index k = 0; k < law.size(); ++k) {
    if (law.parameters[static_cast<std::size_t>(k)].role != EffectRole::kLinear) continue;
    none[k] = 0;
    twice[k] *= 2;
    any = true;
  }
  if (!any) return;  // gear_efficiency: shapes alone
  const MatrixXd rest = torque_of(law, motion, none, still(law));
  const MatrixXd more = torque_of(law, motion, twice, still(law));
  EXPECT_LT((more - 2 * whole + rest).cwiseAbs().maxCoeff(),
            1e-12 * (1 + whole.cwiseAbs().maxCoeff()));
}

TEST_P(EveryEffect, HasTypicalAndFirstSizesWithinItsBounds) {
  const EffectLaw& law = law_of(GetParam());
  const EffectSizes sizes = law.sizes(usual_scales());
  EXPECT_TRUE(sizes.start.allFinite());
  EXPECT_TRUE(sizes.typical.allFinite());
  for (Index k = 0; k < law.size(); ++k) {
    EXPECT_LE(sizes.min[k], sizes.start[k]) << law.parameters[static_cast<std::size_t>(k)].name;
    EXPECT_LE(sizes.start[k], sizes.max[k]) << law.parameters[static_cast<std::size_t>(k)].name;
    EXPECT_LE(sizes.min[k], sizes.typical[k]) << law.parameters[static_cast<std::size_t>(k)].name;
    EXPECT_LE(sizes.typical[k], sizes.max[k]) << law.parameters[static_cast<std::size_t>(k)].name;
  }
  const MatrixXd torque = torque_of(law, motion_of(law, 240, 0), sizes.typical, still(law));
  EXPECT_GT(torque.cwiseAbs().maxCoeff(), 0) << "its typical size is no torque at all";
}

TEST_P(EveryEffect, IsTheSameInPiecesOfARun) {
  const EffectLaw& law = law_of(GetParam());
  const VectorXd parameters = sizes(law);
  const MatrixXd motion = motion_of(law, 60, 0.2);
  VectorXd state = still(law);
  const MatrixXd whole = law.evaluate(motion, parameters, kSampleTime, state, {}).torque;
  if (law.states.empty()) {
    VectorXd none;
    const MatrixXd tail =
        law.evaluate(motion.bottomRows(20), parameters, kSampleTime, none, {}).torque;
    EXPECT_EQ((whole.bottomRows(20) - tail).cwiseAbs().maxCoeff(), 0);
    return;
  }
  // the last sample of a piece is the first of the next: that one does not move the states
  VectorXd carried = still(law);
  (void)law.evaluate(motion.topRows(41), parameters, kSampleTime, carried, {});
  const MatrixXd tail =
      law.evaluate(motion.bottomRows(20), parameters, kSampleTime, carried, {}).torque;
  EXPECT_LT((whole.bottomRows(20) - tail).cwiseAbs().maxCoeff(),
            1e-12 * (1 + whole.cwiseAbs().maxCoeff()));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryEffect, testing::ValuesIn(test::effect_names()),
                         [](const auto& own) { return own.param; });

TEST(EffectCatalogueTest, HasEveryFamilyAndTheMembersThatAreKnown) {
  std::set<std::string> families, names;
  const EffectCatalogue catalogue;
  for (const auto& effect : catalogue.all()) {
    families.insert(effect->family);
    names.insert(effect->name);
  }
  for (const std::string_view family : effect_families()) {
    EXPECT_TRUE(families.contains(std::string(family))) << family;
  }
  for (const char* member : {"power_law_viscous",
                             "cubic_viscous",
                             "tanh_viscous",
                             "rational_viscous",
                             "dahl",
                             "lugre",
                             "elasto_plastic",
                             "maxwell_slip",
                             "bouc_wen",
                             "cogging",
                             "commutation_offset",
                             "commutation_gain",
                             "strain_wave_error",
                             "tooth_error",
                             "linear_spring",
                             "spring_mechanism",
                             "gas_spring",
                             "thermal_temperature",
                             "thermal_power",
                             "coulomb_coupling",
                             "viscous_coupling",
                             "inertial_coupling"}) {
    EXPECT_TRUE(names.contains(member)) << member;
  }
}

/// A joint that goes back and forth by `stroke` with few samples a reversal.
struct Cycle {
  MatrixXd variables;
  VectorXd q;
};
Cycle cycle_of(const EffectLaw& law, double stroke, int turns, Index samples_per_turn) {
  Cycle cycle{MatrixXd::Zero(turns * samples_per_turn, static_cast<Index>(law.variables.size())),
              VectorXd(turns * samples_per_turn)};
  const double w = 2 * std::numbers::pi / (kSampleTime * static_cast<double>(samples_per_turn));
  for (Index k = 0; k < cycle.q.size(); ++k) {
    const double t = kSampleTime * static_cast<double>(k);
    cycle.q[k] = -stroke * std::cos(w * t);
    const double qd = stroke * w * std::sin(w * t);
    for (std::size_t v = 0; v < law.variables.size(); ++v) {
      double& value = cycle.variables(k, static_cast<Index>(v));
      if (law.variables[v] == "qd") value = qd;
      if (law.variables[v] == "sign_qd") value = (qd > 0) - (qd < 0);
    }
  }
  return cycle;
}

/// Friction with Coulomb's part put back: what moves as the state does.
VectorXd state_torque(const EffectLaw& law, const VectorXd& parameters, const Cycle& cycle,
                      double F) {
  VectorXd torque = torque_of(law, cycle.variables, parameters, still(law)).col(0);
  for (std::size_t v = 0; v < law.variables.size(); ++v) {
    if (law.variables[v] == "sign_qd") torque += F * cycle.variables.col(static_cast<Index>(v));
  }
  return torque;
}

TEST(Dahl, ClosesALoopOfTheKnownArea) {
  // F' = (F0 - F s)/zs along the path. In the closed loop of stroke +-a: with E = exp(-2a/zs) the
  // force starts at -F0 (1 - E)/(1 + E), and the area of the loop is
  //   4 a F0 - 4 zs F0 (1 - E)/(1 + E).
  const EffectLaw& law = law_of("dahl");
  const double F = 8, zs = 0.004, a = 0.006;
  const Cycle cycle = cycle_of(law, a, 6, 4000);
  const VectorXd torque = state_torque(law, Eigen::Vector2d(F, zs), cycle, F);
  double area = 0;  // of the last turn
  const Index last = cycle.q.size() - 4000;
  for (Index k = last; k + 1 < cycle.q.size(); ++k) {
    area += 0.5 * (torque[k] + torque[k + 1]) * (cycle.q[k + 1] - cycle.q[k]);
  }
  const double E = std::exp(-2 * a / zs);
  const double expected = 4 * a * F - 4 * zs * F * (1 - E) / (1 + E);
  EXPECT_NEAR(area / expected, 1, 1e-3);
}

TEST(Dahl, TracesTheSameLoopAtAnySpeed) {
  const EffectLaw& law = law_of("dahl");
  const Eigen::Vector2d parameters(8, 0.004);
  const Cycle slow = cycle_of(law, 0.006, 3, 8000), fast = cycle_of(law, 0.006, 3, 2000);
  const VectorXd a = state_torque(law, parameters, slow, 8);
  const VectorXd b = state_torque(law, parameters, fast, 8);
  for (Index k = 0; k < b.size(); ++k) EXPECT_NEAR(a[4 * k], b[k], 2e-3 * 8);
}

TEST(Lugre, BreaksAwayAtTheStaticFriction) {
  // pulled slowly, the bristles carry up to F rise; at speed, F
  const EffectLaw& law = law_of("lugre");
  const double F = 8, rise = 1.4, vs = 0.05, zs = 0.002;
  VectorXd parameters(5);
  parameters << F, rise, vs, zs, 0;
  const auto steady = [&](double speed) {
    const Index samples = 2000;
    MatrixXd variables(samples, static_cast<Index>(law.variables.size()));
    for (std::size_t v = 0; v < law.variables.size(); ++v) {
      variables.col(static_cast<Index>(v)).setConstant(law.variables[v] == "qd" ? speed : 1.0);
    }
    VectorXd state = still(law);
    const double step = 0.02 * zs / speed;  // of the same distance at any speed
    const VectorXd torque =
        law.evaluate(variables, parameters, step, state, {}).torque.col(0).array() + F;
    return std::pair{torque.maxCoeff(), torque[samples - 1]};
  };
  EXPECT_NEAR(steady(1e-4 * vs).first / (F * rise), 1, 1e-6);
  EXPECT_NEAR(steady(20 * vs).second / F, 1, 1e-6);
  for (const double speed : {0.2 * vs, vs, 3 * vs}) {
    const double g = F * (1 + (rise - 1) * std::exp(-(speed / vs) * (speed / vs)));
    EXPECT_NEAR(steady(speed).second / g, 1, 1e-6) << speed;
  }
}

TEST(MaxwellSlip, ReturnsToWhereAnInnerLoopLeftTheOuterOne) {
  // return-point memory: after a small loop within a larger one the force goes on as without it
  const EffectLaw& law = law_of("maxwell_slip");
  VectorXd parameters(5);
  parameters << 2, 2, 2, 2, 0.001;
  const auto follow = [&](const std::vector<double>& stops) {
    std::vector<double> path = {0};
    for (const double stop : stops) {
      const double from = path.back();
      const auto steps = static_cast<int>(std::lround(std::abs(stop - from) / 1e-5));
      for (int i = 1; i <= steps; ++i) path.push_back(from + (stop - from) * i / steps);
    }
    // velocities of which the mean of two samples moves exactly from one position to the next
    MatrixXd variables(2 * static_cast<Index>(path.size()), 2);
    const auto qd_column = law.variables[0] == "qd" ? Index{0} : Index{1};
    Index row = 0;
    for (std::size_t k = 1; k < path.size(); ++k) {
      const double qd = (path[k] - path[k - 1]) / kSampleTime;
      variables(row, qd_column) = qd;
      variables(row, 1 - qd_column) = qd > 0 ? 1 : -1;
      ++row;
    }
    VectorXd state = still(law);
    const VectorXd torque =
        law.evaluate(variables.topRows(row), parameters, kSampleTime, state, {}).torque.col(0);
    return std::pair{torque, state};
  };
  const auto plain = follow({0.02, -0.004, 0.006}).second;
  const auto nested = follow({0.02, -0.004, 0.002, -0.001, 0.006}).second;
  EXPECT_LT((plain - nested).cwiseAbs().maxCoeff(), 3e-5) << "one sample of the path is 1e-5";
  // and it does differ where the inner loop is not closed
  const auto open = follow({0.02, -0.004, -0.0055, 0.006}).second;
  EXPECT_GT((plain - open).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(LinkFlexibility, SwingsAtItsFrequency) {
  const EffectLaw& law = law_of("link_flexibility");
  VectorXd parameters(3);
  parameters << 1, 10, 0.01;  // gain, Hz, damping
  MatrixXd load = MatrixXd::Zero(2000, 1);
  load.bottomRows(1900).setConstant(5);
  const VectorXd torque = torque_of(law, load, parameters, still(law)).col(0);
  int crossings = 0;
  for (Index k = 101; k < torque.size(); ++k) crossings += torque[k] * torque[k - 1] < 0 ? 1 : 0;
  EXPECT_NEAR(crossings, 2 * 10 * 1.9, 1);
  EXPECT_LT(torque.tail(100).cwiseAbs().maxCoeff(), torque.segment(100, 200).cwiseAbs().maxCoeff());
}

TEST(LinkFlexibility, BeginsWhereItDoesNotSwing) {
  const EffectLaw& law = law_of("link_flexibility");
  VectorXd parameters(3);
  parameters << 0.3, 10, 0.01;
  const MatrixXd load = MatrixXd::Constant(500, 1, 5);
  const VectorXd first = first_states(law, load);
  EXPECT_EQ(first[0], 5);
  EXPECT_EQ(first[1], 0);
  EXPECT_LT(torque_of(law, load, parameters, first).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(torque_of(law, load, parameters, still(law)).cwiseAbs().maxCoeff(), 1);
  const EffectLaw& dahl = law_of("dahl");  // its file says nothing of a start
  EXPECT_TRUE(
      first_states(dahl, MatrixXd::Ones(3, static_cast<Index>(dahl.variables.size()))).isZero(0));
}

}  // namespace
}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "tests/runtime/effects/effect_arm.h"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "runtime/effects/effect_fit.h"
#include "runtime/recordings/periods.h"

namespace dyngen::test {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using namespace runtime;

namespace {

constexpr double kLength = 0.5, kGravity = 9.81;
constexpr int kParameters = 13;

ArrayXd sign(const ArrayXd& x) {
  return x.unaryExpr([](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0; });
}

EffectParameter described(const LawParameter& parameter) {
  EffectParameter result;
  result.name = parameter.name;
  result.role = parameter.role;
  result.logarithmic = parameter.logarithmic;
  result.grid = parameter.grid;
  return result;
}

EffectSizes sizes_of(const std::vector<LawParameter>& parameters) {
  const Index np = static_cast<Index>(parameters.size());
  EffectSizes sizes{VectorXd(np), VectorXd(np), VectorXd(np), VectorXd(np)};
  for (Index p = 0; p < np; ++p) {
    const LawParameter& parameter = parameters[static_cast<std::size_t>(p)];
    sizes.min[p] = parameter.min;
    sizes.max[p] = parameter.max;
    sizes.start[p] = parameter.start;
    sizes.typical[p] = parameter.typical;
  }
  return sizes;
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

LinearModel planar_arm() {
  LinearModel model;
  model.name = "planar";
  model.joint_names = {"1", "2"};
  model.revolute = {true, true};
  const auto add = [&](const char* name, ParameterKind kind) {
    LinearParameter parameter;
    parameter.name = name;
    parameter.kind = kind;
    model.parameters.push_back(parameter);
  };
  for (const char* name : {"ZZ1R", "MX1R", "MY1", "ZZ2", "MX2", "MY2"}) {
    add(name, ParameterKind::kInertial);
  }
  add("IA2", ParameterKind::kRotorInertia);
  for (const char* name : {"FS1", "FS2"}) add(name, ParameterKind::kCoulomb);
  for (const char* name : {"FV1", "FV2"}) add(name, ParameterKind::kViscous);
  for (const char* name : {"OFF1", "OFF2"}) add(name, ParameterKind::kOffset);
  model.columns = {{0, 1, 2, 3, 4, 5, 7, 9, 11}, {3, 4, 5, 6, 8, 10, 12}};
  model.regressor = [](const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq, MatrixXd& Y) {
    Y = MatrixXd::Zero(q.rows(), 2 * kParameters);
    const ArrayXd c1 = q.col(0).array().cos(), s1 = q.col(0).array().sin();
    const ArrayXd c2 = q.col(1).array().cos(), s2 = q.col(1).array().sin();
    const ArrayXd c12 = (q.col(0) + q.col(1)).array().cos(),
                  s12 = (q.col(0) + q.col(1)).array().sin();
    const ArrayXd v1 = dq.col(0), v2 = dq.col(1), a1 = ddq.col(0), a2 = ddq.col(1);
    const ArrayXd a = 2 * a1 + a2, v = 2 * v1 * v2 + v2 * v2;
    Y.col(0) = a1;
    Y.col(1) = kGravity * c1;
    Y.col(2) = -kGravity * s1;
    Y.col(3) = a1 + a2;
    Y.col(4) = kLength * (a * c2 - v * s2) + kGravity * c12;
    Y.col(5) = -kLength * (a * s2 + v * c2) - kGravity * s12;
    Y.col(7) = sign(v1);
    Y.col(9) = v1;
    Y.col(11).setOnes();
    Y.col(kParameters + 3) = a1 + a2;
    Y.col(kParameters + 4) = kLength * (a1 * c2 + v1 * v1 * s2) + kGravity * c12;
    Y.col(kParameters + 5) = kLength * (v1 * v1 * c2 - a1 * s2) - kGravity * s12;
    Y.col(kParameters + 6) = a2;
    Y.col(kParameters + 8) = sign(v2);
    Y.col(kParameters + 10) = v2;
    Y.col(kParameters + 12).setOnes();
  };
  return model;
}

VectorXd planar_arm_values() {
  VectorXd beta(kParameters);
  beta << 1.2, 2.0, 0.1, 0.4, 0.9, 0.05, 0.2, 3.0, 1.5, 2.0, 1.0, 0.3, -0.2;
  return beta;
}

EffectRobot planar_arm_tangents() {
  EffectRobot robot;
  robot.tangents = [](const TangentKey& wanted, const JointMotion& motion, const VectorXd& beta,
                      double) -> TangentColumns {
    const std::string& name = wanted.first;
    const ArrayXd q1 = motion.q.col(0), q12 = motion.q.col(0) + motion.q.col(1);
    MatrixXd torque(motion.q.rows(), 2);
    if (name == "payload_M") {
      // a mass in the origin of frame 2: L^2 of ZZ1R and L of MX1R
      torque.col(0) = kLength * kLength * motion.ddq.col(0).array() + kGravity * kLength * q1.cos();
      torque.col(1).setZero();
      return {{wanted, torque}};
    }
    if (name.starts_with("contact_")) {
      MatrixXd x = MatrixXd::Zero(torque.rows(), 2), y = x, moment = x;
      moment.leftCols(wanted.second).setOnes();
      if (wanted.second == 2) {
        x.col(0) = -kLength * q1.sin();
        y.col(0) = kLength * q1.cos();
      }
      return {{{"contact_fx", wanted.second}, x},
              {{"contact_fy", wanted.second}, y},
              {{"contact_nz", wanted.second}, moment}};
    }
    // gravity (gx, gy) of the arm's plane: g is its y
    const double turn = name == "d_gx" ? std::acos(-1.0) / 2 : 0;
    torque.col(1) = beta[4] * (q12 + turn).cos() - beta[5] * (q12 + turn).sin();
    torque.col(0) =
        beta[1] * (q1 + turn).cos() - beta[2] * (q1 + turn).sin() + torque.col(1).array();
    return {{wanted, torque}};
  };
  return robot;
}

Motion sines(double seconds, double sample_time, double phase, double speed, double start) {
  constexpr double kFrequencies[2][3] = {{0.7, 1.9, 3.7}, {0.9, 2.3, 4.1}};
  constexpr double kAmplitudes[2][3] = {{0.8, 0.5, 0.12}, {1.0, 0.4, 0.15}};
  Motion motion;
  motion.sample_time = sample_time;
  const Index N = static_cast<Index>(std::lround(seconds / sample_time));
  motion.time = VectorXd::LinSpaced(N, 0, sample_time * static_cast<double>(N - 1));
  motion.q = motion.dq = motion.ddq = MatrixXd::Zero(N, 2);
  for (Index j = 0; j < 2; ++j) {
    for (int h = 0; h < 3; ++h) {
      const double w = speed * kFrequencies[j][h], A = kAmplitudes[j][h];
      const ArrayXd angle =
          w * (motion.time.array() + start) + phase + 1.3 * h + 0.4 * static_cast<double>(j);
      motion.q.col(j).array() += A * angle.sin();
      motion.dq.col(j).array() += A * w * angle.cos();
      motion.ddq.col(j).array() -= A * w * w * angle.sin();
    }
  }
  return motion;
}

MotionSource source_of(const Motion& motion) {
  MotionSource source;
  source.name = "made";
  source.sample_time = motion.sample_time;
  source.position_noise = VectorXd::Zero(motion.joints());
  source.fastest = motion.dq.cwiseAbs().colwise().maxCoeff();
  Recording positions;
  positions.time = motion.time;
  positions.q = motion.q;
  positions.run_starts = {0};
  const auto run = std::make_shared<Motion>(motion);
  run->period = find_periods(positions).period;
  source.pieces = [run](const std::function<void(const StreamPiece&)>& visit) {
    visit({*run, false});
  };
  return source;
}

EffectLaw algebraic_law(const std::string& name, const std::vector<std::string>& variables,
                        const std::vector<LawParameter>& parameters,
                        std::function<double(const VectorXd& v, const VectorXd& p)> torque) {
  EffectLaw law;
  law.name = law.family = name;
  law.variables = variables;
  for (const LawParameter& parameter : parameters) law.parameters.push_back(described(parameter));
  law.sizes = [parameters](const EffectScales&) { return sizes_of(parameters); };
  law.evaluate = [torque](const MatrixXd& table, const VectorXd& values, double, VectorXd&,
                          const EffectWanted&) {
    const Index N = table.rows(), np = values.size(), nv = table.cols();
    EffectTorque result{VectorXd(N), MatrixXd(N, np), MatrixXd(N, nv), {}};
    const auto slope = [](auto f, double at) {
      const double h = 1e-5 * std::max(1e-2, std::abs(at));
      return (f(at + h) - f(at - h)) / (2 * h);
    };
    for (Index k = 0; k < N; ++k) {
      const VectorXd v = table.row(k), p = values;
      result.torque(k, 0) = torque(v, p);
      for (Index i = 0; i < np; ++i) {
        result.by_parameter(k, i) = slope(
            [&](double x) {
              VectorXd moved = p;
              moved[i] = x;
              return torque(v, moved);
            },
            p[i]);
      }
      for (Index i = 0; i < nv; ++i) {
        result.by_variable(k, i) = slope(
            [&](double x) {
              VectorXd moved = v;
              moved[i] = x;
              return torque(moved, p);
            },
            v[i]);
      }
    }
    return result;
  };
  return law;
}

EffectLaw stribeck_law() {
  EffectLaw law = algebraic_law("stribeck", {"qd", "sign_qd", "Fc"},
                                {{"Fs", EffectRole::kLinear, 0, kInfinite, 2, 2},
                                 {"vs", EffectRole::kShape, 1e-3, 1, 0.05, 0.05, true}},
                                [](const VectorXd& v, const VectorXd& p) {
                                  const double x = v[0] / p[1];
                                  return (p[0] - v[2]) * std::exp(-x * x) * v[1];
                                });
  law.dissipates = true;
  EffectCondition condition;
  condition.spelling = "Fc <= Fs";
  condition.slack = [](const VectorXd& p, const EffectScales& scales) { return p[0] - scales.Fc; };
  law.requirements.push_back(condition);
  EffectCondition narrow;
  narrow.spelling = "vs <= 0.25*v90";
  narrow.text = "a wide band is viscous friction that bends";
  narrow.slack = [](const VectorXd& p, const EffectScales& scales) {
    return 0.25 * scales.v90 - p[1];
  };
  law.falsifiers.push_back(narrow);
  return law;
}

EffectLaw load_friction_law() {
  EffectLaw law = algebraic_law(
      "load_friction", {"tau_load", "sign_qd"}, {{"mu", EffectRole::kLinear, 0, 1, 0.05, 0.05}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::abs(v[0]) * v[1]; });
  return law;
}

EffectLaw spring_law() {
  return algebraic_law("gravity_spring", {"q"},
                       {{"k", EffectRole::kLinear, -kInfinite, kInfinite, 1, 20}},
                       [](const VectorXd& v, const VectorXd& p) { return p[0] * v[0]; });
}

EffectLaw ripple_law() {
  return algebraic_law("torque_ripple", {"q"},
                       {{"a", EffectRole::kLinear, -kInfinite, kInfinite, 0.1, 0.3},
                        {"b", EffectRole::kLinear, -kInfinite, kInfinite, 0.1, 0.3},
                        {"n", EffectRole::kScanned, 5, 60, 20, 20, false, 111}},
                       [](const VectorXd& v, const VectorXd& p) {
                         return p[0] * std::cos(p[2] * v[0]) + p[1] * std::sin(p[2] * v[0]);
                       });
}

EffectLaw coulomb_asymmetry_law() {
  EffectLaw law = algebraic_law(
      "coulomb_asymmetry", {"sign_qd"}, {{"a", EffectRole::kLinear, -kInfinite, kInfinite, 0, 0.3}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * (v[0] == 0 ? 0 : 1); });
  law.aliases = {"torque_offset"};
  return law;
}

EffectLaw tilt_law() {
  EffectLaw law = algebraic_law("base_tilt", {"d_gx", "d_gy"},
                                {{"x", EffectRole::kLinear, -kInfinite, kInfinite, 0, 0.2},
                                 {"y", EffectRole::kLinear, -kInfinite, kInfinite, 0, 0.01}},
                                [](const VectorXd& v, const VectorXd& p) { return p.dot(v); });
  law.kind = EffectKind::kTangent;
  law.scope = EffectScope::kRobot;
  law.acts_on_all = true;
  return law;
}

EffectLaw payload_law() {
  EffectLaw law = algebraic_law("payload_change", {"payload_M", "t"},
                                {{"m", EffectRole::kLinear, 0, kInfinite, 1, 1},
                                 {"t1", EffectRole::kGiven, -kInfinite, kInfinite, 0, 0},
                                 {"t2", EffectRole::kGiven, -kInfinite, kInfinite, 1e9, 1e9}},
                                [](const VectorXd& v, const VectorXd& p) {
                                  return v[1] >= p[1] && v[1] <= p[2] ? p[0] * v[0] : 0;
                                });
  law.kind = EffectKind::kTangent;
  law.scope = EffectScope::kRobot;
  law.acts_on_all = true;
  return law;
}

EffectLaw contact_law() {
  EffectLaw law = algebraic_law("contact", {"t", "contact_fx", "contact_fy", "contact_nz"},
                                {{"fx", EffectRole::kLinear, -kInfinite, kInfinite, 0, 1},
                                 {"fy", EffectRole::kLinear, -kInfinite, kInfinite, 0, 1},
                                 {"nz", EffectRole::kLinear, -kInfinite, kInfinite, 0, 0},
                                 {"t_on", EffectRole::kScanned, 0, 30, 15, 15, false, 200},
                                 {"t_off", EffectRole::kScanned, 0, 30, 16, 16, false, 200}},
                                [](const VectorXd& v, const VectorXd& p) {
                                  const bool on = v[0] > p[3] && v[0] <= p[4];
                                  return on ? p.head(3).dot(v.tail(3)) : 0.0;
                                });
  law.parameters[3].unit = law.parameters[4].unit = "s";
  law.kind = EffectKind::kTangent;
  law.acts_on_all = law.acts_inward = true;
  return law;
}

EffectLaw slip_law() {
  const std::vector<LawParameter> parameters = {
      {"k", EffectRole::kLinear, 0, kInfinite, 200, 300},
      {"reach", EffectRole::kShape, 1e-4, 0.1, 3e-3, 3e-3, true}};
  EffectLaw law;
  law.name = law.family = "presliding";
  law.kind = EffectKind::kStateful;
  law.dissipates = true;
  law.variables = {"qd"};
  law.states = {"z"};
  for (const LawParameter& parameter : parameters) law.parameters.push_back(described(parameter));
  law.sizes = [parameters](const EffectScales&) { return sizes_of(parameters); };
  law.evaluate = [](const MatrixXd& variables, const VectorXd& p, double T, VectorXd& state,
                    const EffectWanted&) {
    const Index N = variables.rows();
    EffectTorque result{VectorXd(N), MatrixXd(N, 2), MatrixXd::Zero(N, 1), MatrixXd(N, 1)};
    double z = state[0], by_reach = 0, by_first = 1;
    for (Index k = 0; k < N; ++k) {
      if (k > 0) z += T * 0.5 * (variables(k - 1, 0) + variables(k, 0));
      if (std::abs(z) > p[1]) {
        by_reach = z > 0 ? 1 : -1;
        z = by_reach * p[1];
        by_first = 0;
      }
      result.torque(k, 0) = p[0] * z;
      result.by_parameter(k, 0) = z;
      result.by_parameter(k, 1) = p[0] * by_reach;
      result.by_initial(k, 0) = p[0] * by_first;
    }
    state[0] = z;
    return result;
  };
  return law;
}

namespace {

EffectLaw lateness_law(const std::string& name, AlignmentOperator alignment, double sign) {
  EffectLaw law =
      algebraic_law(name, {"torque_rate"}, {{"T", EffectRole::kShape, 0, 0.04, 1e-3, 4e-3}},
                    [sign](const VectorXd& v, const VectorXd& p) { return sign * p[0] * v[0]; });
  law.kind = EffectKind::kAlignment;
  law.scope = EffectScope::kRobot;
  law.acts_on_all = true;
  law.alignment = alignment;
  law.alignment_parameter = 0;
  return law;
}

}  // namespace

EffectLaw delay_law() { return lateness_law("time_delay", AlignmentOperator::kDelay, -1); }
EffectLaw lag_law() { return lateness_law("actuator_lag", AlignmentOperator::kLag, 1); }

EffectInstance unknown(const EffectLaw& law, int joint, int other) {
  EffectInstance effect;
  effect.law = law;
  effect.joint = joint;
  effect.other = other;
  effect.parameters = VectorXd::Constant(law.size(), std::numeric_limits<double>::quiet_NaN());
  return effect;
}

EffectInstance known(const EffectLaw& law, int joint, const std::vector<double>& parameters) {
  EffectInstance effect = unknown(law, joint);
  effect.parameters = Eigen::Map<const VectorXd>(parameters.data(), law.size());
  return effect;
}

std::vector<MotionSource> measured(const std::vector<Motion>& motions, const VectorXd& beta,
                                   const std::vector<EffectInstance>& effects, double noise,
                                   double coefficient, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<MotionSource> sources;
  for (Motion motion : motions) {
    motion.tau = MatrixXd::Zero(motion.samples(), 2);
    EffectRecordings alone =
        effect_recordings(planar_arm(), planar_arm_tangents(), {source_of(motion)}, {1, -1});
    const EffectPoint point = at_rest(alone, beta, effects);
    // tau less the model: the torque of 0, with the sign turned
    EffectSignals signals(alone);
    const EffectUnknowns unknowns = base_unknowns(point);
    const EffectEquations equations = linearised(alone, signals, point, unknowns);
    motion.tau = -residual(equations.blocks.front(), beta);
    const double innovation = noise * std::sqrt(1 - coefficient * coefficient);
    for (Index j = 0; j < 2; ++j) {
      double e = noise * normal(random);
      for (Index k = 0; k < motion.samples(); ++k) {
        motion.tau(k, j) += e;
        e = coefficient * e + innovation * normal(random);
      }
    }
    sources.push_back(source_of(motion));
  }
  return sources;
}

}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#include "tests/support/effect_judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "gen/symbols/exact.h"

namespace dyngen::test {
namespace {

double sign(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; }

double call(const std::string& name, const std::vector<double>& x) {
  if (name == "sin") return std::sin(x[0]);
  if (name == "cos") return std::cos(x[0]);
  if (name == "exp") return std::exp(x[0]);
  if (name == "log") return std::log(x[0]);
  if (name == "tanh") return std::tanh(x[0]);
  if (name == "sqrt") return std::sqrt(x[0]);
  if (name == "abs") return std::abs(x[0]);
  if (name == "sign") return sign(x[0]);
  if (name == "min") return std::min(x[0], x[1]);
  if (name == "max") return std::max(x[0], x[1]);
  throw std::invalid_argument("effect judge: no call " + name);
}

}  // namespace

double numeric_value(const EffectExpression& expression, const NumericValues& values) {
  using Kind = EffectExpression::Kind;
  if (expression.kind == Kind::kNumber) return to_double(expression.number);
  if (expression.kind == Kind::kName) {
    return expression.name == "pi" ? std::numbers::pi : values(expression.name);
  }
  std::vector<double> x;
  for (const EffectExpression& operand : expression.operands) {
    x.push_back(numeric_value(operand, values));
  }
  switch (expression.kind) {
    case Kind::kNegate:
      return -x[0];
    case Kind::kSum:
      return x[0] + x[1];
    case Kind::kDifference:
      return x[0] - x[1];
    case Kind::kProduct:
      return x[0] * x[1];
    case Kind::kQuotient:
      return x[0] / x[1];
    case Kind::kPower:
      return std::pow(x[0], x[1]);
    default:
      return call(expression.name, x);
  }
}

EffectJudge::EffectJudge(const EffectFile& effect, NumericValues parameters)
    : effect_(effect), parameters_(std::move(parameters)) {
  for (const dyngen::EffectState& state : effect.states) {
    double start = 0;
    if (state.max) start = std::min(start, numeric_value(*state.max, parameters_));
    if (state.min) start = std::max(start, numeric_value(*state.min, parameters_));
    states_.push_back(start);
  }
}

double EffectJudge::value(const EffectExpression& expression,
                          const NumericValues& variables) const {
  const NumericValues all = [&](const std::string& name) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (effect_.states[i].name == name) return states_[i];
    }
    for (const auto& [let, meaning] : effect_.lets) {
      if (let == name) return value(meaning, variables);
    }
    for (const EffectParameter& parameter : effect_.parameters) {
      if (parameter.name == name) return parameters_(name);
    }
    return variables(name);
  };
  return numeric_value(expression, all);
}

void EffectJudge::move_states(const NumericValues& now, double step) {
  const NumericValues middle = [&](const std::string& name) {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (effect_.variables[i] == name) return (last_[i] + now(name)) / 2;
    }
    return now(name);  // sign(qd) reads qd, which may not be among the variables
  };
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const dyngen::EffectState& state = effect_.states[i];
    const double before = states_[i], rate = value(state.rate, middle);
    constexpr double kDifference = 1e-6;
    states_[i] = before + kDifference;
    const double above = value(state.rate, middle);
    states_[i] = before - kDifference;
    const double below = value(state.rate, middle);
    const double x = -step * (above - below) / (2 * kDifference);
    const double phi = x == 0 ? 1 : -std::expm1(-x) / x;
    states_[i] = before + step * phi * rate;
    if (state.max) states_[i] = std::min(states_[i], value(*state.max, middle));
    if (state.min) states_[i] = std::max(states_[i], value(*state.min, middle));
  }
}

std::vector<double> EffectJudge::torque(const NumericValues& now, double step) {
  if (step > 0) move_states(now, step);
  last_.clear();
  for (const std::string& name : effect_.variables) last_.push_back(now(name));
  std::vector<double> result;
  for (const EffectExpression& torque : effect_.torque) result.push_back(value(torque, now));
  return result;
}

}  // namespace dyngen::test

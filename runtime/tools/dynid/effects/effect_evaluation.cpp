// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_evaluation.h"

#include <cmath>
#include <span>
#include <stdexcept>

#include "gen/program/evaluator.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::span<const double> values(const MatrixXd& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}
std::span<double> places(MatrixXd& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

/// A derivative that does not exist (a root at zero) counts as 0.
void make_finite(MatrixXd& slopes) {
  slopes = slopes.unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
}

std::vector<bool> linear_of(const EffectFile& effect) {
  std::vector<bool> linear;
  for (const auto& parameter : effect.parameters) {
    linear.push_back(parameter.role == ParameterRole::kLinear);
  }
  return linear;
}

}  // namespace

EffectEvaluation::EffectEvaluation(const EffectFile& effect)
    : programs_(std::make_shared<const EffectPrograms>(effect_programs(effect))),
      linear_(linear_of(effect)),
      variables_(static_cast<Index>(effect.variables.size())),
      parameters_(static_cast<Index>(effect.parameters.size())),
      states_(static_cast<Index>(effect.states.size())),
      outputs_(static_cast<Index>(effect.torque.size())) {
  for (std::size_t i = 0; i < effect.variables.size(); ++i) {
    const std::string& name = effect.variables[i];
    if (name == "Fc" || name == "Fv" || name == "Ia") {
      constants_.push_back(static_cast<Index>(i));
    }
  }
}

EffectTorque EffectEvaluation::operator()(const MatrixXd& variables, const VectorXd& parameters,
                                          double sample_time, VectorXd& state,
                                          const EffectWanted& wanted) const {
  check(variables, parameters, state);
  const History history = states_ == 0 || variables.rows() == 0
                              ? History{}
                              : follow(variables, parameters, sample_time, state, wanted);
  const Index samples = variables.rows();
  const auto run = [&](const Program& program, const char* array, Index columns) {
    MatrixXd result(samples, columns);
    const MatrixXd p = parameters;
    evaluate(program, static_cast<std::size_t>(samples),
             {{"v", values(variables)}, {"p", values(p)}, {"z", values(history.z)}},
             {{array, places(result)}});
    return result;
  };
  EffectTorque result;
  if (wanted.torque) result.torque = run(programs_->torque, "torque", outputs_);
  MatrixXd by_state;
  if (states_ > 0 && !wanted.states_held &&
      (wanted.by_parameter || wanted.by_variable || wanted.by_initial)) {
    by_state = run(programs_->by_state, "slope", outputs_ * states_);
    make_finite(by_state);
  }
  if (wanted.by_parameter) {
    const auto left_out = [&](Index k) {
      return wanted.linear_only && !linear_[static_cast<std::size_t>(k)];
    };
    result.by_parameter = run(wanted.linear_only ? programs_->by_linear : programs_->by_parameter,
                              "slope", outputs_ * parameters_);
    for (Index c = 0; c < result.by_parameter.cols(); ++c) {
      if (left_out(c % parameters_)) result.by_parameter.col(c).setZero();
    }
    make_finite(result.by_parameter);
    for (Index k = 0; k < parameters_; ++k) {
      if (left_out(k)) continue;
      add_memory(by_state, history.by_parameter, k, parameters_, result.by_parameter, k);
    }
  }
  if (wanted.by_variable) {
    result.by_variable = run(programs_->by_variable, "slope", outputs_ * variables_);
    make_finite(result.by_variable);
    const auto count = static_cast<Index>(constants_.size());
    for (Index k = 0; k < count; ++k) {
      add_memory(by_state, history.by_constant, k, count, result.by_variable,
                 constants_[static_cast<std::size_t>(k)]);
    }
  }
  if (wanted.by_initial && states_ > 0) {
    result.by_initial = MatrixXd::Zero(samples, outputs_ * states_);
    for (Index k = 0; k < states_; ++k) {
      add_memory(by_state, history.by_initial, k, states_, result.by_initial, k);
    }
  }
  return result;
}

void EffectEvaluation::check(const MatrixXd& variables, const VectorXd& parameters,
                             const VectorXd& state) const {
  if (variables.cols() == variables_ && parameters.size() == parameters_ &&
      state.size() == states_) {
    return;
  }
  throw std::invalid_argument("EffectLaw::evaluate(): a size does not fit the effect");
}

/// d torque / d k by way of the states.
void EffectEvaluation::add_memory(const MatrixXd& by_state, const MatrixXd& of_states, Index k,
                                  Index count, MatrixXd& slopes, Index column) const {
  if (states_ == 0 || of_states.size() == 0) return;
  const Index width = slopes.cols() / outputs_;
  for (Index o = 0; o < outputs_; ++o) {
    for (Index s = 0; s < states_; ++s) {
      slopes.col(o * width + column).array() +=
          by_state.col(o * states_ + s).array() * of_states.col(s * count + k).array();
    }
  }
}

EffectEvaluation::History EffectEvaluation::follow(const MatrixXd& variables,
                                                   const VectorXd& parameters, double sample_time,
                                                   VectorXd& state,
                                                   const EffectWanted& wanted) const {
  const Index samples = variables.rows();
  MatrixXd middle = variables;  // of a step
  middle.bottomRows(samples - 1) =
      0.5 * (variables.topRows(samples - 1) + variables.bottomRows(samples - 1));
  const StepInputs inputs{middle, parameters, sample_time};
  MatrixXd before(samples, states_);
  History history;
  history.z.resize(samples, states_);
  const MatrixXd ahead =
      of_steps(programs_->step.ahead, inputs, nullptr, {{"ahead", programs_->step.carried}})[0]
          .transpose();
  ProgramEvaluator step(programs_->step.rest, {"z", "ahead"}, "z");
  VectorXd next(states_);
  for (Index k = 0; k < samples; ++k) {
    before.row(k) = state;
    step.run({state.data(), ahead.col(k).data()}, next.data());
    state = next;
    history.z.row(k) = state;
  }
  if (wanted.states_held || !(wanted.by_parameter || wanted.by_variable || wanted.by_initial)) {
    return history;
  }
  std::vector<MatrixXd> slopes = of_steps(programs_->step_slopes, inputs, &before,
                                          {{"by_z", states_ * states_},
                                           {"by_p", states_ * parameters_},
                                           {"by_m", states_ * variables_}});
  // where a state is at a point without a slope (a power at zero) it is carried on
  MatrixXd& by_z = slopes[0];
  for (Index c = 0; c < by_z.cols(); ++c) {
    const double without = c % (states_ + 1) == 0 ? 1 : 0;
    by_z.col(c) =
        by_z.col(c).unaryExpr([&](double slope) { return std::isfinite(slope) ? slope : without; });
  }
  make_finite(slopes[1]);
  make_finite(slopes[2]);
  if (wanted.by_parameter) {
    history.by_parameter = remembered(by_z, std::move(slopes[1]), MatrixXd());
  }
  if (wanted.by_variable) {
    const auto count = static_cast<Index>(constants_.size());
    MatrixXd by_constant(samples, states_ * count);
    for (Index s = 0; s < states_; ++s) {
      for (Index c = 0; c < count; ++c) {
        by_constant.col(s * count + c) =
            slopes[2].col(s * variables_ + constants_[static_cast<std::size_t>(c)]);
      }
    }
    history.by_constant = remembered(by_z, std::move(by_constant), MatrixXd());
  }
  if (wanted.by_initial) {
    history.by_initial = remembered(by_z, MatrixXd::Zero(samples, states_ * states_),
                                    MatrixXd::Identity(states_, states_));
  }
  make_finite(history.by_parameter);
  make_finite(history.by_constant);
  make_finite(history.by_initial);
  return history;
}

/// A program over all steps. @param before  (N x states) or null: states before each step
std::vector<MatrixXd> EffectEvaluation::of_steps(const Program& program, const StepInputs& inputs,
                                                 const MatrixXd* before, const Outputs& outputs) {
  const auto run = [&](const MatrixXd& m, const MatrixXd& z, double length) {
    std::vector<MatrixXd> results;
    for (const auto& [name, columns] : outputs) results.emplace_back(m.rows(), columns);
    std::vector<OutputArray> arrays;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      arrays.push_back({outputs[i].first, places(results[i])});
    }
    const MatrixXd p = inputs.parameters, h = MatrixXd::Constant(1, 1, length);
    evaluate(program, static_cast<std::size_t>(m.rows()),
             {{"m", values(m)}, {"p", values(p)}, {"z", values(z)}, {"h", values(h)}}, arrays);
    return results;
  };
  const MatrixXd none;
  std::vector<MatrixXd> all = run(inputs.middle, before ? *before : none, inputs.sample_time);
  const MatrixXd first_state = before ? MatrixXd(before->topRows(1)) : none;
  const std::vector<MatrixXd> first = run(inputs.middle.topRows(1), first_state, 0);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].row(0) = first[i];
  return all;
}

/// Derivatives of the states after every step, D_k = by_z D_(k-1) + b_k.
/// @param by_z   (N x states^2) row-major
/// @param b      (N x states * count)
/// @param start  (states x count); empty: 0
MatrixXd EffectEvaluation::remembered(const MatrixXd& by_z, MatrixXd b,
                                      const MatrixXd& start) const {
  const Index count = b.cols() / states_;
  VectorXd now(states_), next(states_);
  for (Index c = 0; c < count; ++c) {
    now = start.size() > 0 ? VectorXd(start.col(c)) : VectorXd::Zero(states_);
    for (Index k = 0; k < b.rows(); ++k) {
      for (Index s = 0; s < states_; ++s) {
        double sum = 0;
        for (Index i = 0; i < states_; ++i) sum += by_z(k, s * states_ + i) * now[i];
        next[s] = sum + b(k, s * count + c);
      }
      now.swap(next);
      for (Index s = 0; s < states_; ++s) b(k, s * count + c) = now[s];
    }
  }
  return b;
}

}  // namespace dyngen::runtime

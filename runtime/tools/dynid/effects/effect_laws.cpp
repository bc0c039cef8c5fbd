// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "gen/effect_file/units.h"
#include "gen/effect_programs/effect_programs.h"
#include "gen/program/evaluator.h"
#include "gen/symbols/exact.h"

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

/// Evaluates the programs of an effect over runs of samples.
class EffectEvaluation {
 public:
  explicit EffectEvaluation(const EffectFile& effect)
      : programs_(std::make_shared<const EffectPrograms>(effect_programs(effect))),
        linear_(is_linear(effect)),
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

  EffectTorque operator()(const MatrixXd& variables, const VectorXd& parameters, double sample_time,
                          VectorXd& state, const EffectWanted& wanted) const {
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

  [[nodiscard]] bool is_proportional() const { return programs_->proportional; }

 private:
  static std::vector<bool> is_linear(const EffectFile& effect) {
    std::vector<bool> linear;
    for (const auto& parameter : effect.parameters) {
      linear.push_back(parameter.role == ParameterRole::kLinear);
    }
    return linear;
  }

  /// States at every sample, and their derivatives: element (state s, by k) in column s * count +
  /// k.
  struct History {
    MatrixXd z, by_parameter, by_constant, by_initial;
  };
  void check(const MatrixXd& variables, const VectorXd& parameters, const VectorXd& state) const {
    if (variables.cols() == variables_ && parameters.size() == parameters_ &&
        state.size() == states_) {
      return;
    }
    throw std::invalid_argument("EffectLaw::evaluate(): a size does not fit the effect");
  }

  /// d torque / d k by way of the states.
  void add_memory(const MatrixXd& by_state, const MatrixXd& of_states, Index k, Index count,
                  MatrixXd& slopes, Index column) const {
    if (states_ == 0 || of_states.size() == 0) return;
    const Index width = slopes.cols() / outputs_;
    for (Index o = 0; o < outputs_; ++o) {
      for (Index s = 0; s < states_; ++s) {
        slopes.col(o * width + column).array() +=
            by_state.col(o * states_ + s).array() * of_states.col(s * count + k).array();
      }
    }
  }

  History follow(const MatrixXd& variables, const VectorXd& parameters, double sample_time,
                 VectorXd& state, const EffectWanted& wanted) const {
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
    std::vector<MatrixXd> slopes =
        of_steps(programs_->step_slopes, inputs, &before,
                 {{"by_z", states_ * states_}, {"by_p", states_ * parameters_},
                  {"by_m", states_ * variables_}});
    // where a state is at a point without a slope (a power at zero) it is carried on
    MatrixXd& by_z = slopes[0];
    for (Index c = 0; c < by_z.cols(); ++c) {
      const double without = c % (states_ + 1) == 0 ? 1 : 0;
      by_z.col(c) = by_z.col(c).unaryExpr(
          [&](double slope) { return std::isfinite(slope) ? slope : without; });
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

  /// What the steps of a run have in common.
  struct StepInputs {
    const MatrixXd& middle;      ///< (N x nv) variables in the middle of each step
    const VectorXd& parameters;  ///< (np)
    double sample_time;          ///< s; the first step has no length
  };
  using Outputs = std::vector<std::pair<const char*, Index>>;  // arrays and their columns

  /// A program over all steps. @param before  (N x states) or null: states before each step
  static std::vector<MatrixXd> of_steps(const Program& program, const StepInputs& inputs,
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
  [[nodiscard]] MatrixXd remembered(const MatrixXd& by_z, MatrixXd b,
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

  std::shared_ptr<const EffectPrograms> programs_;
  std::vector<bool> linear_;  // of each parameter
  Index variables_, parameters_, states_, outputs_;
  std::vector<Index> constants_;  // Fc, Fv, Ia: their places among the variables
};

/// Torque and rates of one moment.
class EffectMoment {
 public:
  explicit EffectMoment(const EffectFile& effect)
      : states_(effect.states.size()), least_(states_), most_(states_) {
    const EffectPrograms programs = effect_programs(effect);
    has_min_ = programs.has_min;
    has_max_ = programs.has_max;
    program_ = std::make_unique<ProgramEvaluator>(
        programs.moment, std::vector<std::string>{"v", "p", "z"},
        std::vector<std::string>{"torque", "rate", "min", "max"});
  }
  EffectMoment(const EffectMoment& other)
      : program_(std::make_unique<ProgramEvaluator>(*other.program_)),
        states_(other.states_),
        has_min_(other.has_min_),
        has_max_(other.has_max_),
        least_(other.least_),
        most_(other.most_) {}
  EffectMoment& operator=(const EffectMoment&) = delete;
  EffectMoment(EffectMoment&&) = default;
  EffectMoment& operator=(EffectMoment&&) = delete;
  ~EffectMoment() = default;

  void operator()(const double* variables, const double* parameters, const double* z,
                  double* torque, double* rate) {
    program_->run({variables, parameters, z}, {torque, rate, least_.data(), most_.data()});
    for (std::size_t s = 0; s < states_; ++s) {
      if (has_max_[s] && z[s] >= most_[s] && rate[s] > 0) rate[s] = 0;
      if (has_min_[s] && z[s] <= least_[s] && rate[s] < 0) rate[s] = 0;
    }
  }

 private:
  std::unique_ptr<ProgramEvaluator> program_;
  std::size_t states_;
  std::vector<bool> has_min_, has_max_;
  std::vector<double> least_, most_;
};

double scale_value(const EffectScales& scales, const std::string& name) {
  if (name == "Fc") return scales.Fc;
  if (name == "Fv") return scales.Fv;
  if (name == "Ia") return scales.Ia;
  if (name == "v_max") return scales.v_max;
  if (name == "v90") return scales.v90;
  if (name == "q_range") return scales.q_range;
  if (name == "tau_max") return scales.tau_max;
  if (name == "duration") return scales.duration;
  if (name == "position_step") return scales.position_step;
  if (name == "temp_range") return scales.temp_range;
  throw std::logic_error("EffectScales: there is no '" + name + "'");
}

double size_of(const EffectExpression& expression, const EffectScales& scales) {
  return evaluate(expression, [&](const std::string& name) { return scale_value(scales, name); });
}

EffectSizes sizes_of(const std::vector<::dyngen::EffectParameter>& parameters,
                     const EffectScales& scales) {
  const auto count = static_cast<Index>(parameters.size());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EffectSizes sizes;
  for (VectorXd* part : {&sizes.min, &sizes.max, &sizes.start, &sizes.typical}) part->resize(count);
  for (Index k = 0; k < count; ++k) {
    const auto& parameter = parameters[static_cast<std::size_t>(k)];
    sizes.min[k] = parameter.min ? size_of(*parameter.min, scales) : -kInfinity;
    sizes.max[k] = parameter.max ? size_of(*parameter.max, scales) : kInfinity;
    sizes.start[k] = size_of(parameter.start, scales);
    sizes.typical[k] = size_of(parameter.typical, scales);
  }
  return sizes;
}

EffectCondition condition_of(const ::dyngen::EffectCondition& condition,
                             const std::vector<::dyngen::EffectParameter>& parameters) {
  EffectCondition result;
  result.spelling = spell(condition.left) + " <= " + spell(condition.right);
  result.text = condition.text;
  std::map<std::string, Index> place;
  for (const auto& parameter : parameters) {
    place.emplace(parameter.name, static_cast<Index>(place.size()));
  }
  // shared: GiNaC counts references without locks, and laws are copied by several threads
  const auto sides = std::make_shared<const ::dyngen::EffectCondition>(condition);
  result.slack = [sides, place](const VectorXd& p, const EffectScales& scales) {
    const auto value = [&](const std::string& name) {
      const auto found = place.find(name);
      return found == place.end() ? scale_value(scales, name) : p[found->second];
    };
    return evaluate(sides->right, value) - evaluate(sides->left, value);
  };
  return result;
}

/// States at the first sample, by the file's expressions.
class EffectStart {
 public:
  explicit EffectStart(const EffectFile& effect)
      : file_(std::make_shared<const EffectFile>(effect)) {}

  VectorXd operator()(const VectorXd& variables) const {
    const auto value = [&](const std::string& name) {
      const auto& read = file_->variables;
      const auto found = std::find(read.begin(), read.end(), name);
      if (found == read.end()) throw std::logic_error("start: there is no '" + name + "'");
      return variables[found - read.begin()];
    };
    VectorXd states = VectorXd::Zero(static_cast<Index>(file_->states.size()));
    for (Index s = 0; s < states.size(); ++s) {
      const auto& start = file_->states[static_cast<std::size_t>(s)].start;
      if (start) states[s] = evaluate(*start, value);
    }
    return states;
  }

 private:
  std::shared_ptr<const EffectFile> file_;  // shared: GiNaC counts references without locks
};

bool has_start(const EffectFile& effect) {
  return std::any_of(effect.states.begin(), effect.states.end(),
                     [](const auto& state) { return state.start.has_value(); });
}

}  // namespace

EffectLaw effect_law(const EffectFile& effect) {
  EffectLaw law;
  law.name = effect.name;
  law.family = effect.family;
  law.title = effect.title;
  law.kind = static_cast<EffectKind>(effect.kind);
  law.scope = static_cast<EffectScope>(effect.scope);
  law.acts_on_all = effect.acts_on_all();
  law.revolute_only = effect.revolute_only;
  law.dissipates = effect.dissipates;
  law.variables = effect.variables;
  law.outputs = static_cast<int>(effect.torque.size());
  for (const auto& parameter : effect.parameters) {
    if (effect.alignment && parameter.name == effect.alignment_parameter) {
      law.alignment_parameter = law.size();
      law.alignment = *effect.alignment == ::dyngen::AlignmentOperator::kDelay
                          ? AlignmentOperator::kDelay
                          : AlignmentOperator::kLag;
    }
    if (parameter.name == effect.midpoint) law.midpoint = law.size();
    law.parameters.push_back({.name = parameter.name,
                              .unit = unit_text(parameter.unit, JointUnits::kRevolute),
                              .meaning = parameter.meaning,
                              .role = static_cast<EffectRole>(parameter.role),
                              .logarithmic = parameter.logarithmic,
                              .grid = parameter.grid});
  }
  for (const auto& state : effect.states) law.states.push_back(state.name);
  for (const auto& test : effect.tests) law.tests.push_back(test.test);
  for (const auto& alias : effect.aliases) law.aliases.push_back(alias.family);
  for (const auto& part : effect.contains) law.contains.push_back(part.family);
  for (const auto& condition : effect.requirements) {
    law.requirements.push_back(condition_of(condition, effect.parameters));
  }
  for (const auto& condition : effect.falsifiers) {
    law.falsifiers.push_back(condition_of(condition, effect.parameters));
  }
  law.sizes = [parameters = std::make_shared<const std::vector<::dyngen::EffectParameter>>(
                   effect.parameters)](const EffectScales& scales) {
    return sizes_of(*parameters, scales);
  };
  const EffectEvaluation evaluation(effect);
  law.proportional = evaluation.is_proportional();
  law.evaluate = evaluation;
  law.moment = EffectMoment(effect);
  if (has_start(effect)) law.start = EffectStart(effect);
  return law;
}

std::vector<EffectLaw> effect_laws(const EffectCatalogue& catalogue) {
  std::vector<EffectLaw> laws;
  for (const auto& effect : catalogue.all()) laws.push_back(effect_law(*effect));
  return laws;
}

EffectCatalogue effect_catalogue(const std::vector<std::string>& folders) {
  EffectCatalogue catalogue;
  for (const std::string& folder : folders) catalogue.add_folder(folder);
  return catalogue;
}

std::vector<EffectInstance> effect_instances(const RobotModel& model,
                                             const EffectCatalogue& catalogue) {
  std::vector<EffectInstance> instances;
  for (const BoundEffect& bound : bind_effects(model, catalogue)) {
    EffectInstance instance;
    instance.law = effect_law(*bound.file);
    instance.link = bound.joint;
    if (bound.joint > 0) instance.joint = model.joint(bound.joint).coordinate;
    if (bound.other > 0) instance.other = model.joint(bound.other).coordinate;
    instance.parameters.resize(static_cast<Index>(bound.parameters.size()));
    for (std::size_t k = 0; k < bound.parameters.size(); ++k) {
      const Quantity& quantity = bound.parameters[k];
      instance.parameters[static_cast<Index>(k)] =
          quantity.unknown ? std::numeric_limits<double>::quiet_NaN() : to_double(quantity.value);
    }
    instances.push_back(std::move(instance));
  }
  return instances;
}

}  // namespace dyngen::runtime

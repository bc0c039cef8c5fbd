// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "gen/effect_file/units.h"
#include "gen/effect_programs/effect_programs.h"
#include "gen/program/evaluator.h"
#include "gen/symbols/exact.h"
#include "runtime/tools/dynid/effects/effect_evaluation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
  std::set<std::string> read;
  for (const EffectExpression* side : {&condition.left, &condition.right}) {
    for (const std::string& name : names_in(*side)) read.insert(name);
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (read.contains(parameters[p].name)) result.parameters.push_back(static_cast<int>(p));
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
  law.acts_inward = effect.acts_inward();
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
  for (const auto& condition : effect.usual) {
    law.usual.push_back(condition_of(condition, effect.parameters));
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

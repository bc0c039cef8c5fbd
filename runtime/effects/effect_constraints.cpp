// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_constraints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Friction parameters among the scales, with their kind in the model.
struct FrictionScale {
  double EffectScales::*scale;
  ParameterKind kind;
  const char* name;
};
constexpr FrictionScale kFrictionScales[] = {
    {&EffectScales::Fc, ParameterKind::kCoulomb, "Fc"},
    {&EffectScales::Fv, ParameterKind::kViscous, "Fv"},
    {&EffectScales::Ia, ParameterKind::kRotorInertia, "Ia"}};

double least_of(const EffectParameter& parameter, double min) {
  // the logarithm of a bound of 0 is none: as small as may ever be meant
  return by_logarithm(parameter) && !(min > 0) ? 1e-12 : min;
}

bool reads_friction_alone(const EffectLaw& law) {
  constexpr std::string_view kRead[] = {"qd", "sign_qd", "Fc", "Fv"};
  return law.dissipates && law.states.empty() && law.outputs == 1 && !law.acts_on_all &&
         std::all_of(law.variables.begin(), law.variables.end(), [&](const std::string& name) {
           return std::find(std::begin(kRead), std::end(kRead), name) != std::end(kRead);
         });
}

class Builder {
 public:
  Builder(const ScaleTable& scales, const EffectPoint& point, const EffectUnknowns& unknowns)
      : scales_(scales), point_(point), unknowns_(unknowns), x_(values_of(point, unknowns)) {}

  void add_bounds(std::size_t k) {
    const EffectInstance& effect = point_.effects[k];
    const EffectSizes sizes = effect.law.sizes(scales_.of(point_.beta, effect));
    for (Index p = 0; p < effect.law.size(); ++p) {
      const int place = unknowns_.parameters[k][static_cast<std::size_t>(p)];
      if (place < 0) continue;
      const EffectParameter& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
      const bool logarithm = by_logarithm(parameter);
      const double min = least_of(parameter, sizes.min[p]), max = sizes.max[p];
      const auto add_bound = [&](double bound, double sign, const char* relation) {
        if (!std::isfinite(bound)) return;
        RowVectorXd row = RowVectorXd::Zero(unknowns_.size);
        row[place] = sign;
        add(row, sign * (logarithm ? std::log(bound) : bound),
            {ConstraintName::Kind::kBound, static_cast<int>(k), static_cast<int>(p), effect.joint,
             fmt::format("{} {} {:.4g}", parameter.name, relation, bound)});
      };
      add_bound(min, 1, ">=");
      add_bound(max, -1, "<=");
    }
  }

  void add_requirements(std::size_t k) {
    const EffectInstance& effect = point_.effects[k];
    const EffectScales scales = scales_.of(point_.beta, effect);
    for (const EffectCondition& condition : effect.law.requirements) {
      const double slack = condition.slack(effect.parameters, scales);
      if (!std::isfinite(slack)) continue;
      RowVectorXd row = RowVectorXd::Zero(unknowns_.size);
      for (Index p = 0; p < effect.law.size(); ++p) {
        const int place = unknowns_.parameters[k][static_cast<std::size_t>(p)];
        if (place < 0) continue;
        const double step = 1e-6 * std::max(std::abs(effect.parameters[p]), 1e-6);
        VectorXd up = effect.parameters, down = effect.parameters;
        up[p] += step;
        down[p] -= step;
        const double chain =
            by_logarithm(effect.law.parameters[static_cast<std::size_t>(p)]) ? up[p] - step : 1;
        row[place] +=
            chain * (condition.slack(up, scales) - condition.slack(down, scales)) / (2 * step);
      }
      for (const FrictionScale& friction : kFrictionScales) {
        if (effect.joint < 0) break;
        const int place = parameter_of(scales_.model(), effect.joint, friction.kind);
        if (place < 0) continue;
        const double step = 1e-6 * std::max(scales.*friction.scale, 1e-6);
        EffectScales up = scales, down = scales;
        up.*friction.scale += step;
        down.*friction.scale -= step;
        row[place] +=
            (condition.slack(effect.parameters, up) - condition.slack(effect.parameters, down)) /
            (2 * step);
      }
      if (!row.allFinite() || row.isZero(0)) continue;
      add(row, row.dot(x_) - slack,
          {ConstraintName::Kind::kRequirement, static_cast<int>(k), -1, effect.joint,
           condition.spelling});
    }
  }

  void add_friction(int joint) {
    for (const FrictionScale& friction : kFrictionScales) {
      if (friction.kind == ParameterKind::kRotorInertia) continue;
      const int place = parameter_of(scales_.model(), joint, friction.kind);
      if (place < 0) continue;
      RowVectorXd row = RowVectorXd::Zero(unknowns_.size);
      row[place] = 1;
      add(row, 0,
          {ConstraintName::Kind::kFriction, -1, -1, joint, fmt::format("{} >= 0", friction.name)});
    }
  }

  /// Friction and the joint's dissipating effects together never drive it.
  void add_dissipation(int joint, const std::vector<std::size_t>& effects) {
    constexpr Index kSpeeds = 8;
    constexpr double kSlowest = 3e-3;  // of the largest speed
    const EffectScales scales = scales_.at(point_.beta, joint);
    if (!(scales.v_max > 0)) return;
    const int coulomb = parameter_of(scales_.model(), joint, ParameterKind::kCoulomb);
    const int viscous = parameter_of(scales_.model(), joint, ParameterKind::kViscous);
    for (Index i = 0; i < kSpeeds; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(kSpeeds - 1);
      const double speed = scales.v_max * std::pow(kSlowest, 1 - part);
      for (const double sign : {1.0, -1.0}) {
        RowVectorXd row = RowVectorXd::Zero(unknowns_.size);
        double torque = scales.Fc + scales.Fv * speed;
        if (coulomb >= 0) row[coulomb] += 1;
        if (viscous >= 0) row[viscous] += speed;
        for (const std::size_t k : effects) {
          torque += sign * at_speed(k, sign * speed, scales, sign, coulomb, viscous, row);
        }
        add(row, row.dot(x_) - torque,
            {ConstraintName::Kind::kDissipation, static_cast<int>(effects.front()), -1, joint,
             fmt::format("friction of joint {} dissipates at {:.3g}", joint + 1, sign * speed)});
      }
    }
  }

  void add_initial(std::size_t run, std::size_t k, const VectorXd& reach) {
    const int first = unknowns_.initial[run][k];
    for (Index s = 0; first >= 0 && s < reach.size(); ++s) {
      for (const double sign : {1.0, -1.0}) {
        RowVectorXd row = RowVectorXd::Zero(unknowns_.size);
        row[first + static_cast<int>(s)] = sign;
        add(row, -reach[s],
            {ConstraintName::Kind::kInitial, static_cast<int>(k), -1, -1,
             fmt::format("|{}| <= {:.3g} at the beginning of run {}",
                         point_.effects[k].law.states[static_cast<std::size_t>(s)], reach[s],
                         run + 1)});
      }
    }
  }

  EffectConstraints result() {
    EffectConstraints constraints;
    constraints.inequalities.G.resize(static_cast<Index>(rows_.size()), unknowns_.size);
    constraints.inequalities.h.resize(static_cast<Index>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      constraints.inequalities.G.row(static_cast<Index>(i)) = rows_[i];
      constraints.inequalities.h[static_cast<Index>(i)] = bounds_[i];
    }
    constraints.names = std::move(names_);
    return constraints;
  }

 private:
  void add(RowVectorXd row, double bound, ConstraintName name) {
    rows_.push_back(std::move(row));
    bounds_.push_back(bound);
    names_.push_back(std::move(name));
  }

  /// The torque of an effect at a speed; its slopes times `sign` go into the row.
  double at_speed(std::size_t k, double speed, const EffectScales& scales, double sign, int coulomb,
                  int viscous, RowVectorXd& row) const {
    const EffectInstance& effect = point_.effects[k];
    const EffectLaw& law = effect.law;
    const std::map<std::string, double> values = {
        {"qd", speed}, {"sign_qd", sign}, {"Fc", scales.Fc}, {"Fv", scales.Fv}};
    MatrixXd variables(1, static_cast<Index>(law.variables.size()));
    for (std::size_t v = 0; v < law.variables.size(); ++v) {
      variables(0, static_cast<Index>(v)) = values.at(law.variables[v]);
    }
    EffectWanted wanted;
    wanted.by_parameter = wanted.by_variable = true;
    VectorXd state;
    const EffectTorque torque = law.evaluate(variables, effect.parameters, 1e-3, state, wanted);
    for (Index p = 0; p < law.size(); ++p) {
      const int place = unknowns_.parameters[k][static_cast<std::size_t>(p)];
      if (place < 0) continue;
      const bool logarithm = by_logarithm(law.parameters[static_cast<std::size_t>(p)]);
      row[place] += sign * torque.by_parameter(0, p) * (logarithm ? effect.parameters[p] : 1);
    }
    for (std::size_t v = 0; v < law.variables.size(); ++v) {
      const double slope = sign * torque.by_variable(0, static_cast<Index>(v));
      if (law.variables[v] == "Fc" && coulomb >= 0) row[coulomb] += slope;
      if (law.variables[v] == "Fv" && viscous >= 0) row[viscous] += slope;
    }
    return torque.torque(0, 0);
  }

  const ScaleTable& scales_;
  const EffectPoint& point_;
  const EffectUnknowns& unknowns_;
  VectorXd x_;
  std::vector<RowVectorXd> rows_;
  std::vector<double> bounds_;
  std::vector<ConstraintName> names_;
};

}  // namespace

ScaleTable::ScaleTable(const EffectRecordings& data) : model_(data.model) {
  const VectorXd nothing = VectorXd::Zero(model_.size());
  for (int j = 0; j < model_.joints(); ++j) joints_.push_back(scales_of(data, nothing, j));
  largest_ = scales_of(data, nothing, -1);
}

EffectScales ScaleTable::at(const VectorXd& beta, int joint) const {
  EffectScales scales = joint < 0 ? largest_ : joints_[static_cast<std::size_t>(joint)];
  for (const FrictionScale& friction : kFrictionScales) {
    for (int j = 0; j < model_.joints(); ++j) {
      if (joint >= 0 && j != joint) continue;
      const int place = parameter_of(model_, j, friction.kind);
      if (place >= 0) scales.*friction.scale = std::max(scales.*friction.scale, beta[place]);
    }
  }
  return scales;
}

EffectConstraints constraints_at(const ScaleTable& scales, const EffectPoint& point,
                                 const EffectUnknowns& unknowns,
                                 const std::vector<VectorXd>& initial_reach) {
  Builder builder(scales, point, unknowns);
  std::map<int, std::vector<std::size_t>> dissipating;
  std::map<int, bool> with_friction;
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    builder.add_bounds(k);
    builder.add_requirements(k);
    if (effect.law.dissipates && effect.joint >= 0) with_friction[effect.joint] = true;
    if (reads_friction_alone(effect.law)) dissipating[effect.joint].push_back(k);
    for (std::size_t r = 0; r < unknowns.initial.size(); ++r) {
      builder.add_initial(r, k, initial_reach[k]);
    }
  }
  for (const auto& [joint, needed] : with_friction) builder.add_friction(joint);
  for (const auto& [joint, effects] : dissipating) builder.add_dissipation(joint, effects);
  return builder.result();
}

EffectPoint within_bounds(const ScaleTable& scales, EffectPoint point,
                          const EffectUnknowns& unknowns) {
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    EffectInstance& effect = point.effects[k];
    const EffectSizes sizes = effect.law.sizes(scales.of(point.beta, effect));
    for (Index p = 0; p < effect.law.size(); ++p) {
      if (unknowns.parameters[k][static_cast<std::size_t>(p)] < 0) continue;
      double& value = effect.parameters[p];
      const double min = least_of(effect.law.parameters[static_cast<std::size_t>(p)], sizes.min[p]);
      value = std::max(min, std::min(sizes.max[p], value));
    }
  }
  return point;
}

}  // namespace dyngen::runtime

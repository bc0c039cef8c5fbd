// SPDX-License-Identifier: MIT
#include "runtime/simulation/plant_effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::array<std::string_view, 14> kKnownVariables = {
    "q",  "qd", "qdd", "tau_load", "sign_qd", "q_other", "qd_other", "qdd_other", "tau_load_other",
    "Fc", "Fv", "Ia",  "t",        "temp"};

bool is_acceleration(std::string_view name) {
  return name.starts_with("qdd") || name.starts_with("tau_load");
}

void check(const EffectInstance& instance, Index joints) {
  const EffectLaw& law = instance.law;
  if (!acts_on_plant(law)) {
    throw std::invalid_argument("PlantEffects: '" + law.name +
                                "' changes what is recorded, not how the robot moves");
  }
  const bool pair = law.scope == EffectScope::kPair;
  if (instance.joint < 0 || instance.joint >= joints || (pair && instance.other < 0) ||
      instance.other >= joints) {
    throw std::invalid_argument("PlantEffects: '" + law.name + "' is of a joint that is not there");
  }
  if (instance.parameters.size() != law.size() || !instance.parameters.allFinite()) {
    throw std::invalid_argument("PlantEffects: '" + law.name + "' has parameters without a number");
  }
}

}  // namespace

bool acts_on_plant(const EffectLaw& law) {
  if (law.acts_on_all || law.alignment != AlignmentOperator::kNone) return false;
  return std::all_of(law.variables.begin(), law.variables.end(), [](const std::string& name) {
    return std::find(kKnownVariables.begin(), kKnownVariables.end(), name) != kKnownVariables.end();
  });
}

PlantEffects::PlantEffects(std::vector<EffectInstance> instances, EffectSurroundings surroundings)
    : instances_(std::move(instances)), surroundings_(std::move(surroundings)) {
  std::size_t variables = 0;
  for (const EffectInstance& instance : instances_) {
    check(instance, surroundings_.coulomb.size());
    first_state_.push_back(states_);
    states_ += instance.law.states.size();
    variables = std::max(variables, instance.law.variables.size());
    reads_acceleration_ =
        reads_acceleration_ ||
        std::any_of(instance.law.variables.begin(), instance.law.variables.end(),
                    [](const std::string& name) { return is_acceleration(name); });
  }
  variables_.resize(variables);
  torque_.resize(2);
  rate_.resize(std::max<std::size_t>(states_, 1));
}

void PlantEffects::fill(const EffectInstance& instance, const EffectMotion& motion) {
  const Index own = instance.joint, other = std::max(instance.other, 0);
  for (std::size_t v = 0; v < instance.law.variables.size(); ++v) {
    const std::string& name = instance.law.variables[v];
    const Index joint = name.ends_with("_other") ? other : own;
    double& value = variables_[v];
    if (name == "sign_qd") {
      value = motion.direction[own];
    } else if (name.starts_with("qdd")) {
      value = motion.ddq[joint];
    } else if (name.starts_with("qd")) {
      value = motion.dq[joint];
    } else if (name.starts_with("q")) {
      value = motion.q[joint];
    } else if (name.starts_with("tau_load")) {
      value = motion.load[joint];
    } else if (name == "Fc") {
      value = surroundings_.coulomb[own];
    } else if (name == "Fv") {
      value = surroundings_.viscous[own];
    } else if (name == "Ia") {
      value = surroundings_.rotor[own];
    } else if (name == "t") {
      value = motion.time;
    } else {
      value = surroundings_.temperature + surroundings_.warming * motion.time;
    }
  }
}

void PlantEffects::run(const EffectInstance& instance, const EffectMotion& motion,
                       const double* z) {
  fill(instance, motion);
  instance.law.moment(variables_.data(), instance.parameters.data(), z, torque_.data(),
                      rate_.data());
}

void PlantEffects::start(const EffectMotion& motion, double* z) {
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const EffectInstance& instance = instances_[i];
    if (!instance.law.start) continue;
    fill(instance, motion);
    const Eigen::VectorXd variables = Eigen::Map<const Eigen::VectorXd>(
        variables_.data(), static_cast<Index>(instance.law.variables.size()));
    const Eigen::VectorXd first = instance.law.start(variables);
    std::copy(first.begin(), first.end(), z + first_state_[i]);
  }
}

void PlantEffects::act(const EffectMotion& motion, const double* z, double* torque, double* rate) {
  std::fill_n(torque, surroundings_.coulomb.size(), 0.0);
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const EffectInstance& instance = instances_[i];
    const std::size_t first = first_state_[i];
    run(instance, motion, z + first);
    torque[instance.joint] += torque_[0];
    if (instance.law.outputs == 2) torque[instance.other] += torque_[1];
    std::copy_n(rate_.begin(), instance.law.states.size(), rate + first);
  }
}

Eigen::MatrixXd PlantEffects::acceleration_slope(const EffectMotion& motion, const double* z,
                                                 const Eigen::MatrixXd& M) {
  const Index n = surroundings_.coulomb.size();
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const EffectInstance& instance = instances_[i];
    for (std::size_t v = 0; v < instance.law.variables.size(); ++v) {
      const std::string& name = instance.law.variables[v];
      if (!is_acceleration(name)) continue;
      run(instance, motion, z + first_state_[i]);
      const double step = 1e-6 * (1 + std::abs(variables_[v]));
      std::array<double, 2> difference{};
      for (const double side : {1.0, -1.0}) {
        fill(instance, motion);
        variables_[v] += side * step;
        instance.law.moment(variables_.data(), instance.parameters.data(), z + first_state_[i],
                            torque_.data(), rate_.data());
        for (int o = 0; o < instance.law.outputs; ++o) {
          difference[static_cast<std::size_t>(o)] +=
              side * torque_[static_cast<std::size_t>(o)] / (2 * step);
        }
      }
      const Index joint = name.ends_with("_other") ? instance.other : instance.joint;
      Eigen::RowVectorXd by_ddq = Eigen::RowVectorXd::Unit(n, joint);
      if (name.starts_with("tau_load")) {
        by_ddq = M.row(joint);
        by_ddq[joint] -= surroundings_.rotor[joint];
      }
      slope.row(instance.joint) += difference[0] * by_ddq;
      if (instance.law.outputs == 2) slope.row(instance.other) += difference[1] * by_ddq;
    }
  }
  return slope;
}

double PlantEffects::dry_friction(const EffectMotion& motion, const double* z, Index joint) {
  double dry = 0;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const EffectInstance& instance = instances_[i];
    if (instance.joint != joint || !instance.law.reads("sign_qd")) continue;
    const auto place = static_cast<std::size_t>(
        std::find(instance.law.variables.begin(), instance.law.variables.end(), "sign_qd") -
        instance.law.variables.begin());
    for (const double direction : {1.0, -1.0}) {
      fill(instance, motion);
      variables_[place] = direction;
      instance.law.moment(variables_.data(), instance.parameters.data(), z + first_state_[i],
                          torque_.data(), rate_.data());
      dry += 0.5 * direction * torque_[0];
    }
  }
  return dry;
}

}  // namespace dyngen::runtime

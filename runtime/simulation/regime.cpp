// SPDX-License-Identifier: MIT
#include "runtime/simulation/regime.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::VectorXd;

constexpr int kMostIterations = 30;

}  // namespace

Regime::Regime(PlantModel plant)
    : model(std::move(plant)),
      direction(Eigen::VectorXi::Zero(model.joints)),
      stuck(model.joints),
      dry_(model.joints),
      zero_(VectorXd::Zero(model.joints)),
      push_(model.joints),
      friction_(model.joints),
      effect_(VectorXd::Zero(model.joints)),
      load_(model.joints),
      direction_values_(model.joints),
      rates_(std::max<std::size_t>(1, model.effects.states())),
      M_(model.joints, model.joints) {
  stuck.setConstant(false);
  for (Index j = 0; j < dry_.size(); ++j) dry_[j] = model.coulomb[j] > 0;
}

void Regime::find_dry_joints(const RobotState& state) {
  if (model.effects.empty()) return;
  dry_ = dry_friction(state, zero_).array() > 0;
}

VectorXd Regime::dry_friction(const RobotState& state, const VectorXd& ddq) {
  if (model.effects.empty()) return model.coulomb;
  const EffectMotion standing = motion(state, ddq.data());
  VectorXd level = model.coulomb;
  for (Index j = 0; j < level.size(); ++j) {
    const double own = model.effects.dry_friction(standing, state.z, j);
    // what is left of two that cancel (bristles in place of Coulomb friction) is rounding
    const double rounding = 1e-12 * (level[j] + std::abs(own));
    level[j] += own;
    if (level[j] < rounding) level[j] = 0;
  }
  return level;
}

/// Coulomb friction of the regime less that of sign(dq).
double Regime::overshoot(Index j, double dq) const {
  return dry_[j] ? model.coulomb[j] * (direction[j] - sign(dq)) : 0;
}

EffectMotion Regime::motion(const RobotState& state, const double* ddq) {
  model.rigid(state.q, state.dq, ddq, load_.data());
  const VectorXd& rotor = model.effects.rotor();
  for (Index j = 0; j < load_.size(); ++j) {
    load_[j] -= rotor[j] * ddq[j];
    direction_values_[j] = dry_[j] ? direction[j] : sign(state.dq[j]);
  }
  return {state.time, state.q, state.dq, ddq, load_.data(), direction_values_.data()};
}

void Regime::start(const RobotState& state, double* z) {
  if (effect_states() == 0) return;
  const VectorXd no_acceleration = VectorXd::Zero(model.joints);
  model.effects.start(motion(state, no_acceleration.data()), z);
}

/// Torque of the effects into effect_, rates of their states into rates_.
void Regime::act(const RobotState& state, const double* ddq) {
  if (model.effects.empty()) return;
  model.effects.act(motion(state, ddq), state.z, effect_.data(), rates_.data());
}

/// tau - c - g - friction - effects as they were last worked out
VectorXd Regime::pushing(const RobotState& state, const double* tau) {
  model.rigid(state.q, state.dq, zero_.data(), push_.data());
  model.friction(state.dq, friction_.data());
  for (Index j = 0; j < push_.size(); ++j) {
    push_[j] = tau[j] - push_[j] - friction_[j] - effect_[j] - overshoot(j, state.dq[j]);
  }
  return push_;
}

std::vector<Index> Regime::moving_joints() const {
  std::vector<Index> moving;
  for (Index j = 0; j < stuck.size(); ++j) {
    if (!stuck[j]) moving.push_back(j);
  }
  return moving;
}

/// Newton's method on M ddq + e(ddq) = tau - c - g - friction: effects are piecewise linear in
/// load and acceleration, as a rule, so that it ends after a few steps.
void Regime::solve_for_acceleration(const RobotState& state, const double* tau, double* ddq) {
  const std::vector<Index> moving = moving_joints();
  effect_.setZero();
  const VectorXd free = pushing(state, tau);
  model.mass_matrix(state.q, M_.data());
  Map<VectorXd> own(ddq, push_.size());
  own = accelerations(M_, free, moving);
  for (int k = 0; k < kMostIterations; ++k) {
    const EffectMotion now = motion(state, ddq);
    model.effects.act(now, state.z, effect_.data(), rates_.data());
    const VectorXd residual = (free - M_ * own - effect_)(moving);
    const Eigen::MatrixXd slope = M_ + model.effects.acceleration_slope(now, state.z, M_);
    const VectorXd step = slope(moving, moving).partialPivLu().solve(residual);
    // where the load changes its sign a full step may jump from one side to the other for ever
    const double share = k < 8 ? 1 : 0.5;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      own[moving[i]] += share * step[static_cast<Index>(i)];
    }
    if (step.cwiseAbs().maxCoeff() <= 1e-13 * (1 + own.cwiseAbs().maxCoeff())) break;
  }
  act(state, ddq);
}

void Regime::accelerate(const RobotState& state, const double* tau, double* ddq, double* rates) {
  if (model.effects.reads_acceleration()) {
    if (stuck.all()) {
      std::fill_n(ddq, push_.size(), 0.0);
      act(state, ddq);
    } else {
      solve_for_acceleration(state, tau, ddq);
    }
  } else {
    act(state, zero_.data());
    if (stuck.any()) {
      const VectorXd torque = pushing(state, tau);
      model.mass_matrix(state.q, M_.data());
      Map<VectorXd>(ddq, push_.size()) = accelerations(M_, torque, moving_joints());
    } else {
      for (Index j = 0; j < push_.size(); ++j) {
        push_[j] = tau[j] - effect_[j] - overshoot(j, state.dq[j]);
      }
      model.forward(state.q, state.dq, push_.data(), ddq);
    }
  }
  std::copy_n(rates_.begin(), model.effects.states(), rates);
}

RestingJoints Regime::rest(const RobotState& state, const double* tau) {
  Eigen::Array<bool, Eigen::Dynamic, 1> at_rest(push_.size());
  for (Index j = 0; j < push_.size(); ++j) at_rest[j] = is_dry(j) && state.dq[j] == 0;
  for (Index j = 0; j < push_.size(); ++j) {
    if (at_rest[j]) direction[j] = 0;
  }
  VectorXd level = dry_friction(state, zero_);
  model.mass_matrix(state.q, M_.data());
  act(state, zero_.data());
  RestingJoints joints = resting_joints(M_, pushing(state, tau), level, at_rest);
  // what effects need while others accelerate: of the solution before
  constexpr int kPasses = 5;
  for (int k = 0; k < kPasses && model.effects.reads_acceleration(); ++k) {
    level = dry_friction(state, joints.ddq);
    act(state, joints.ddq.data());
    joints = resting_joints(M_, pushing(state, tau), level, at_rest);
  }
  if (model.effects.reads_acceleration()) {
    // who stays is known: the others' accelerations to the end
    const auto before = stuck;
    const Eigen::VectorXi sliding = direction;
    stuck = at_rest && joints.direction.array() == 0;
    for (Index j = 0; j < direction.size(); ++j) {
      if (at_rest[j]) direction[j] = joints.direction[j];
    }
    if (!stuck.all()) solve_for_acceleration(state, tau, joints.ddq.data());
    stuck = before;
    direction = sliding;
  }
  return joints;
}

Regime::Held Regime::held(const RobotState& state, const double* tau) {
  VectorXd ddq(push_.size());
  accelerate(state, tau, ddq.data(), rates_.data());
  const VectorXd torque = pushing(state, tau);
  model.mass_matrix(state.q, M_.data());
  return {torque - M_ * ddq, dry_friction(state, ddq)};
}

}  // namespace dyngen::runtime

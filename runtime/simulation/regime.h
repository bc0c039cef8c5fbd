// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/simulation/plant_model.h"
#include "runtime/simulation/stiction.h"

namespace dyngen::runtime {

/// -1, 0 or 1.
inline int sign(double x) { return static_cast<int>(x > 0) - static_cast<int>(x < 0); }

/// A moment of a simulation: n values each, and the states of effects.
struct RobotState {
  double time = 0;
  const double* q = nullptr;
  const double* dq = nullptr;
  const double* z = nullptr;
};

/// The dynamics while no joint changes between standing and sliding.
class Regime {
 public:
  explicit Regime(PlantModel plant);

  PlantModel model;
  Eigen::VectorXi direction;  ///< of sliding: the sign that dry friction has
  Eigen::Array<bool, Eigen::Dynamic, 1> stuck;

  [[nodiscard]] std::size_t effect_states() const { return model.effects.states(); }
  /// States of effects with which a robot begins, under the load that it has without acceleration.
  void start(const RobotState& state, double* z);
  /// Which joints have dry friction at a state: what is_dry() says from then on.
  void find_dry_joints(const RobotState& state);
  [[nodiscard]] bool is_dry(Eigen::Index j) const { return dry_[j]; }
  /// What a joint at rest can resist: Fs and what effects add to it, under the load that it has
  /// while the others accelerate by ddq. (n) N m or N, not negative
  Eigen::VectorXd dry_friction(const RobotState& state, const Eigen::VectorXd& ddq);

  /// ddq at a state near the regime's, and the rates of the effects' states: a velocity that
  /// overshoots zero within a step keeps its friction, so that what is integrated is smooth.
  void accelerate(const RobotState& state, const double* tau, double* ddq, double* rates);

  /// How joints at rest go on under a torque: of all with dry friction and no velocity.
  RestingJoints rest(const RobotState& state, const double* tau);

  /// What friction holds at the joints that are stuck, and could hold. (n) each
  struct Held {
    Eigen::VectorXd torque, most;
  };
  Held held(const RobotState& state, const double* tau);

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  [[nodiscard]] double overshoot(Eigen::Index j, double dq) const;
  EffectMotion motion(const RobotState& state, const double* ddq);
  void act(const RobotState& state, const double* ddq);
  Eigen::VectorXd pushing(const RobotState& state, const double* tau);
  void solve_for_acceleration(const RobotState& state, const double* tau, double* ddq);
  [[nodiscard]] std::vector<Eigen::Index> moving_joints() const;

  Eigen::Array<bool, Eigen::Dynamic, 1> dry_;
  Eigen::VectorXd zero_, push_, friction_, effect_, load_, direction_values_;
  std::vector<double> rates_;
  RowMajor M_;
};

}  // namespace dyngen::runtime

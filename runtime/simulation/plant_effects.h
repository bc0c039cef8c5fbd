// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "runtime/effects/effect_law.h"

namespace dyngen::runtime {

/// What a moving robot's effects read besides its motion, (n) each.
struct EffectSurroundings {
  Eigen::VectorXd coulomb, viscous;  ///< Fc, Fv
  Eigen::VectorXd rotor;             ///< Ia: part of the mass matrix, not of the load
  double temperature = 25;           ///< temp at the start, in the unit of the recording
  double warming = 0;                ///< its rate, per second
};

/// A moment of the robot's motion, (n) each.
struct EffectMotion {
  double time = 0;
  const double* q = nullptr;
  const double* dq = nullptr;
  const double* ddq = nullptr;
  const double* load = nullptr;       ///< torque of the rigid links without the rotors
  const double* direction = nullptr;  ///< sign of each velocity: of sliding where it is zero
};

/// Effects that act while a robot moves, with their states one after the other.
///
/// May keep buffers: one thread at a time.
class PlantEffects {
 public:
  PlantEffects() = default;
  /// @param instances  with numbers for all parameters
  /// @throws std::invalid_argument  if one cannot act on a moving robot (acts_on_plant()), a joint
  ///         does not exist, or a parameter has no number
  PlantEffects(std::vector<EffectInstance> instances, EffectSurroundings surroundings);

  [[nodiscard]] bool empty() const { return instances_.empty(); }
  [[nodiscard]] std::size_t states() const { return states_; }
  /// Whether torque depends on ddq, by itself or by the load.
  [[nodiscard]] bool reads_acceleration() const { return reads_acceleration_; }
  [[nodiscard]] const Eigen::VectorXd& rotor() const { return surroundings_.rotor; }

  /// States with which a robot begins: what the effects' files say. @param z  of all states
  void start(const EffectMotion& motion, double* z);

  /// Torque that the actuators need in addition, (n), and dz/dt of all states.
  void act(const EffectMotion& motion, const double* z, double* torque, double* rate);

  /// d torque / d ddq, (n x n): by acceleration and load, the mass matrix of the links being M.
  Eigen::MatrixXd acceleration_slope(const EffectMotion& motion, const double* z,
                                     const Eigen::MatrixXd& M);

  /// What effects add to the dry friction of a joint at rest: half of the step of its torque
  /// between both directions.
  double dry_friction(const EffectMotion& motion, const double* z, Eigen::Index joint);

 private:
  void fill(const EffectInstance& instance, const EffectMotion& motion);
  void run(const EffectInstance& instance, const EffectMotion& motion, const double* z);

  std::vector<EffectInstance> instances_;
  EffectSurroundings surroundings_;
  std::vector<std::size_t> first_state_;
  std::size_t states_ = 0;
  bool reads_acceleration_ = false;
  std::vector<double> variables_, torque_, rate_;
};

/// Whether an effect acts while the robot moves; the others change what is recorded.
bool acts_on_plant(const EffectLaw& law);

}  // namespace dyngen::runtime

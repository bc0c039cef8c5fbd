// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "runtime/control/control_model.h"
#include "runtime/control/friction_compensation.h"
#include "runtime/control/gains.h"

namespace dyngen::runtime {

/// With e = q_ref - q:
enum class ControlLaw {
  kPd,              ///< tau = kp e + kd e'
  kGravity,         ///< tau = kp e + kd e' + g(q)
  kFeedforward,     ///< tau = kp e + kd e' + rigid(q_ref, dq_ref, ddq_ref)
  kComputedTorque,  ///< tau = rigid(q, dq, ddq_ref + kd e' + kp e)
};

/// The velocity at which friction is compensated.
enum class FrictionVelocity {
  kReference,  ///< free of noise; wrong where the joint does not follow
  kMeasured,   ///< true also where the joint is pushed; carries the noise of dq
};

struct ControllerOptions {
  ControlLaw law = ControlLaw::kComputedTorque;
  Gains gains;
  /// Adds the model's friction and offset; not to plain PD, which has no model.
  bool friction = false;
  FrictionVelocity friction_velocity = FrictionVelocity::kReference;
  /// (n) rad/s or m/s: FrictionCompensation; empty: kDefaultBand for every joint
  Eigen::VectorXd friction_band;
  Eigen::VectorXd torque_limit;  ///< (n) N m or N, positive or infinite; empty: none

  static constexpr double kDefaultBand = 0.02;

  /// @throws std::invalid_argument  naming the option, what was found and what was expected
  void validate(int joints) const;
};

/// What a controller is fed, n values each. dq is measured, or from VelocityFilter.
struct ControlInput {
  const double* q = nullptr;
  const double* dq = nullptr;
  const double* q_ref = nullptr;
  const double* dq_ref = nullptr;
  const double* ddq_ref = nullptr;
};

/// A control law over a robot's model: step() once every cycle of the loop.
///
/// step() does not throw, allocate, lock or wait, if the model's functions do not; its time does
/// not depend on the values. The law has no memory, so it may be asked at any rate. An input that
/// is no number gives a torque that is none: check sensors before.
///
/// Sources: the laws are those of Craig, "Introduction to Robotics", ch. "Nonlinear control of
/// manipulators".
class Controller {
 public:
  /// @throws std::invalid_argument  if an option is wrong or the model lacks a function of the law
  Controller(ControlModel model, ControllerOptions options);

  /// @param tau  n values, N m or N: written
  /// @return     how many joints ask for more than their torque limit
  int step(const ControlInput& input, double* tau) noexcept;

  [[nodiscard]] int joints() const { return model_.joints; }
  [[nodiscard]] const ControllerOptions& options() const { return options_; }

 private:
  void feedback(const ControlInput& input, double* result) const noexcept;

  ControlModel model_;
  ControllerOptions options_;
  std::optional<FrictionCompensation> friction_;
  Eigen::VectorXd scratch_;
};

/// "pd", "gravity", "ff", "ct".
std::string law_name(ControlLaw law);

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "runtime/simulation/plant_model.h"

namespace dyngen::runtime {

struct IntegrationOptions {
  /// Error of a step allowed in each of q, dq: tolerance * (1 + |value| + step * |its rate|)
  double tolerance = 1e-10;
  double max_step = 0.01;  ///< s

  /// @throws std::invalid_argument  unless both are positive and finite
  void validate() const;
};

/// Torque at the joints, n values, N m or N. Must be smooth between calls of Plant::advance().
using TorqueSource =
    std::function<void(double time, const double* q, const double* dq, double* tau)>;

struct PlantCounts {
  long steps = 0;      ///< accepted
  long reversals = 0;  ///< located: a velocity became zero
  long releases = 0;   ///< located: a joint began to slide between calls of advance()
};

/// A robot that moves: forward dynamics with dry friction, integrated by Runge and Kutta's formulas
/// of Dormand and Prince, order 5 with an error estimate of order 4 (Boost.odeint).
///
/// Dry friction is not smoothed. A joint slides in a known direction until its velocity is zero;
/// that moment is located to 1e-13 s, and the velocity is zero exactly. A joint at rest stays while
/// the torque that holds it is at most Fs, several joints at once (resting_joints()): its q does
/// not change in a single bit. The moment when it begins to slide is located too. An excursion of
/// the torque beyond Fs and back within one step (max_step at most) is not seen.
class Plant {
 public:
  /// @throws std::invalid_argument  if the model or an option is wrong, or a size differs
  Plant(PlantModel model, const IntegrationOptions& options, const Eigen::VectorXd& q,
        const Eigen::VectorXd& dq);
  ~Plant();
  Plant(Plant&&) noexcept;
  Plant& operator=(Plant&&) noexcept;

  /// Moves on to the time `until`, s.
  /// @throws std::runtime_error  if the motion does not stay below 1e5 (SI units), or events do not
  /// come to an
  ///         end
  void advance(const TorqueSource& torque, double until);

  [[nodiscard]] double time() const;  ///< s, from 0
  [[nodiscard]] Eigen::VectorXd q() const;
  [[nodiscard]] Eigen::VectorXd dq() const;
  /// Under this torque, put on now.
  [[nodiscard]] Eigen::VectorXd acceleration(const Eigen::VectorXd& torque) const;
  /// (n) s: how long each joint was held by friction so far
  [[nodiscard]] const Eigen::VectorXd& stuck_time() const;
  [[nodiscard]] const PlantCounts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dyngen::runtime

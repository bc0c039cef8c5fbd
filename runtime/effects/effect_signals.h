// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/effects/effect_recordings.h"

namespace dyngen::runtime {

/// A derivative by some of the model's parameters.
struct ModelDerivative {
  std::vector<int> columns;  ///< places in beta, ascending
  Eigen::MatrixXd values;    ///< (N x columns)
};

/// A recording or a robot does not have a signal that an effect reads.
class MissingSignalError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The signals that variables of effects stand for, over the runs of recordings and for given
/// parameters of the model.
///
///     q qd qdd tau_load sign_qd        of the effect's joint; q_other .. tau_load_other of its
///                                      partner. tau_load = Y beta over the inertial parameters,
///                                      held ones included
///     Fc Fv Ia                         friction and rotor of the joint, in beta or held; 0 if in
///                                      neither
///     t temp                           s from the recording's first sample; as recorded
///     torque torque_rate torque_acc    of the whole model, and its central differences
///     tau_load_rate tau_load_acc
///     d_* payload_* contact_* wrench_* of EffectRobot::tangents
///
/// sign_qd turns only when the joint has come back by 2.5 steps of its encoder from where it was
/// farthest, and then from the sample on since which the velocity has had that direction: the noise
/// of a velocity near 0 has no part in it. Where no step is known it is the plain sign.
///
/// Keeps what it computed until beta changes.
class EffectSignals {
 public:
  /// @param data  must outlive it
  explicit EffectSignals(const EffectRecordings& data) : data_(data) {}

  /// @param beta  (nb)
  void set_beta(const Eigen::VectorXd& beta);
  /// Where derivatives of the rigid model are taken. They multiply an effect that is small, so that
  /// an older beta is good enough while an estimate converges.
  void set_tangent_beta(const Eigen::VectorXd& beta);

  /// What EffectLaw::evaluate reads.
  /// @param target  the joint whose torque is asked for, where the effect acts on all; else unused
  /// @return        (N x nv)
  /// @throws MissingSignalError  if the recording or the robot does not have a signal
  /// @throws std::invalid_argument  if there is no variable of such a name
  Eigen::MatrixXd variables(std::size_t run, const EffectInstance& effect, int target);

  /// d e / d beta through the variables; that of the rigid model's derivatives is left out.
  /// @param by_variable  (N x nv): d e / d variable
  ModelDerivative by_model(std::size_t run, const EffectInstance& effect, int target,
                           const Eigen::MatrixXd& by_variable);

  /// Y beta, and the torque of held numbers. @return (N x n)
  const Eigen::MatrixXd& torque(std::size_t run);
  /// The torque of held numbers, of a model that has some. @return (N x n)
  const Eigen::MatrixXd& held_torque(std::size_t run);
  /// Rows of the regressor at all samples. @return (N x model.columns[joint].size())
  const Eigen::MatrixXd& regressor_rows(std::size_t run, int joint);
  /// Their rates behind the parallel filter. @return (equations x model.columns[joint].size())
  const Eigen::MatrixXd& filtered_rates(std::size_t run, int joint);

 private:
  struct RigidTorque {
    Eigen::MatrixXd torque, load;  ///< (N x n)
  };

  const RigidTorque& rigid(std::size_t run);
  const Eigen::MatrixXd& tangent(std::size_t run, const std::string& name, int link);
  /// The same further on; the latest distance is kept.
  const Eigen::MatrixXd& tangent_at(std::size_t run, const std::string& name, int link,
                                    double further);
  [[nodiscard]] TangentColumns tangents(std::size_t run, const TangentKey& wanted,
                                        double further) const;
  Eigen::VectorXd signal(std::size_t run, const std::string& name, const EffectInstance& effect,
                         int target);

  const EffectRecordings& data_;
  Eigen::VectorXd beta_, tangent_beta_;
  std::map<std::size_t, RigidTorque> rigid_;
  std::map<std::pair<std::size_t, TangentKey>, Eigen::MatrixXd> tangents_;  // of a run
  struct Further {
    double distance = 0;
    Eigen::MatrixXd columns;      ///< there
    Eigen::MatrixXd slope, bend;  ///< columns = those at 0 + distance (slope + distance bend)
  };
  std::map<std::pair<std::size_t, TangentKey>, Further> further_;  // of a run
  std::size_t rows_run_ = 0;  // of regressor_rows_: one run, since they are large
  std::map<int, Eigen::MatrixXd> regressor_rows_;
  std::map<std::pair<std::size_t, int>, Eigen::MatrixXd> filtered_rates_;
  std::map<std::size_t, Eigen::MatrixXd> held_torque_;
};

/// The sign of a joint's velocity with a dead band of travel: it turns where the velocity does, if
/// the joint then goes back by more than the band.
/// @param band  rad or m; 0: the plain sign of dq
Eigen::VectorXd travelled_sign(const Eigen::VectorXd& q, const Eigen::VectorXd& dq, double band);

/// Whether a variable changes with the model's parameters (those of EffectRobot::tangents apart).
bool depends_on_model(const std::string& variable);

}  // namespace dyngen::runtime

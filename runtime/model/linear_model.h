// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// What a parameter of a LinearModel is.
enum class ParameterKind { kInertial, kRotorInertia, kViscous, kCoulomb, kOffset };

/// A parameter that torque is linear in.
struct LinearParameter {
  std::string name;  ///< "ZZR2"
  std::string unit;
  std::string formula;  ///< what is grouped in it: "ZZ2 + IA2 + L^2*M3"
  int link = 0;         ///< from 1
  ParameterKind kind = ParameterKind::kInertial;
  std::optional<double> value;  ///< of the robot file; none if unknown there
};

/// Of many samples, (N x n) each: a motion, or the derivatives of something by it.
struct JointMotion {
  Eigen::MatrixXd q, dq, ddq;
};

/// Parameters that keep their numbers: they move the robot and are in no beta.
struct HeldParameters {
  /// Their torque, (N x n); that of the inertial ones alone if asked for. May be called from
  /// several threads.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& q, const Eigen::MatrixXd& dq,
                                const Eigen::MatrixXd& ddq, bool inertial_only)>
      torque;
  /// (n) held numbers of each joint, 0 where none is: Coulomb and viscous friction, rotor inertia
  Eigen::VectorXd coulomb, viscous, rotor;

  [[nodiscard]] double of(ParameterKind kind, int joint) const;
};

/// A robot as estimation sees it: tau = Y(q, dq, ddq) beta, with a minimal beta. Where numbers are
/// held their torque comes to it.
struct LinearModel {
  std::string name;
  std::vector<std::string> joint_names;
  std::vector<bool> revolute;
  std::vector<LinearParameter> parameters;
  /// columns[j]: the parameters that can act on joint j, ascending; the others are zero in its row.
  std::vector<std::vector<int>> columns;

  /// Y of many samples. q, dq, ddq: (N x n). Y becomes (N x n * nb): element (joint j, parameter c)
  /// of sample k is Y(k, j * size() + c), so that an equation's samples stand together.
  /// May be called from several threads. @throws std::invalid_argument  if a size is wrong
  std::function<void(const Eigen::MatrixXd& q, const Eigen::MatrixXd& dq,
                     const Eigen::MatrixXd& ddq, Eigen::MatrixXd& Y)>
      regressor;

  /// The gradients of s_k = sum_jc A_jc Y_jc of every sample k by its own q, dq and ddq.
  /// A: (N x n * nb) as Y. Coulomb friction's sign(dq) has none. May be empty: then nothing can be
  /// optimised. May be called from several threads.
  /// @throws std::invalid_argument  if a size is wrong
  std::function<JointMotion(const JointMotion& motion, const Eigen::MatrixXd& A)>
      regressor_gradient;

  std::shared_ptr<const HeldParameters> held;  ///< null: none

  [[nodiscard]] int joints() const { return static_cast<int>(joint_names.size()); }
  [[nodiscard]] int size() const { return static_cast<int>(parameters.size()); }

  /// tau = Y beta of many samples, and the torque of held numbers. @return (N x n)
  [[nodiscard]] Eigen::MatrixXd torque(const Eigen::MatrixXd& q, const Eigen::MatrixXd& dq,
                                       const Eigen::MatrixXd& ddq,
                                       const Eigen::VectorXd& beta) const;
};

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// One generated model: its size, its names and its functions. The only door to generated code; the
/// rest of the runtime sees no header that dyngen wrote. Fill it from the header of a robot whose
/// parameters are baked (the default) and whose scalar is double:
///
///     const ModelFunctions arm{"arm2", ARM2_NQ, {arm2_joint_names, arm2_joint_names + ARM2_NQ},
///                              arm2_id, arm2_gravity, arm2_coriolis, arm2_friction};
///
/// A function that was not generated is null.
struct ModelFunctions {
  std::string name;
  int nq = 0;                            ///< joint coordinates
  std::vector<std::string> joint_names;  ///< nq of them

  /// tau = M(q) ddq + c(q, dq) + g(q) + friction; q rad or m, tau N m or N, nq values each
  void (*id)(const double* q, const double* dq, const double* ddq, double* tau) = nullptr;
  void (*gravity)(const double* q, double* tau) = nullptr;                     ///< g(q)
  void (*coriolis)(const double* q, const double* dq, double* tau) = nullptr;  ///< c(q, dq)
  void (*friction)(const double* dq, double* tau) = nullptr;  ///< friction and offset

  /// @throws std::invalid_argument  if nq < 1, the count of names is not nq, or there is no
  /// function
  void validate() const;
};

/// The checked calls, for code that may allocate. A real-time loop calls the pointers.
///
/// @param q dq ddq  nq values each            @return  tau, nq values
/// @throws std::invalid_argument  if a vector has another size, or the function was not generated
Eigen::VectorXd inverse_dynamics(const ModelFunctions& model, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& dq, const Eigen::VectorXd& ddq);
Eigen::VectorXd gravity(const ModelFunctions& model, const Eigen::VectorXd& q);
Eigen::VectorXd coriolis(const ModelFunctions& model, const Eigen::VectorXd& q,
                         const Eigen::VectorXd& dq);
Eigen::VectorXd friction(const ModelFunctions& model, const Eigen::VectorXd& dq);

}  // namespace dyngen::runtime

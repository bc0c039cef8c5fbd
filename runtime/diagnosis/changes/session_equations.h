// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/evidence/joint_columns.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {

/// Of each run: the session that it belongs to. A session is one file: what was mounted, warm or
/// tightened when it was recorded.
struct SessionPlan {
  std::vector<int> of_run;  ///< place of each run's session, those of the reference first
  int reference = 0;        ///< sessions of the reference
  int later = 0;            ///< sessions after it

  [[nodiscard]] int sessions() const { return reference + later; }
};

/// The whitened equations of one session as a triangle.
struct SessionEquations {
  bool later = false;
  /// (K + 1 x K + 1) R with R'R = A'A, A = [regressor, further columns, torque] over all joints
  Eigen::MatrixXd triangle;
  /// The same of the first and the second half of each run.
  Eigen::MatrixXd first, second;
};

/// @param blocks   of each run: regressor, torque to explain, and which equations count
/// @param noise    that whitens them
/// @param further  columns beside the regressor, over the equations of all runs
std::vector<SessionEquations> session_equations(const std::vector<RowBlock>& blocks,
                                                const SessionPlan& plan,
                                                const std::vector<JointNoise>& noise,
                                                const JointColumns& further);

/// Parameters that fit each session by itself, one column a session; directions that a session does
/// not determine are 0 there. @param common  how many columns of A, from the first, are fitted
Eigen::MatrixXd estimates_of_sessions(const std::vector<SessionEquations>& sessions,
                                      Eigen::Index common);

/// (n) rms of the torque over the equations that count.
Eigen::VectorXd torque_rms(const std::vector<RowBlock>& blocks);

}  // namespace dyngen::runtime

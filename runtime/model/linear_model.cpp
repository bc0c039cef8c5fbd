// SPDX-License-Identifier: MIT
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

double HeldParameters::of(ParameterKind kind, int joint) const {
  switch (kind) {
    case ParameterKind::kCoulomb:
      return coulomb[joint];
    case ParameterKind::kViscous:
      return viscous[joint];
    case ParameterKind::kRotorInertia:
      return rotor[joint];
    default:
      return 0;
  }
}

Eigen::MatrixXd LinearModel::torque(const Eigen::MatrixXd& q, const Eigen::MatrixXd& dq,
                                    const Eigen::MatrixXd& ddq, const Eigen::VectorXd& beta) const {
  constexpr Eigen::Index kBlock = 1024;
  Eigen::MatrixXd tau(q.rows(), joints());
  Eigen::MatrixXd Y;
  for (Eigen::Index start = 0; start < q.rows(); start += kBlock) {
    const Eigen::Index count = std::min(kBlock, q.rows() - start);
    regressor(q.middleRows(start, count), dq.middleRows(start, count), ddq.middleRows(start, count),
              Y);
    for (int j = 0; j < joints(); ++j) {
      tau.col(j).segment(start, count) = Y.middleCols(j * size(), size()) * beta;
    }
  }
  if (held) tau += held->torque(q, dq, ddq, false);
  return tau;
}

}  // namespace dyngen::runtime

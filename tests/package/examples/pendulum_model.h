// SPDX-License-Identifier: MIT
// The pendulum as a model that is linear in its parameters.
#pragma once

#include "pendulum.h"
#include "runtime/model/linear_model.h"

inline dyngen::runtime::LinearModel pendulum_model() {
  using namespace dyngen::runtime;
  LinearModel model;
  model.name = "pendulum";
  model.joint_names = {"joint1"};
  model.revolute = {true};
  model.parameters = {{.name = "ZZ1", .unit = "kg m^2", .formula = "ZZ1", .link = 1},
                      {.name = "MX1", .unit = "kg m", .formula = "MX1", .link = 1},
                      {.name = "FV1",
                       .unit = "N m s/rad",
                       .formula = "FV1",
                       .link = 1,
                       .kind = ParameterKind::kViscous}};
  model.columns = {{0, 1, 2}};
  model.regressor = [](const Eigen::MatrixXd& q, const Eigen::MatrixXd& dq,
                       const Eigen::MatrixXd& ddq, Eigen::MatrixXd& Y) {
    Y.resize(q.rows(), 3);
    for (Eigen::Index k = 0; k < q.rows(); ++k) {
      Eigen::RowVector3d row;
      pendulum::base_regressor(&q(k, 0), &dq(k, 0), &ddq(k, 0), row.data());
      Y.row(k) = row;
    }
  };
  model.regressor_gradient = [](const JointMotion& motion, const Eigen::MatrixXd& A) {
    JointMotion gradient;
    gradient.q = A.col(1).array() * pendulum::kGravity * motion.q.col(0).array().cos();
    gradient.dq = A.col(2);
    gradient.ddq = A.col(0);
    return gradient;
  };
  return model;
}

// SPDX-License-Identifier: MIT
// The pendulum as a model that is linear in its parameters.
#pragma once

#include <optional>

#include "pendulum.h"
#include "runtime/model/linear_model.h"

inline dyngen::runtime::LinearModel pendulum_model() {
  using namespace dyngen::runtime;
  LinearModel model;
  model.name = "pendulum";
  model.joint_names = {"joint1"};
  model.revolute = {true};
  using enum ParameterKind;
  model.parameters = {{"ZZ1", "kg m^2", "ZZ1", 1, kInertial, std::nullopt},
                      {"MX1", "kg m", "MX1", 1, kInertial, std::nullopt},
                      {"FV1", "N m s/rad", "FV1", 1, kViscous, std::nullopt}};
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

// SPDX-License-Identifier: MIT
#include "runtime/consistency/pseudo_inertia.h"

#include <ceres/jet.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/consistency/log_cholesky_map.h"

namespace dyngen::runtime {

Eigen::Matrix4d pseudo_inertia(const TenParameters& ten) {
  const double XX = ten[0], YY = ten[3], ZZ = ten[5];
  Eigen::Matrix4d J;
  J << (YY + ZZ - XX) / 2, -ten[1], -ten[2], ten[6],  //
      -ten[1], (XX + ZZ - YY) / 2, -ten[4], ten[7],   //
      -ten[2], -ten[4], (XX + YY - ZZ) / 2, ten[8],   //
      ten[6], ten[7], ten[8], ten[9];
  return J;
}

TenParameters ten_parameters(const Eigen::Matrix4d& J) {
  return log_cholesky_map::ten_parameters<double>(J);
}

double smallest_eigenvalue(const TenParameters& ten) {
  if (!ten.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(pseudo_inertia(ten), Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

bool is_consistent(const TenParameters& ten) { return smallest_eigenvalue(ten) > 0; }

Eigen::Matrix4d upper_factor(const Eigen::Matrix4d& J) {
  // With rows and columns in reverse order it is the lower factor.
  const Eigen::Matrix4d reversed = J.reverse();
  const Eigen::LLT<Eigen::Matrix4d> cholesky(reversed);
  if (!J.allFinite() || cholesky.info() != Eigen::Success) {
    throw std::invalid_argument("upper_factor(): the pseudo-inertia is not positive definite");
  }
  const Eigen::Matrix4d L = cholesky.matrixL();
  return L.reverse();
}

LogCholesky log_cholesky(const Eigen::Matrix4d& J) {
  const Eigen::Matrix4d U = upper_factor(J);
  const double size = U(3, 3);
  LogCholesky theta;
  theta << std::log(size), std::log(U(0, 0) / size), std::log(U(1, 1) / size),
      std::log(U(2, 2) / size), U(0, 1) / size, U(1, 2) / size, U(0, 2) / size, U(0, 3) / size,
      U(1, 3) / size, U(2, 3) / size;
  return theta;
}

Eigen::Matrix4d from_log_cholesky(const LogCholesky& theta) {
  return log_cholesky_map::square<double>(log_cholesky_map::factor<double>(theta));
}

Eigen::Matrix<double, 10, 10> log_cholesky_jacobian(const LogCholesky& theta) {
  using Jet = ceres::Jet<double, 10>;
  log_cholesky_map::Ten<Jet> moving;
  for (int k = 0; k < 10; ++k) moving[k] = Jet(theta[k], k);
  const auto ten = log_cholesky_map::ten_parameters<Jet>(
      log_cholesky_map::square<Jet>(log_cholesky_map::factor<Jet>(moving)));
  Eigen::Matrix<double, 10, 10> jacobian;
  for (int k = 0; k < 10; ++k) jacobian.row(k) = ten[k].v.transpose();
  return jacobian;
}

}  // namespace dyngen::runtime

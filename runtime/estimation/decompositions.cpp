// SPDX-License-Identifier: MIT
#include "runtime/estimation/decompositions.h"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void check_finite(const MatrixXd& A) {
  if (A.allFinite()) return;
  throw NotFiniteError(
      "numbers are too large to compute with: the squares of some torque or regressor exceed "
      "1e308");
}

Eigen::CompleteOrthogonalDecomposition<MatrixXd> orthogonal(const MatrixXd& A, double tolerance) {
  check_finite(A);
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition(A.rows(), A.cols());
  if (tolerance > 0) decomposition.setThreshold(tolerance);
  decomposition.compute(A);
  return decomposition;
}

}  // namespace

SingularValues decomposed(const MatrixXd& A) {
  check_finite(A);
  if (A.size() == 0) {
    return {MatrixXd::Zero(A.rows(), 0), VectorXd::Zero(0), MatrixXd::Identity(A.cols(), A.cols())};
  }
  // divided and conquered: several times as fast as Jacobi's rotations, and as exact as the largest
  // singular value's rounding, which is all that ranks and conditions ask for
  const Eigen::BDCSVD<MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

VectorXd singular_values(const MatrixXd& A) {
  check_finite(A);
  if (A.size() == 0) return VectorXd::Zero(0);
  return Eigen::BDCSVD<MatrixXd>(A).singularValues();
}

MatrixXd triangle_of(const MatrixXd& A) {
  MatrixXd workspace = A;
  return triangle_in_place(workspace);
}

MatrixXd triangle_in_place(MatrixXd& A) {
  if (A.size() == 0) return MatrixXd::Zero(A.cols(), A.cols());
  const Index size = A.cols(), rows = std::min(size, A.rows());
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(A);
  MatrixXd R = MatrixXd::Zero(size, size);
  R.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  for (Index i = 0; i < rows; ++i) {
    if (R(i, i) < 0) R.row(i) = -R.row(i);
  }
  return R;
}

MatrixXd least_norm_solution(const MatrixXd& A, const MatrixXd& B, double tolerance) {
  if (A.size() == 0) return MatrixXd::Zero(A.cols(), B.cols());
  return orthogonal(A, tolerance).solve(B);
}

MatrixXd pseudo_inverse(const MatrixXd& A, double tolerance) {
  if (A.size() == 0) return MatrixXd::Zero(A.cols(), A.rows());
  return orthogonal(A, tolerance).pseudoInverse();
}

VectorXd unit_scale(const MatrixXd& A) {
  VectorXd scale = A.colwise().norm();
  for (double& length : scale) length = length > 0 ? 1 / length : 1;
  return scale;
}

MatrixXd complement_of(const MatrixXd& Q) {
  if (Q.cols() == 0) return MatrixXd::Identity(Q.rows(), Q.rows());
  const MatrixXd all = Eigen::HouseholderQR<MatrixXd>(Q).householderQ();
  return all.rightCols(Q.rows() - Q.cols());
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/estimation/matrix_products.h"

#if DYNGEN_WITH_BLAS
#include <cblas.h>
#endif

namespace dyngen::runtime {

using Eigen::MatrixXd;
using Eigen::Ref;

#if DYNGEN_WITH_BLAS

/// An OpenBLAS that was built without threads does not guard its work space against those of a
/// program: of 40 000 products on two threads 38 came out wrong (0.3.21). Which one a program gets
/// is known when it runs.
bool multiplies_by_blas() {
  static const bool safe = openblas_get_parallel() != OPENBLAS_SEQUENTIAL;
  return safe;
}

namespace {

/// A dimension as BLAS takes it.
blasint dimension(Eigen::Index size) { return static_cast<blasint>(size); }

/// C = factor op(A) B + keep C
void multiply(CBLAS_TRANSPOSE op, double factor, const Ref<const MatrixXd>& A,
              const Ref<const MatrixXd>& B, double keep, Ref<MatrixXd> C) {
  cblas_dgemm(CblasColMajor, op, CblasNoTrans, dimension(C.rows()), dimension(C.cols()),
              dimension(B.rows()), factor, A.data(), dimension(A.outerStride()), B.data(),
              dimension(B.outerStride()), keep, C.data(), dimension(C.outerStride()));
}

}  // namespace

MatrixXd transposed_product(const Ref<const MatrixXd>& A, const Ref<const MatrixXd>& B) {
  if (!multiplies_by_blas()) return A.transpose() * B;
  MatrixXd product = MatrixXd::Zero(A.cols(), B.cols());
  if (product.size() > 0 && B.rows() > 0) multiply(CblasTrans, 1, A, B, 0, product);
  return product;
}

void subtract_product(const Ref<const MatrixXd>& A, const Ref<const MatrixXd>& B, Ref<MatrixXd> C) {
  if (!multiplies_by_blas()) {
    C.noalias() -= A * B;
  } else if (C.size() > 0 && B.rows() > 0) {
    multiply(CblasNoTrans, -1, A, B, 1, C);
  }
}

void multiply_on_own_thread() { openblas_set_num_threads(1); }

#else

MatrixXd transposed_product(const Ref<const MatrixXd>& A, const Ref<const MatrixXd>& B) {
  return A.transpose() * B;
}

void subtract_product(const Ref<const MatrixXd>& A, const Ref<const MatrixXd>& B, Ref<MatrixXd> C) {
  C.noalias() -= A * B;
}

bool multiplies_by_blas() { return false; }

void multiply_on_own_thread() {}

#endif

}  // namespace dyngen::runtime

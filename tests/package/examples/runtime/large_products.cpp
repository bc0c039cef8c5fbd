// SPDX-License-Identifier: MIT
// Products of large matrices, by OpenBLAS where dyngen was built with it, on the thread that asks.
#include <Eigen/Core>

#include "runtime/estimation/matrix_products.h"

int main() {
  dyngen::runtime::multiply_on_own_thread();
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(300, 20);
  const Eigen::MatrixXd product = dyngen::runtime::transposed_product(A, A);
  return product.isApprox(A.transpose() * A, 1e-12) ? 0 : 1;
}

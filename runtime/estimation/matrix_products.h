// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

// Products of large matrices: by OpenBLAS where the build has it, which uses all that the processor
// can do; Eigen, built for every processor of a kind, does not. Sums are in another order then, so
// that last digits differ from one to the other, and with the processor.

/// A' B
/// @param A  (m x n), @param B  (m x k), columns of which lie together   @return (n x k)
Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                   const Eigen::Ref<const Eigen::MatrixXd>& B);

/// C - A B, in C
/// @param A  (m x n), @param B  (n x k), @param C  (m x k)
void subtract_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                      const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Ref<Eigen::MatrixXd> C);

/// Whether products are OpenBLAS's: the build has it, and what the program runs with is safe to use
/// from several threads.
bool multiplies_by_blas();

/// Products take no threads of their own from now on, in the whole process: for programs whose
/// threads have work enough. Nothing happens where products are Eigen's.
void multiply_on_own_thread();

}  // namespace dyngen::runtime

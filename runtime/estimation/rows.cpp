// SPDX-License-Identifier: MIT
#include "runtime/estimation/rows.h"

namespace dyngen::runtime {

Eigen::MatrixXd residual(const RowBlock& block, const Eigen::VectorXd& beta) {
  Eigen::MatrixXd rest = block.tau;
  for (Eigen::Index j = 0; j < rest.cols(); ++j) {
    rest.col(j).noalias() -= block.Y.middleCols(j * beta.size(), beta.size()) * beta;
  }
  return rest;
}

TorqueFactor factor_of(const RowSource& source, const std::vector<std::vector<int>>& columns,
                       int parameters) {
  TorqueFactor factor = empty_factor(columns, parameters);
  source([&](const RowBlock& block) { absorb(factor, block.Y, block.tau); });
  return factor;
}

}  // namespace dyngen::runtime

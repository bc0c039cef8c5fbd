// SPDX-License-Identifier: MIT
#include "runtime/estimation/rows.h"

#include <algorithm>

namespace dyngen::runtime {

Eigen::VectorXd counted_rows(const RowBlock& block) {
  if (block.counted.size() != 0) return block.counted.colwise().sum().transpose();
  return Eigen::VectorXd::Constant(block.tau.cols(), static_cast<double>(block.tau.rows()));
}

void clear_rounding(Eigen::MatrixXd& Y, Eigen::Index joints) {
  constexpr double kRounding = 1e-12;  // of the largest element: some thousand operations
  const Eigen::Index columns = Y.cols() / std::max<Eigen::Index>(1, joints);
  if (Y.rows() == 0 || columns == 0) return;
  for (Eigen::Index j = 0; j < joints; ++j) {
    auto own = Y.middleCols(j * columns, columns);
    const Eigen::RowVectorXd largest = own.cwiseAbs().colwise().maxCoeff();
    const double least = kRounding * largest.maxCoeff();
    for (Eigen::Index c = 0; c < columns; ++c) {
      if (largest[c] <= least) own.col(c).setZero();
    }
  }
}

void absorb(TorqueFactor& factor, const RowBlock& block) {
  absorb(factor, block.Y, block.tau);
  if (block.counted.size() == 0) return;
  const Eigen::VectorXd counted = counted_rows(block);
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    factor.joints[j].rows +=
        counted[static_cast<Eigen::Index>(j)] - static_cast<double>(block.tau.rows());
  }
}

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
  source([&](const RowBlock& block) { absorb(factor, block); });
  return factor;
}

}  // namespace dyngen::runtime

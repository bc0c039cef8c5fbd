// SPDX-License-Identifier: MIT
#include "runtime/effects/equation_stack.h"

#include <numeric>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Whitening Whitening::by_weights(const VectorXd& weights) {
  Whitening whitening;
  for (const double weight : weights) {
    AutoregressiveNoise noise;
    noise.innovation = noise.deviation = 1 / weight;
    whitening.joints.push_back({noise, {}});
  }
  return whitening;
}

EquationStack::EquationStack(const EffectRecordings& data, const Whitening& whitening)
    : data_(data), whiteners_(whitening.joints.size()) {
  for (const EffectRun& run : data.runs) {
    for (std::size_t j = 0; j < whiteners_.size(); ++j) {
      whiteners_[j].emplace_back(whitening.joints[j], run.rows.counted.col(static_cast<Index>(j)));
    }
    run_starts_.push_back(of_joint_);
    of_joint_ += run.rows.Y.rows();
  }
  rows_ = of_joint_ * data.joints();
}

void EquationStack::whiten(Eigen::Ref<MatrixXd> columns, std::size_t run, int joint) const {
  whiteners_[static_cast<std::size_t>(joint)][run].apply(columns);
}

MatrixXd EquationStack::stacked(const EffectEquations& equations) const {
  MatrixXd all = MatrixXd::Zero(rows_, equations.size + 1);
  for (std::size_t run = 0; run < equations.blocks.size(); ++run) {
    const RowBlock& block = equations.blocks[run];
    for (int j = 0; j < data_.joints(); ++j) {
      auto part = all.middleRows(first(j) + run_starts_[run], block.tau.rows());
      for (const int c : equations.columns[static_cast<std::size_t>(j)]) {
        part.col(c) = block.Y.col(Index{j} * equations.size + c);
      }
      part.rightCols(1) = block.tau.col(j);
      whiten(part, run, j);
    }
  }
  return all;
}

MatrixXd EquationStack::plain(EffectSignals& signals, const EffectInstance& effect) const {
  std::vector<int> wanted(static_cast<std::size_t>(1 + effect.law.size()));
  std::iota(wanted.begin(), wanted.end(), 0);
  MatrixXd all = MatrixXd::Zero(rows_, 1 + effect.law.size());
  for (std::size_t run = 0; run < data_.runs.size(); ++run) {
    const EffectSignature signature = signature_of(data_, signals, run, effect, wanted);
    for (std::size_t i = 0; i < signature.joints.size(); ++i) {
      const int j = signature.joints[i];
      const auto counted = data_.runs[run].rows.counted.col(j);
      all.middleRows(first(j) + run_starts_[run], signature.columns[i].rows()) =
          counted.asDiagonal() * signature.columns[i];
    }
  }
  return all;
}

MatrixXd EquationStack::whitened(MatrixXd columns) const {
  for (std::size_t run = 0; run < data_.runs.size(); ++run) {
    for (int j = 0; j < data_.joints(); ++j) {
      whiten(columns.middleRows(first(j) + run_starts_[run], data_.runs[run].rows.tau.rows()), run,
             j);
    }
  }
  return columns;
}

MatrixXd orthonormal(const MatrixXd& W) {
  if (W.cols() == 0) return W;
  const VectorXd scale = unit_scale(W);
  const SingularValues svd = decomposed(triangle_of(W) * scale.asDiagonal());
  const Index rank = (svd.values.array() > kRankTolerance * svd.values[0]).count();
  MatrixXd basis = W * (scale.asDiagonal() * svd.V.leftCols(rank) *
                        svd.values.head(rank).cwiseInverse().asDiagonal());
  // once more: what the division by small singular values left of right angles
  const MatrixXd R = triangle_of(basis);
  R.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(basis);
  return basis;
}

MatrixXd Projection::rest(const MatrixXd& columns) const {
  MatrixXd left = columns - basis_ * (basis_.transpose() * columns);
  left -= basis_ * (basis_.transpose() * left);
  return left;
}

}  // namespace dyngen::runtime

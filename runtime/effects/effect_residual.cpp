// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_residual.h"

#include <utility>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd residual_rms(const std::vector<RowBlock>& blocks, const VectorXd& x) {
  VectorXd squares, counts;
  for (const RowBlock& block : blocks) {
    const VectorXd here = residual(block, x).colwise().squaredNorm();
    const VectorXd rows = counted_rows(block);
    squares = squares.size() == 0 ? here : squares + here;
    counts = counts.size() == 0 ? rows : counts + rows;
  }
  return squares.cwiseQuotient(counts.cwiseMax(1)).cwiseSqrt();
}

VectorXd residual_with_effects(const EffectRecordings& data, const EffectPoint& point) {
  return residual_rms(without_effects(data, point), point.beta);
}

std::vector<RowBlock> without_effects(const EffectRecordings& data, const EffectPoint& point) {
  EffectSignals signals(data);
  signals.set_beta(point.beta);
  signals.set_tangent_beta(point.beta);
  const EffectPoint here =
      point.initial.size() == data.runs.size() ? point : at_rest(data, point.beta, point.effects);
  const EffectUnknowns unknowns = base_unknowns(here);
  EffectEquations equations = linearised(data, signals, here, unknowns);
  // what the derivatives by beta added to Y goes back into the torque
  for (std::size_t run = 0; run < equations.blocks.size(); ++run) {
    RowBlock& block = equations.blocks[run];
    const MatrixXd rest = residual(block, here.beta);
    RowBlock plain = data.runs[run].rows;
    plain.counted = block.counted;
    plain.tau = rest;
    for (int j = 0; j < data.joints(); ++j) {
      for (Index k = 0; k < rest.rows(); ++k) {
        auto row = plain.Y.row(k).segment(j * here.beta.size(), here.beta.size());
        if (block.counted(k, j) == 0) row.setZero();
        plain.tau(k, j) += row.dot(here.beta);
      }
    }
    block = std::move(plain);
  }
  return std::move(equations.blocks);
}

}  // namespace dyngen::runtime

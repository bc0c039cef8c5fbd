// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/heldout.h"

#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RunResiduals residuals_of(const EffectRecordings& data, const EffectPoint& point) {
  RunResiduals residuals;
  for (const RowBlock& block : without_effects(data, point)) {
    residuals.push_back(residual(block, point.beta).cwiseProduct(block.counted));
  }
  return residuals;
}

VectorXd whitened_squares(const EffectRecordings& data, const RunResiduals& residuals,
                          const TorqueNoiseModel& noise) {
  VectorXd squares = VectorXd::Zero(data.joints());
  for (Index j = 0; j < squares.size(); ++j) {
    const Whitener whitener(noise.joints[static_cast<std::size_t>(j)]);
    for (std::size_t run = 0; run < residuals.size(); ++run) {
      MatrixXd rest = residuals[run].col(j);
      whitener.apply(rest, data.runs[run].rows.counted.col(j));
      squares[j] += rest.squaredNorm();
    }
  }
  return squares;
}

VectorXd heldout_squares(const EffectRecordings& heldout, EffectPoint point,
                         const TorqueNoiseModel& noise) {
  point.initial.clear();
  return whitened_squares(heldout, residuals_of(heldout, point), noise);
}

}  // namespace dyngen::runtime

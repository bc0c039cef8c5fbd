// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/heldout.h"

#include <algorithm>
#include <cmath>

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
  for (const MatrixXd& rest : residuals) {
    for (Index j = 0; j < rest.cols(); ++j) {
      const AutoregressiveNoise& process = noise.joints[static_cast<std::size_t>(j)];
      for (Index t = 0; t < rest.rows(); ++t) {
        double innovation = rest(t, j);
        const Index inside = std::min<Index>(process.coefficients.size(), t);
        for (Index k = 0; k < inside; ++k)
          innovation -= process.coefficients[k] * rest(t - 1 - k, j);
        squares[j] += innovation * innovation / (process.innovation * process.innovation);
      }
    }
  }
  return squares;
}

VectorXd rms_of(const EffectRecordings& data, const RunResiduals& residuals) {
  VectorXd squares = VectorXd::Zero(data.joints()), counts = squares;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    squares += residuals[run].colwise().squaredNorm().transpose();
    counts += data.runs[run].rows.counted.colwise().sum().transpose();
  }
  return squares.cwiseQuotient(counts.cwiseMax(1)).cwiseSqrt();
}

}  // namespace dyngen::runtime

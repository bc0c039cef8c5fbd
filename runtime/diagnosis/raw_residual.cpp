// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/raw_residual.h"

#include <cmath>

#include "runtime/effects/effect_signals.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RunResiduals raw_residuals(const EffectRecordings& data, const EffectPoint& point) {
  EffectRecordings raw = data;
  for (EffectRun& run : raw.runs) run.decimator = design_decimator(1);
  EffectSignals signals(raw);
  signals.set_beta(point.beta);
  signals.set_tangent_beta(point.beta);
  RunResiduals residuals;
  for (std::size_t run = 0; run < raw.runs.size(); ++run) {
    MatrixXd rest = raw.runs[run].motion.tau - signals.torque(run);
    for (const EffectInstance& effect : point.effects) {
      const EffectSignature signature = signature_of(raw, signals, run, effect);
      for (std::size_t i = 0; i < signature.joints.size(); ++i) {
        rest.col(signature.joints[i]) -= signature.columns[i].col(0);
      }
    }
    residuals.push_back(std::move(rest));
  }
  return residuals;
}

VectorXd raw_rms(const EffectRecordings& data, const RunResiduals& residuals) {
  VectorXd squares = VectorXd::Zero(data.joints()), counts = squares;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    const EffectRun& here = data.runs[run];
    const Index first = first_sample(here.decimator), factor = here.decimator.factor;
    for (Index j = 0; j < squares.size(); ++j) {
      for (Index k = 0; k < here.rows.Y.rows(); ++k) {
        if (here.rows.counted(k, j) == 0) continue;
        squares[j] +=
            residuals[run].col(j).segment(first + k * factor - factor / 2, factor).squaredNorm();
        counts[j] += static_cast<double>(factor);
      }
    }
  }
  return squares.cwiseQuotient(counts.cwiseMax(1)).cwiseSqrt();
}

VectorXd raw_floor(const EffectRecordings& data, const RunResiduals& residuals,
                   const std::vector<double>& repeats) {
  VectorXd squares = VectorXd::Zero(data.joints()), counts = squares;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    const auto factor = static_cast<double>(data.runs[run].decimator.factor);
    const auto period = static_cast<Index>(std::llround(repeats[run] * factor));
    const Index rows = residuals[run].rows() - period;
    if (period < 1 || rows < 1) continue;
    for (Index j = 0; j < squares.size(); ++j) {
      const auto e = residuals[run].col(j);
      squares[j] += 0.5 * (e.tail(rows) - e.head(rows)).squaredNorm();
      counts[j] += static_cast<double>(rows);
    }
  }
  if (counts.minCoeff() < 1) return raw_rms(data, residuals);
  return squares.cwiseQuotient(counts).cwiseSqrt();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/beside_white_noise.h"

#include "runtime/effects/absorption.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::VectorXd;

EvidenceSystem beside_white_noise(const EffectRecordings& data, EffectSignals& signals,
                                  const std::vector<Hypothesis>& hypotheses,
                                  const CompetitionResult& result,
                                  EvidenceSystem::Options options) {
  TorqueNoiseModel white = result.noise;
  // a joint without equations leaves nothing, and has noise of unit variance
  const VectorXd rms = (result.fit.rms.array() > 0).select(result.fit.rms, 1.0);
  white.joints = quick_noise(white_noise(rms).joints);
  options.surrogates = 0;
  return system_beside(data, signals, hypotheses, result, result.fit.point, white, options);
}

RunResiduals rests_of(const EffectRecordings& data, const EvidenceSystem& white,
                      const VectorXd& deviation) {
  RunResiduals residuals;
  for (const EffectRun& run : data.runs) {
    residuals.emplace_back(run.rows.Y.rows(), data.joints());
  }
  for (int j = 0; j < data.joints(); ++j) {
    const VectorXd rest = deviation[j] * white.rest(j);
    Index start = 0;
    for (std::size_t run = 0; run < residuals.size(); ++run) {
      const Index rows = residuals[run].rows();
      residuals[run].col(j) =
          rest.segment(start, rows).cwiseProduct(data.runs[run].rows.counted.col(j));
      start += rows;
    }
  }
  return residuals;
}

}  // namespace dyngen::runtime

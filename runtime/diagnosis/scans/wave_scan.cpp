// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/wave_scan.h"

#include <algorithm>
#include <numbers>

#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr int kMostWaves = 5;  // half waves over the range of a position

double range_of(const EffectRecordings& data, int joint) {
  double lowest = data.runs.front().motion.q(0, joint), highest = lowest;
  for (const EffectRun& run : data.runs) {
    lowest = std::min(lowest, run.motion.q.col(joint).minCoeff());
    highest = std::max(highest, run.motion.q.col(joint).maxCoeff());
  }
  return highest - lowest;
}

}  // namespace

Waves waves_of(const EffectRecordings& data, int first, int second) {
  const double range = range_of(data, first), other = range_of(data, second);
  Waves waves;
  if (!(range > 0) || !(other > 0)) return waves;
  waves.frequencies.resize(2, 2 * kMostWaves * kMostWaves);
  Index column = 0;
  for (int i = 1; i <= kMostWaves; ++i) {
    for (int k = -kMostWaves; k <= kMostWaves; ++k) {
      if (k != 0) waves.frequencies.col(column++) << i / range, k / other;
    }
  }
  waves.frequencies *= std::numbers::pi;
  waves.shapes = wave_shapes(data, first, second, waves.frequencies);
  return waves;
}

WaveScan scan_waves(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                    const Waves& waves, bool surrogates) {
  WaveScan scan;
  if (surrogates) scan.score.surrogates = Eigen::VectorXd::Zero(system.surrogates());
  if (waves.frequencies.cols() == 0) return scan;
  const auto groups = system.products_of_groups(
      system.whitened(counted_columns(data, joint, waves.shapes)), 2, surrogates);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Score score = score_of(groups[i], surrogates);
    if (surrogates) score.surrogates = score.surrogates.cwiseMax(scan.score.surrogates);
    const bool better = score.delta_chi2 > scan.score.delta_chi2;
    if (better) {
      scan.frequency = waves.frequencies.col(static_cast<Index>(i));
      scan.score = std::move(score);
    } else if (surrogates) {
      scan.score.surrogates = std::move(score.surrogates);
    }
  }
  return scan;
}

}  // namespace dyngen::runtime

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

WaveScan scan_waves(const EffectRecordings& data, const EvidenceSystem& system,
                    const GenericStructure& structure, bool surrogates) {
  WaveScan scan;
  if (surrogates) scan.score.surrogates = Eigen::VectorXd::Zero(system.surrogates());
  const double first = range_of(data, structure.variables[0].joint);
  const double second = range_of(data, structure.variables[1].joint);
  if (!(first > 0) || !(second > 0)) return scan;
  Eigen::Matrix2Xd frequencies(2, 2 * kMostWaves * kMostWaves);
  Index column = 0;
  for (int i = 1; i <= kMostWaves; ++i) {
    for (int k = -kMostWaves; k <= kMostWaves; ++k) {
      if (k != 0) frequencies.col(column++) << i / first, k / second;
    }
  }
  frequencies *= std::numbers::pi;
  const auto groups = system.products_of_groups(
      system.whitened(wave_columns(data, structure, frequencies)), 2, surrogates);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Score score = score_of(groups[i], surrogates);
    if (surrogates) score.surrogates = score.surrogates.cwiseMax(scan.score.surrogates);
    const bool better = score.squares > scan.score.squares;
    if (better) {
      scan.frequency = frequencies.col(static_cast<Index>(i));
      scan.score = std::move(score);
    } else if (surrogates) {
      scan.score.surrogates = std::move(score.surrogates);
    }
  }
  return scan;
}

}  // namespace dyngen::runtime

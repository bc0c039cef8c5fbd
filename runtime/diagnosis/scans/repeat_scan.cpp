// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/repeat_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/diagnosis/scans/turning.h"
#include "runtime/signals/decimation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<double, 3> kBands = {kWidestRepeatBand / 4, kWidestRepeatBand / 2,
                                          kWidestRepeatBand};
constexpr double kOfRate = 0.4;  // of the equations' rate: no band beyond it

double row_time(const EffectRun& run) {
  return run.motion.sample_time * static_cast<double>(run.decimator.factor);
}

/// How many harmonics of a run there are up to a frequency.
Index harmonics_of(const EffectRun& run, double period, double frequency) {
  if (!(period > 0)) return 0;
  return static_cast<Index>(frequency * period * row_time(run));
}

/// Squares per degree of freedom between the harmonics; at least 1.
double level_beside(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                    const std::vector<double>& repeats, double band) {
  const Score between = score_of(
      system.products(system.whitened(harmonic_columns(data, joint, repeats, band, 0.5)), false),
      false);
  return between.degrees > 0 ? std::max(1.0, between.squares / between.degrees) : 1;
}

}  // namespace

RepeatScan scan_repeats(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                        const std::vector<double>& repeats, bool surrogates) {
  RepeatScan scan;
  if (surrogates) scan.score.surrogates = VectorXd::Zero(system.surrogates());
  double highest = kBands.back();
  for (const EffectRun& run : data.runs) highest = std::min(highest, kOfRate / row_time(run));
  double most = 0;  // deviations above noise
  for (const double band : kBands) {
    if (band > highest) break;
    const JointColumns columns = harmonic_columns(data, joint, repeats, band);
    if (columns.columns() == 0) continue;
    Score score = score_of(system.products(system.whitened(columns), surrogates), surrogates);
    if (score.degrees == 0) continue;
    score.squares /= level_beside(data, system, joint, repeats, band);
    const double above = (score.squares - score.degrees) / std::sqrt(2.0 * score.degrees);
    if (scan.score.degrees > 0 && above <= most) continue;
    most = above;
    scan.frequency = band;
    scan.score = std::move(score);
  }
  return scan;
}

JointColumns harmonic_columns(const EffectRecordings& data, int joint,
                              const std::vector<double>& repeats, double frequency, double aside) {
  Index count = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    count += 2 * harmonics_of(data.runs[run], repeats[run], frequency);
  }
  MatrixXd part = MatrixXd::Zero(data.equations(), count);
  Index start = 0, column = 0;
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    const EffectRun& run = data.runs[r];
    const Index rows = run.rows.Y.rows(), harmonics = harmonics_of(run, repeats[r], frequency);
    if (harmonics > 0) {
      // of the recording's time: another filter's equations begin elsewhere
      const double turn = 2 * M_PI / repeats[r];
      const double first = run.motion.time[first_sample(run.decimator)] / row_time(run);
      Turning line(Eigen::ArrayXd::LinSpaced(rows, first, first + static_cast<double>(rows - 1)),
                   (1 - aside) * turn, turn);
      const auto counted = run.rows.counted.col(joint).array();
      for (Index k = 1; k <= harmonics; ++k, line.next()) {
        if (static_cast<double>(k) - aside > kOfRate * repeats[r]) {
          column += 2;  // the parallel filter takes it away
          continue;
        }
        part.col(column++).segment(start, rows) = counted * line.cosine();
        part.col(column++).segment(start, rows) = counted * line.sine();
      }
    }
    start += rows;
  }
  return columns_of_joint(joint, std::move(part));
}

}  // namespace dyngen::runtime

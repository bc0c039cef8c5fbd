// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/repeat_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/diagnosis/scans/turning.h"
#include "runtime/signals/decimation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<double, 3> kBands = {kWidestRepeatBand / 4, kWidestRepeatBand / 2,
                                          kWidestRepeatBand};
constexpr double kOfRate = 0.4;    // of the equations' rate: no band beyond it
constexpr Index kMostBetween = 4;  // lines between two harmonics: more tell little more

double row_time(const EffectRun& run) {
  return run.motion.sample_time * static_cast<double>(run.decimator.factor);
}

/// Whole periods of a run; a run of fewer than two has no lines between its harmonics.
Index periods_of(const EffectRun& run, double period) {
  return period > 0 ? static_cast<Index>(static_cast<double>(run.rows.Y.rows()) / period) : 0;
}

/// How many harmonics of a run there are up to a frequency.
Index harmonics_of(const EffectRun& run, double period, double frequency) {
  if (periods_of(run, period) < 2) return 0;
  return static_cast<Index>(frequency * period * row_time(run));
}

/// Chi-square of the lines between the harmonics.
struct Level {
  double squares = 0, degrees = 0;
  [[nodiscard]] double of_noise() const {
    return degrees > 0 ? std::max(1.0, squares / degrees) : 1;
  }
};

/// A run of P periods tells P - 1 lines between two harmonics apart.
Level level_beside(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                   const std::vector<double>& repeats, double band) {
  Index fewest = std::numeric_limits<Index>::max();
  for (std::size_t run = 0; run < repeats.size(); ++run) {
    const Index periods = periods_of(data.runs[run], repeats[run]);
    if (periods >= 2) fewest = std::min(fewest, periods);
  }
  Level level;
  for (Index line = 1; line < std::min(fewest, kMostBetween + 1); ++line) {
    const double aside =
        static_cast<double>(line) / static_cast<double>(std::min(fewest, kMostBetween + 1));
    const Score between =
        score_of(system.products(
                     system.whitened(harmonic_columns(data, joint, repeats, band, aside)), false),
                 false);
    level.squares += between.delta_chi2;
    level.degrees += between.degrees;
  }
  return level;
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
    const Level level = level_beside(data, system, joint, repeats, band);
    score.delta_chi2 /= level.of_noise();
    const double above = (score.delta_chi2 - score.degrees) / std::sqrt(2.0 * score.degrees);
    if (scan.score.degrees > 0 && above <= most) continue;
    most = above;
    scan.frequency = band;
    scan.score = std::move(score);
    scan.worth = level.degrees;
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

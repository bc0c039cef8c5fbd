// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/line_scan.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFinest = 2;     // frequencies for each that the longest run resolves
constexpr double kReached = 0.9;  // of half the rate of the equations

/// The next length whose Fourier transform is quick: of factors 2, 3 and 5.
Index quick_length(Index length) {
  for (;; ++length) {
    Index rest = length;
    for (const Index factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return length;
  }
}

/// Chi-square reductions of the sinusoids of all frequencies k / duration.
class Periodogram {
 public:
  Periodogram(double duration, Index lines) : duration_(duration), lines_(lines) {}

  /// @param rows  of one run, dt s apart
  VectorXd of(const VectorXd& rows, double dt, double counted) {
    const auto length = static_cast<std::size_t>(std::llround(duration_ / dt));
    std::vector<double> padded(length, 0.0);
    std::copy(rows.data(), rows.data() + rows.size(), padded.begin());
    std::vector<std::complex<double>> spectrum;
    fft_.fwd(spectrum, padded);
    VectorXd squares = VectorXd::Zero(lines_);
    const auto present = std::min(lines_, static_cast<Index>(spectrum.size() / 2));
    for (Index k = 0; k < present; ++k) {
      squares[k] = 2 * std::norm(spectrum[static_cast<std::size_t>(k)]) / counted;
    }
    return squares;
  }

 private:
  double duration_;
  Index lines_;
  Eigen::FFT<double> fft_;
};

/// Part of a line's chi-square that it has so many lines beside its own.
double leaked(Index lines) {
  const double x = std::numbers::pi * static_cast<double>(lines) / kFinest;
  return std::pow(std::sin(x) / x, 2);
}

/// Chi-squares of lines over the mean of those around them, where that is above noise: the noise
/// model may be too low in a part of the band, and what is broad is no line.
/// @param degrees  of each line
VectorXd over_neighbours(const VectorXd& squares, double degrees, const ScanRules& rules) {
  VectorXd sums(squares.size() + 1);  // of all lines before
  sums[0] = 0;
  for (Index k = 0; k < squares.size(); ++k) sums[k + 1] = sums[k] + squares[k];
  const auto near = static_cast<Index>(kFinest * rules.line_nearest),
             far = static_cast<Index>(kFinest * rules.line_farthest);
  VectorXd over = squares;
  for (Index k = 0; k < squares.size(); ++k) {
    double sum = 0, count = 0;
    const auto add = [&](Index from, Index to) {
      from = std::max<Index>(from, 1);  // a constant is no line
      to = std::min(to, squares.size());
      for (Index other = from; other < to; ++other) sum -= squares[k] * leaked(other - k);
      if (to > from) sum += sums[to] - sums[from];
      count += static_cast<double>(std::max<Index>(0, to - from));
    };
    add(k - far, k - near + 1);
    add(k + near, k + far + 1);
    if (count > 0) over[k] /= std::max(1.0, sum / (count * degrees));
  }
  return over;
}

}  // namespace

LineScan scan_lines(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                    bool surrogates) {
  LineScan scan;
  if (surrogates) scan.score.surrogates = VectorXd::Zero(system.surrogates());
  double longest = 0, slowest = 0;  // s
  for (const EffectRun& run : data.runs) {
    const double dt = run.motion.sample_time * static_cast<double>(run.decimator.factor);
    longest = std::max(longest, dt * static_cast<double>(run.rows.Y.rows()));
    slowest = std::max(slowest, dt);
  }
  const auto length = static_cast<Index>(std::llround(kFinest * longest / slowest));
  const double duration = static_cast<double>(quick_length(std::max<Index>(1, length))) * slowest;
  const auto first = static_cast<Index>(std::ceil(kFinest * system.rules().line_periods));
  const auto lines = static_cast<Index>(kReached * 0.5 / slowest * duration);
  if (lines <= first) return scan;
  Periodogram periodogram(duration, lines);
  const VectorXd rest = system.rest(joint);
  const MatrixXd noise = surrogates ? system.noise(joint) : MatrixXd();
  VectorXd squares = VectorXd::Zero(lines);
  MatrixXd of_noise = MatrixXd::Zero(lines, noise.cols());
  Index start = 0;
  for (const EffectRun& run : data.runs) {
    const Index rows = run.rows.Y.rows();
    const double dt = run.motion.sample_time * static_cast<double>(run.decimator.factor);
    const double counted = run.rows.counted.col(joint).sum();
    if (counted > 0) {
      squares += periodogram.of(rest.segment(start, rows), dt, counted);
      for (Index m = 0; m < noise.cols(); ++m) {
        of_noise.col(m) += periodogram.of(noise.col(m).segment(start, rows), dt, counted);
      }
      scan.score.degrees += 2;
    }
    start += rows;
  }
  if (scan.score.degrees == 0) return scan;
  Index best = 0;
  squares = over_neighbours(squares, scan.score.degrees, system.rules());
  scan.score.delta_chi2 = squares.tail(lines - first).maxCoeff(&best);
  scan.frequency = static_cast<double>(first + best) / duration;
  scan.score.part_left = 1;
  if (surrogates) {
    scan.score.surrogates = of_noise.bottomRows(lines - first).colwise().maxCoeff().transpose();
  }
  return scan;
}

}  // namespace dyngen::runtime

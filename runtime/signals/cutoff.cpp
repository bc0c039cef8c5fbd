// SPDX-License-Identifier: MIT
#include "runtime/signals/cutoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "runtime/signals/differences.h"
#include "runtime/signals/fourier.h"
#include "runtime/signals/standing.h"

namespace dyngen::runtime {
namespace {

constexpr double kMargin = 2;
constexpr double kVelocityMissed =
    0.01;                          // of the power of the velocity, above a gap in its spectrum
constexpr double kNoNoise = 1e-9;  // of the range: no encoder is that good
// Of the farthest joint's way, rad or m: drives that hold a joint give way by some 1e-4.
constexpr double kGivesWay = 1e-3;

/// Samples a segment: lines of about a quarter of a hertz, and at least some segments to average.
std::size_t segment_samples(Eigen::Index samples, double sample_time) {
  std::size_t segment = 16;
  while (static_cast<double>(segment) * sample_time < 2 &&
         4 * segment <= static_cast<std::size_t>(samples)) {
    segment *= 2;
  }
  return segment;
}

/// One-sided power spectral density of all x, segments overlapping by three quarters (Welch 1967).
/// The window is Hann's squared: what leaks from a line falls as the tenth power of the distance.
std::vector<double> welch(const std::vector<Eigen::VectorXd>& runs, std::size_t segment,
                          double sample_time) {
  std::vector<double> window(segment), density(segment / 2, 0.0);
  double power = 0;
  for (std::size_t i = 0; i < segment; ++i) {
    const double phase = (static_cast<double>(i) + 0.5) / static_cast<double>(segment);
    window[i] = std::pow(std::sin(std::numbers::pi * phase), 4);
    power += window[i] * window[i];
  }
  const auto length = static_cast<Eigen::Index>(segment);
  int segments = 0;
  std::vector<std::complex<double>> piece(segment);
  for (const Eigen::VectorXd& x : runs) {
    for (Eigen::Index start = 0; start + length <= x.size(); start += length / 4, ++segments) {
      for (std::size_t i = 0; i < segment; ++i) {
        piece[i] = window[i] * x[start + static_cast<Eigen::Index>(i)];
      }
      const auto lines = fourier(piece);
      for (std::size_t k = 0; k < density.size(); ++k) density[k] += std::norm(lines[k]);
    }
  }
  for (double& value : density) value *= 2 * sample_time / (power * segments);
  return density;
}

/// Mean over a third of an octave around each line: single lines of noise are ragged.
std::vector<double> smooth(const std::vector<double>& density) {
  std::vector<double> sum(density.size() + 1, 0.0), result(density.size());
  for (std::size_t k = 0; k < density.size(); ++k) sum[k + 1] = sum[k] + density[k];
  for (std::size_t k = 0; k < density.size(); ++k) {
    const std::size_t reach = 2 + k / 9;
    const std::size_t from = k > reach ? k - reach : 0;
    const std::size_t to = std::min(k + reach + 1, density.size());
    result[k] = (sum[to] - sum[from]) / static_cast<double>(to - from);
  }
  return result;
}

/// The noise of an acceleration rises with frequency: the largest such function below its spectrum.
std::vector<double> rising_floor(std::vector<double> density) {
  for (std::size_t k = density.size() - 1; k > 0; --k) {
    density[k - 1] = std::min(density[k - 1], density[k]);
  }
  return density;
}

/// The line at which motion ends: the first above which half an octave is not above twice the
/// noise.
std::size_t end_of_motion(const std::vector<double>& density, const std::vector<double>& noise) {
  std::size_t begin = 1;
  for (std::size_t k = 1; k < density.size(); ++k) {
    if (density[k] > 2 * noise[k]) begin = k + 1;
    if (k > begin + begin / 2 + 4) break;
  }
  return begin;
}

/// The line at which a sharp low-pass has the least error: motion lost above, noise passed below.
std::size_t least_error(const std::vector<double>& density, const std::vector<double>& noise) {
  double error = 0, least = 0;
  std::size_t line = 0;
  for (std::size_t k = 1; k < density.size(); ++k) {
    error += 2 * noise[k] - density[k];
    if (error < least) {
      least = error;
      line = k;
    }
  }
  return line;
}

/// Power of the velocity in the lines after `from` up to `to`, from the spectrum of the
/// acceleration.
double velocity_power(const std::vector<double>& density, std::size_t from, std::size_t to) {
  double power = 0;
  for (std::size_t k = from + 1; k <= to; ++k) power += density[k] / static_cast<double>(k * k);
  return power;
}

/// Whether a joint hardly moves in the first hundredth of a second, beside its fastest one.
bool begins_at_rest(const Eigen::Ref<const Eigen::VectorXd>& q, double sample_time) {
  constexpr double kLooked = 0.01, kOfFastest = 0.05;  // s, and of the fastest
  const Eigen::Index step = std::max<Eigen::Index>(1, std::lround(kLooked / sample_time));
  if (q.size() <= 2 * step) return false;
  const Eigen::ArrayXd moved = (q.tail(q.size() - step) - q.head(q.size() - step)).array().abs();
  return moved[0] < kOfFastest * moved.maxCoeff();
}

/// The acceleration of a run that is short beside a segment, with rest before and after where it
/// begins and ends so: windows leave out what happens at the ends, and a trapezoid accelerates
/// there alone.
Eigen::VectorXd with_rest(const Eigen::VectorXd& acceleration, const Eigen::VectorXd& q,
                          std::size_t segment, double sample_time) {
  if (static_cast<std::size_t>(q.size()) >= 4 * segment) return acceleration;
  const auto half = static_cast<Eigen::Index>(segment / 2);
  const Eigen::Index before = begins_at_rest(q, sample_time) ? half : 0;
  const Eigen::Index after = begins_at_rest(q.reverse(), sample_time) ? half : 0;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(before + acceleration.size() + after);
  all.segment(before, acceleration.size()) = acceleration;
  return all;
}

struct JointCutoff {
  double hz = 0;
  double noise = 0;  ///< standard deviation of the white part of the position noise
  double range = 0;
};

/// Median of the spectrum of the position where a robot does not move: above an eighth of the
/// sampling frequency.
double position_noise(const std::vector<double>& density, std::size_t segment, double sample_time) {
  std::vector<double> floor;
  for (std::size_t k = segment / 8; k < segment * 9 / 20; ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(segment);
    floor.push_back(density[k] / std::pow(2 * std::sin(angle) / sample_time, 4));
  }
  const auto middle = floor.begin() + static_cast<std::ptrdiff_t>(floor.size() / 2);
  std::nth_element(floor.begin(), middle, floor.end());
  return std::sqrt(*middle / (2 * sample_time));
}

JointCutoff joint_cutoff(const std::vector<Eigen::MatrixXd>& runs, Eigen::Index joint,
                         double sample_time) {
  JointCutoff result;
  Eigen::Index longest = 0;
  for (const Eigen::MatrixXd& run : runs) {
    if (run.rows() < 3) continue;
    longest = std::max(longest, run.rows());
    result.range = std::max(result.range, run.col(joint).maxCoeff() - run.col(joint).minCoeff());
  }
  if (result.range == 0) return result;
  const std::size_t segment = segment_samples(longest, sample_time);
  std::vector<Eigen::VectorXd> accelerations;
  for (const Eigen::MatrixXd& run : runs) {
    if (run.rows() < 3) continue;
    const Eigen::VectorXd q = run.col(joint);
    accelerations.push_back(
        with_rest(second_difference(q, sample_time).col(0).segment(1, q.size() - 2), q, segment,
                  sample_time));
  }
  std::vector<double> density = welch(accelerations, segment, sample_time);
  result.noise = position_noise(density, segment, sample_time);
  if (result.noise < kNoNoise * result.range) {
    result.hz = 0.5 / sample_time;
    return result;
  }
  density.resize(segment * 9 / 20);
  const std::vector<double> smoothed = smooth(density);
  const std::vector<double> noise = rising_floor(smoothed);
  std::size_t line = std::min(end_of_motion(smoothed, noise), density.size() - 1);
  // Motion may go on above a gap. Vibration is left alone: it accelerates, but moves nothing.
  const std::size_t further = least_error(density, noise);
  if (velocity_power(density, line, further) >
      kVelocityMissed * velocity_power(density, 0, density.size() - 1)) {
    line = further;
  }
  result.hz = static_cast<double>(line) / (static_cast<double>(segment) * sample_time);
  return result;
}

}  // namespace

Cutoff choose_cutoff(const Eigen::MatrixXd& q, double sample_time) {
  return choose_cutoff(std::vector<Eigen::MatrixXd>{q}, sample_time);
}

Cutoff choose_cutoff(const std::vector<Eigen::MatrixXd>& runs, double sample_time) {
  const Eigen::Index joints = runs.empty() ? 0 : runs.front().cols();
  Eigen::Index longest = 0;
  bool same = true;
  for (const Eigen::MatrixXd& run : runs) {
    longest = std::max(longest, run.rows());
    same = same && run.cols() == joints;
  }
  if (longest < 64 || joints < 1 || !same || !(sample_time > 0)) {
    throw std::invalid_argument(
        fmt::format("choose_cutoff(): {} samples x {} joints of {} s, needed: a run of at least 64 "
                    "samples, as many joints in all and one at least, a positive time",
                    longest, joints, sample_time));
  }
  const double highest = kHighestCutoff / sample_time;
  std::vector<JointCutoff> found;
  double farthest = 0;
  for (Eigen::Index j = 0; j < joints; ++j) {
    found.push_back(joint_cutoff(runs, j, sample_time));
    farthest = std::max(farthest, found.back().range);
  }
  JointCutoff largest;
  Eigen::Index joint = -1;
  for (Eigen::Index j = 0; j < joints; ++j) {
    const JointCutoff& own = found[static_cast<std::size_t>(j)];
    const bool moves = own.range > std::max(kMovesAbove * own.noise, kGivesWay * farthest);
    if (moves && (joint < 0 || own.hz > largest.hz)) {
      largest = own;
      joint = j;
    }
  }
  if (joint < 0) {
    return {std::min(kLowestCutoff, highest),
            "no joint moves by more than its noise; the cut-off is the lowest there is"};
  }
  if (largest.noise < kNoNoise * largest.range) {
    return {highest, fmt::format("joint {} shows no noise: cut-off {:.3g} Hz, a fifth of the "
                                 "sampling frequency",
                                 joint + 1, highest)};
  }
  const double wanted = kMargin * largest.hz;
  const double hz = std::min(std::max(wanted, kLowestCutoff), highest);
  return {hz, fmt::format(
                  "the acceleration of joint {} is above its noise (position noise {:.2g}) up to "
                  "{:.3g} Hz: cut-off {:.3g} Hz{}",
                  joint + 1, largest.noise, largest.hz, hz,
                  wanted < kLowestCutoff ? ", the lowest allowed"
                  : wanted > highest     ? ", a fifth of the sampling frequency"
                                         : "")};
}

}  // namespace dyngen::runtime

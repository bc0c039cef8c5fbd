// SPDX-License-Identifier: MIT
#include "runtime/recordings/periods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "runtime/recordings/motion_mismatch.h"
#include "runtime/recordings/spline.h"
#include "runtime/recordings/time_base.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr Index kMostSearched = 1 << 16;  // samples: longer runs are thinned out for the search
constexpr double kMustRise = 1e-3;        // a motion leaves its start before it comes back

struct Run {
  Index first = 0, count = 0;
};

Run longest_run(const Recording& recording) {
  Run longest;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run];
    const Index count = run_end(recording, run) - first;
    if (count > longest.count) longest = {first, count};
  }
  return longest;
}

/// Positions of the joints that move without their mean, times MovingJoint::scale.
struct MovingPositions {
  Eigen::MatrixXd x;
  Eigen::VectorXd weight;
};

MovingPositions moving_positions(const Eigen::Ref<const Eigen::MatrixXd>& q) {
  const std::vector<MovingJoint> moving = moving_joints(q);
  MovingPositions motion;
  motion.x.resize(q.rows(), static_cast<Index>(moving.size()));
  motion.weight.resize(static_cast<Index>(moving.size()));
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const auto column = static_cast<Index>(i);
    const auto own = q.col(moving[i].joint);
    motion.weight(column) = moving[i].weight;
    motion.x.col(column) = (own.array() - own.mean()) * moving[i].scale;
  }
  return motion;
}

/// Per joint, mean over k of (x(k+L) - x(k))^2 / 2, L the lag.
Eigen::RowVectorXd mismatch_of_joints(const MovingPositions& motion, Index lag) {
  const Index n = motion.x.rows() - lag;
  return (motion.x.bottomRows(n) - motion.x.topRows(n)).colwise().squaredNorm() /
         (2 * static_cast<double>(n));
}

/// Mismatch of a lag, that of the joint where it is largest. 0: repeats; kJustRepeats: just so; with no
/// noise, 1: unrelated.
double mismatch_at(const MovingPositions& motion, Index lag) {
  return mismatch_of_joints(motion, lag).maxCoeff();
}

/// mismatch_at() of all lags 0 .. most at once, by FFT.
Eigen::VectorXd mismatches(const MovingPositions& motion, Index most) {
  const Index n = motion.x.rows();
  Index size = 1;
  while (size < n + most + 1) size *= 2;
  Eigen::FFT<double> fft;
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(most + 1);
  Eigen::VectorXd padded(size), correlation(size);
  Eigen::VectorXcd spectrum;
  for (Index j = 0; j < motion.x.cols(); ++j) {
    padded << motion.x.col(j), Eigen::VectorXd::Zero(size - n);
    fft.fwd(spectrum, padded);
    spectrum = spectrum.cwiseAbs2().cast<std::complex<double>>();
    fft.inv(correlation, spectrum);
    double heads = motion.x.col(j).squaredNorm(), tails = heads;  // of x(0..n-L), x(L..n)
    for (Index lag = 0; lag <= most; ++lag) {
      const double square = std::max(0.0, heads + tails - 2 * correlation(lag));
      worst(lag) = std::max(worst(lag), square / (2 * static_cast<double>(n - lag)));
      heads -= std::pow(motion.x(n - 1 - lag, j), 2);
      tails -= std::pow(motion.x(lag, j), 2);
    }
  }
  return worst;
}

/// Every `stride`-th sample.
MovingPositions thinned(const MovingPositions& motion, Index stride) {
  if (stride == 1) return motion;
  MovingPositions thin;
  thin.weight = motion.weight;
  thin.x.resize((motion.x.rows() + stride - 1) / stride, motion.x.cols());
  for (Index k = 0; k < thin.x.rows(); ++k) thin.x.row(k) = motion.x.row(k * stride);
  return thin;
}

/// The bottom of a valley of mismatch around a lag: where and how deep, between the samples.
struct Valley {
  double lag = 0;
  double depth = 0;
  double bend = 0;  ///< second difference: some hundredths of it are how well the depth is known
};

Valley valley_at(const MovingPositions& motion, Index lag, Index reach) {
  const Index most = motion.x.rows() - 2;
  const Index from = std::max<Index>(1, lag - reach), to = std::min(most - 1, lag + reach);
  Index best = from;
  double depth = std::numeric_limits<double>::infinity();
  for (Index at = from; at <= to; ++at) {
    const double here = mismatch_at(motion, at);
    if (here < depth) {
      depth = here;
      best = at;
    }
  }
  const double left = mismatch_at(motion, best - 1), right = mismatch_at(motion, best + 1);
  const double bend = left - 2 * depth + right;
  const double shift = bend > 0 ? std::clamp((left - right) / (2 * bend), -0.5, 0.5) : 0;
  return {static_cast<double>(best) + shift, depth - bend * shift * shift / 2, bend};
}

/// Lags at which the mismatch has a low valley after it has risen once; in rising order.
std::vector<Index> candidates(const Eigen::VectorXd& mismatch) {
  std::vector<Index> lags;
  bool risen = false;
  for (Index lag = 1; lag + 1 < mismatch.size(); ++lag) {
    risen = risen || mismatch(lag) > kMustRise;
    if (!risen || mismatch(lag) > mismatch(lag - 1) || mismatch(lag) > mismatch(lag + 1)) continue;
    // Between two samples the valley is deeper, by no more than this.
    const double bend = mismatch(lag - 1) - 2 * mismatch(lag) + mismatch(lag + 1);
    if (mismatch(lag) - bend / 4 <= kJustRepeats) lags.push_back(lag);
  }
  return lags;
}

/// The period in samples; 0 if there is none.
double search(const MovingPositions& motion) {
  const Index n = motion.x.rows();
  const Index stride = (n + kMostSearched - 1) / kMostSearched;
  const MovingPositions thin = thinned(motion, stride);
  const Eigen::VectorXd mismatch = mismatches(thin, thin.x.rows() / 2 + 1);

  std::vector<Valley> valleys;
  double deepest = std::numeric_limits<double>::infinity();
  constexpr std::size_t kMostCandidates = 200;
  for (const Index lag : candidates(mismatch)) {
    const Valley valley = valley_at(motion, lag * stride, stride);
    if (valley.depth > kJustRepeats) continue;
    valleys.push_back(valley);
    deepest = std::min(deepest, std::max(valley.depth, 0.0));
    if (valleys.size() >= kMostCandidates) break;
  }
  // The shortest of those that repeat about as well as the best: not a part of the period that
  // nearly repeats, and no multiple of it either.
  constexpr double kAsGood = 4, kOfBend = 0.01, kTiny = 1e-9;
  for (const Valley& valley : valleys) {
    if (valley.depth > kAsGood * deepest + kOfBend * valley.bend + kTiny) continue;
    // A multiple of the period is found with the same error in samples: less error in the period.
    double period = valley.lag;
    for (double times = 2; times * period <= 0.75 * static_cast<double>(n); times *= 2) {
      const Valley far = valley_at(motion, static_cast<Index>(std::lround(times * period)), 2);
      if (far.depth > 2 * kJustRepeats) break;
      period = far.lag / times;
    }
    return period;
  }
  return 0;
}

void check(const Recording& recording, const Periods& periods) {
  const bool fits = periods.samples > 1 && periods.count >= 2 && periods.period > 0 &&
                    periods.first >= 0 && periods.first < recording.samples();
  if (!fits) {
    throw std::invalid_argument(
        "average_periods(), period_scatter(): the periods are none, or of another recording");
  }
}

/// Rows of the run that begins at periods.first.
Run run_of(const Recording& recording, const Periods& periods) {
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    if (recording.run_starts[run] == periods.first) {
      return {periods.first, run_end(recording, run) - periods.first};
    }
  }
  throw std::invalid_argument("average_periods(): no run begins at the first period's row");
}

/// One signal on the grid of whole periods: (count * samples x n).
class PeriodGrid {
 public:
  PeriodGrid(const Recording& recording, const Periods& periods)
      : run_(run_of(recording, periods)),
        rows_(periods.samples * periods.count),
        time_(recording.time.segment(run_.first, run_.count)) {
    const double step = periods.period / static_cast<double>(periods.samples);
    grid_ = Eigen::VectorXd::LinSpaced(rows_, 0, static_cast<double>(rows_ - 1)) * step;
    grid_.array() += time_(0);
    constexpr double kSamePlace = 0.05;  // of a step
    on_samples_ = rows_ <= run_.count &&
                  (grid_ - time_.head(rows_)).cwiseAbs().maxCoeff() <= kSamePlace * step;
    if (grid_(rows_ - 1) > time_(run_.count - 1) + step) {
      throw std::invalid_argument("average_periods(): the periods are longer than the run");
    }
  }

  [[nodiscard]] Eigen::MatrixXd operator()(const Eigen::MatrixXd& signal) const {
    if (on_samples_) return signal.middleRows(run_.first, rows_);
    return interpolate_spline(time_, signal.middleRows(run_.first, run_.count), grid_);
  }
  [[nodiscard]] const Eigen::VectorXd& time() const { return grid_; }

 private:
  Run run_;
  Index rows_;
  Eigen::VectorXd time_, grid_;
  bool on_samples_ = false;
};

Eigen::MatrixXd mean_period(const Eigen::MatrixXd& signal, const Periods& periods) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(periods.samples, signal.cols());
  for (Index i = 0; i < periods.count; ++i) {
    mean += signal.middleRows(i * periods.samples, periods.samples);
  }
  return mean / static_cast<double>(periods.count);
}

}  // namespace

Periods find_periods(const Recording& recording, std::optional<double> given) {
  if (given && !(*given > 0)) {
    throw std::invalid_argument(
        fmt::format("find_periods(): the given period is {} s, expected more than 0", *given));
  }
  Periods none;
  const Run run = longest_run(recording);
  none.first = run.first;
  const TimeBase base = examine_time_base(recording);
  if (run.count < kFewestSamples || !(base.sample_time > 0)) {
    none.message = "too few samples to look for a period";
    return none;
  }
  const double step = base.sample_time;
  const Eigen::VectorXd time = recording.time.segment(run.first, run.count);
  const Eigen::MatrixXd q = recording.q.middleRows(run.first, run.count);
  const double duration = time(run.count - 1) - time(0) + step;
  MovingPositions motion;
  if (base.uniform) {
    motion = moving_positions(q);
  } else {
    const auto rows = static_cast<Index>(std::floor((duration - step) / step + 1e-6)) + 1;
    Eigen::VectorXd grid =
        Eigen::VectorXd::LinSpaced(rows, 0, static_cast<double>(rows - 1)) * step;
    grid.array() += time(0);
    motion = moving_positions(interpolate_spline(time, q, grid));
  }
  if (motion.x.cols() == 0) {
    none.message = "no joint moves, so there is no period";
    return none;
  }

  const double lag = given ? *given / step : search(motion);
  if (lag == 0) {
    none.message = "the motion does not repeat";
    return none;
  }
  Periods found = none;
  found.period = lag * step;
  found.samples = static_cast<Index>(std::lround(lag));
  constexpr double kLastSample = 0.5;  // of a step: a period ends where the next would begin
  found.count = static_cast<int>(std::floor((duration + kLastSample * step) / found.period));
  if (found.count < 2 || found.samples < 2) {
    none.message =
        fmt::format("a period of {:.6g} s is not found twice in {:.6g} s", found.period, duration);
    return none;
  }
  // Whole, if that moves no sample of the last period by more than a part of a step.
  constexpr double kWhole = 0.1;
  if (std::abs(lag - std::round(lag)) * found.count < kWhole) {
    found.period = static_cast<double>(found.samples) * step;
  }
  const Eigen::RowVectorXd mismatch = mismatch_of_joints(motion, found.samples);
  const double worst = mismatch.cwiseQuotient(motion.weight.transpose()).maxCoeff();
  found.correlation = std::clamp(1 - worst, -1.0, 1.0);
  const bool repeats = valley_at(motion, found.samples, 1).depth <= kJustRepeats;
  found.message = fmt::format("{} periods of {:.6g} s ({} samples), correlation {:.6f}{}",
                              found.count, found.period, found.samples, found.correlation,
                              repeats ? "" : "; positions repeat badly with the given period");
  return found;
}

Recording average_periods(const Recording& recording, const Periods& periods) {
  check(recording, periods);
  const PeriodGrid grid(recording, periods);
  Recording mean;
  mean.file_name = recording.file_name;
  mean.run_starts = {0};
  mean.time = grid.time().head(periods.samples);
  for (const auto part : kRecordingParts) {
    if ((recording.*part).cols() > 0) mean.*part = mean_period(grid(recording.*part), periods);
  }
  return mean;
}

Eigen::MatrixXd period_scatter(const Recording& recording, const Periods& periods) {
  check(recording, periods);
  const Eigen::MatrixXd tau = PeriodGrid(recording, periods)(recording.tau);
  const Eigen::MatrixXd mean = mean_period(tau, periods);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(mean.rows(), mean.cols());
  for (Index i = 0; i < periods.count; ++i) {
    sum += (tau.middleRows(i * periods.samples, periods.samples) - mean).cwiseAbs2();
  }
  return (sum / static_cast<double>(periods.count - 1)).cwiseSqrt();
}

Eigen::RowVectorXd column_rms(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  if (values.rows() == 0) return Eigen::RowVectorXd::Zero(values.cols());
  return (values.colwise().squaredNorm() / static_cast<double>(values.rows())).cwiseSqrt();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/recordings/clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "runtime/recordings/time_base.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kClearAdvantage = 1.15;  // ratio of rms errors that chance does not make
constexpr Index kClockWindow = 33;        // samples: longer than a burst of late stamps
constexpr Index kFewestPredicted = 64;    // samples: fewer say nothing

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mean step of the stamps of one run, without steps that lost samples or bursts make: the slope
/// over many samples, its median.
double mean_step(const Eigen::Ref<const VectorXd>& stamps) {
  const Index span = std::min<Index>(std::max<Index>(stamps.size() / 4, 1), 4 * kClockWindow);
  std::vector<double> slopes;
  for (Index k = 0; k + span < stamps.size(); ++k) {
    slopes.push_back((stamps[k + span] - stamps[k]) / static_cast<double>(span));
  }
  return middle_of(std::move(slopes));
}

/// Samples that were lost before each one, in whole steps.
VectorXd even_times(const Eigen::Ref<const VectorXd>& stamps, double step) {
  const Index n = stamps.size();
  VectorXd off(n);  // of the stamps, in steps
  for (Index k = 0; k < n; ++k) off[k] = (stamps[k] - stamps[0]) / step - static_cast<double>(k);
  VectorXd middle(n);
  for (Index k = 0; k < n; ++k) {
    const Index from = std::max<Index>(0, k - kClockWindow / 2);
    const Index to = std::min(n, k + kClockWindow / 2 + 1);
    middle[k] = middle_of({off.begin() + from, off.begin() + to});
  }
  VectorXd times(n);
  double lost = 0;
  Index settled = 0;  ///< where a loss that was found can no longer be seen
  for (Index k = 0; k < n; ++k) {
    // a clock that is a little slow drifts by less than a step within a window: it is no loss; the
    // median crosses in the middle of a loss, and has settled half a window farther
    const Index before = std::max<Index>(0, k - kClockWindow / 2 - 1);
    const Index after = std::min(n - 1, k + kClockWindow / 2 + 1);
    const double loss = middle[after] - middle[before];
    const bool crosses = middle[k] - middle[before] >= loss / 2;
    constexpr double kLoss = 0.75;
    if (k > settled && loss > kLoss && crosses) {
      lost += std::round(loss);
      settled = k + kClockWindow + 1;
    }
    times[k] = (static_cast<double>(k) + lost) * step;
  }
  std::vector<double> shift(static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) shift[static_cast<std::size_t>(k)] = stamps[k] - times[k];
  times.array() += middle_of(std::move(shift));
  return times;
}

/// Mean square by which a sample is off the cubic through two neighbours on either side.
double neighbour_error(const Eigen::Ref<const VectorXd>& t, const Eigen::Ref<const VectorXd>& x) {
  double sum = 0, count = 0;
  for (Index k = 2; k + 2 < x.size(); ++k) {
    const std::array<Index, 4> near = {k - 2, k - 1, k + 1, k + 2};
    double value = 0, gain = 1;
    for (const Index i : near) {
      double weight = 1;
      for (const Index j : near) {
        if (j != i) weight *= (t[k] - t[j]) / (t[i] - t[j]);
      }
      value += weight * x[i];
      gain += weight * weight;
    }
    if (!std::isfinite(value) || gain > 100) continue;  // stamps that nearly coincide
    // noise of the neighbours comes through: the same from both clocks when divided by it
    sum += (x[k] - value) * (x[k] - value) / gain;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

/// Mean square of steps of the position beside the trapezoid of velocities.
double step_error(const Eigen::Ref<const VectorXd>& t, const Eigen::Ref<const VectorXd>& q,
                  const Eigen::Ref<const VectorXd>& dq) {
  double sum = 0;
  for (Index k = 1; k < q.size(); ++k) {
    const double off = q[k] - q[k - 1] - (t[k] - t[k - 1]) * (dq[k] + dq[k - 1]) / 2;
    sum += off * off;
  }
  return sum / static_cast<double>(std::max<Index>(q.size() - 1, 1));
}

/// Errors of both clocks of all signals of a kind: the mean of their logarithms' difference.
struct Contest {
  double sum = 0, most = 0;
  int signals = 0;

  void add(double with_stamps, double with_even) {
    if (!(with_stamps > 0 && with_even > 0)) return;
    const double ratio = std::log(with_stamps / with_even) / 2;
    sum += ratio;
    if (std::abs(ratio) > std::abs(most)) most = ratio;
    ++signals;
  }
};

}  // namespace

ClockChoice choose_clock(const Recording& recording) {
  ClockChoice choice;
  choice.time = recording.time;
  std::vector<double> steps;
  std::size_t longest = 0;
  Index length = 0;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run], count = run_end(recording, run) - first;
    if (count < kClockWindow) continue;
    steps.push_back(mean_step(recording.time.segment(first, count)));
    if (count > length) {
      length = count;
      longest = run;
    }
  }
  choice.step = middle_of(steps);
  if (length < kFewestPredicted || !(choice.step > 0)) {
    choice.message = "the stamps are believed: there are too few samples to judge them";
    return choice;
  }
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run], count = run_end(recording, run) - first;
    choice.time.segment(first, count) =
        even_times(recording.time.segment(first, count), choice.step);
  }
  const Index first = recording.run_starts[longest];
  const auto stamps = recording.time.segment(first, length);
  const auto even = choice.time.segment(first, length);
  Contest positions, velocities, torques;
  for (Index j = 0; j < recording.q.cols(); ++j) {
    const auto q = recording.q.col(j).segment(first, length);
    positions.add(neighbour_error(stamps, q), neighbour_error(even, q));
    if (recording.dq.cols() > 0) {
      const auto dq = recording.dq.col(j).segment(first, length);
      velocities.add(step_error(stamps, q, dq), step_error(even, q, dq));
    }
    if (recording.tau.cols() > 0) {
      const auto tau = recording.tau.col(j).segment(first, length);
      torques.add(neighbour_error(stamps, tau), neighbour_error(even, tau));
    }
  }
  const char* by = "positions";
  double best = 0;
  for (const auto& [contest, name] :
       {std::pair{velocities, "velocities"}, std::pair{positions, "positions"},
        std::pair{torques, "torques"}}) {
    if (std::abs(contest.most) > std::abs(best)) {
      best = contest.most;
      by = name;
    }
  }
  choice.advantage = std::exp(std::abs(best));
  choice.rebuilt = best > std::log(kClearAdvantage);
  if (choice.rebuilt) {
    choice.message = fmt::format(
        "samples were taken evenly and stamped unevenly: {} fit an even clock of {:.6g} s {:.3g} "
        "times better than the stamps, so the clock is rebuilt",
        by, choice.step, choice.advantage);
  } else if (best < -std::log(kClearAdvantage)) {
    choice.message =
        fmt::format("the stamps are believed: {} fit them {:.3g} times better than an even clock",
                    by, choice.advantage);
  } else {
    choice.message =
        "the stamps are believed: neither velocities nor torques tell them from an even clock";
  }
  return choice;
}

}  // namespace dyngen::runtime

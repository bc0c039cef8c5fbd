// SPDX-License-Identifier: MIT
#include "runtime/recordings/time_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "runtime/recordings/spline.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr double kGridTolerance = 0.01;  // of a step

/// Without the noise of subtraction: 0.00019999999999997797 becomes 0.0002.
double rounded(double step) {
  const std::string digits = fmt::format("{:.10g}", step);
  std::from_chars(digits.data(), digits.data() + digits.size(), step);
  return step;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The farthest that a sample is off the equidistant grid with this step, s.
double farthest_off_grid(const Eigen::Ref<const Eigen::VectorXd>& time, double step) {
  double least = 0, most = 0;  // the grid may be shifted: half of the range counts
  for (Index k = 1; k < time.size(); ++k) {
    const double off = time(k) - time(0) - static_cast<double>(k) * step;
    least = std::min(least, off);
    most = std::max(most, off);
  }
  return (most - least) / 2;
}

struct Grid {
  double step = 0;      ///< s, mean over all runs
  double farthest = 0;  ///< s off the grid
};

Grid common_grid(const Recording& recording) {
  Grid grid;
  double duration = 0, steps = 0;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run];
    const Index last = run_end(recording, run) - 1;
    duration += recording.time(last) - recording.time(first);
    steps += static_cast<double>(last - first);
  }
  grid.step = rounded(duration / steps);
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const Index first = recording.run_starts[run];
    const Index count = run_end(recording, run) - first;
    grid.farthest =
        std::max(grid.farthest, farthest_off_grid(recording.time.segment(first, count), grid.step));
  }
  return grid;
}

/// How far printing may have moved a sample, s. Samples on whole units of the print were not moved.
double rounding_of_print(const Recording& recording, double step) {
  const double unit = print_unit(recording.time);
  if (unit == 0) return 0;
  constexpr double kWhole =
      0.02;  // a clock this little off needs a step of another length at times
  return std::abs(step / unit - std::round(step / unit)) < kWhole ? 0 : unit / 2;
}

}  // namespace

Eigen::Index run_end(const Recording& recording, std::size_t run) {
  return run + 1 < recording.run_starts.size() ? recording.run_starts[run + 1]
                                               : recording.samples();
}

double print_unit(const Eigen::Ref<const Eigen::VectorXd>& values) {
  int decimals = 0;
  constexpr int kMost = 12;
  for (const double value : values) {
    for (;; ++decimals) {
      if (decimals > kMost) return 0;
      const double scaled = std::abs(value) * std::pow(10.0, decimals);
      const double error = std::max(4 * scaled * std::numeric_limits<double>::epsilon(), 1e-12);
      if (error > 0.01) return 0;  // no digits are left to tell
      if (std::abs(scaled - std::round(scaled)) <= error) break;
    }
  }
  return std::pow(10.0, -decimals);
}

TimeBase examine_time_base(const Recording& recording) {
  TimeBase base;
  std::vector<double> steps;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    for (Index k = recording.run_starts[run] + 1; k < run_end(recording, run); ++k) {
      steps.push_back(recording.time(k) - recording.time(k - 1));
    }
  }
  if (steps.empty()) {
    base.message = "no run has two samples, so there is no sample time";
    return base;
  }
  base.sample_time = rounded(median(steps));
  const Grid grid = common_grid(recording);
  const double allowed = kGridTolerance * grid.step + rounding_of_print(recording, grid.step);
  base.uniform = grid.step > 0 && grid.farthest <= allowed;
  if (base.uniform) base.sample_time = grid.step;

  double sum = 0;
  base.worst_step = base.sample_time;
  for (const double step : steps) {
    const double deviation = step - base.sample_time;
    sum += deviation * deviation;
    if (std::abs(deviation) > std::abs(base.worst_step - base.sample_time)) base.worst_step = step;
  }
  base.jitter = std::sqrt(sum / static_cast<double>(steps.size())) / base.sample_time;
  base.message =
      base.uniform
          ? fmt::format("uniformly sampled every {:.6g} s", base.sample_time)
          : fmt::format(
                "not uniformly sampled: the median step is {:.6g} s, steps vary by {:.2g} % "
                "(rms), the worst is {:.4g} s",
                base.sample_time, 100 * base.jitter, base.worst_step);
  return base;
}

Recording resample(const Recording& recording, double sample_time) {
  if (!(sample_time > 0) || !std::isfinite(sample_time)) {
    throw std::invalid_argument(
        fmt::format("resample(): sample_time is {} s, expected more than 0", sample_time));
  }
  Recording result;
  result.file_name = recording.file_name;
  std::vector<Eigen::VectorXd> grids;
  Index samples = 0;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    const double start = recording.time(recording.run_starts[run]);
    const double end = recording.time(run_end(recording, run) - 1);
    constexpr double kRounding = 1e-6;  // of a step: the last sample is not lost to it
    const double steps = std::floor((end - start) / sample_time + kRounding);
    constexpr double kMostOfRows = 100;  // more samples would be made up than were measured
    const double rows = static_cast<double>(run_end(recording, run) - recording.run_starts[run]);
    if (!(steps >= 0) || steps > kMostOfRows * (rows + 1)) {
      throw std::invalid_argument(
          fmt::format("resample(): run {} lasts from {} s to {} s, which is no number of steps of "
                      "{} s that can be made",
                      run + 1, start, end, sample_time));
    }
    Eigen::VectorXd grid(static_cast<Index>(steps) + 1);
    for (Index k = 0; k < grid.size(); ++k) {
      grid(k) = start + static_cast<double>(k) * sample_time;
    }
    result.run_starts.push_back(samples);
    samples += grid.size();
    grids.push_back(std::move(grid));
  }

  result.time.resize(samples);
  for (std::size_t run = 0; run < grids.size(); ++run) {
    result.time.segment(result.run_starts[run], grids[run].size()) = grids[run];
  }
  const auto interpolate = [&](Eigen::MatrixXd Recording::*part, auto method) {
    const Eigen::MatrixXd& from = recording.*part;
    Eigen::MatrixXd& to = result.*part;
    to.resize(from.cols() > 0 ? samples : 0, from.cols());
    if (from.cols() == 0) return;
    for (std::size_t run = 0; run < grids.size(); ++run) {
      const Index first = recording.run_starts[run];
      const Index count = run_end(recording, run) - first;
      auto rows = to.middleRows(result.run_starts[run], grids[run].size());
      if (count == 1) {
        rows = from.middleRows(first, 1);
      } else {
        rows =
            method(recording.time.segment(first, count), from.middleRows(first, count), grids[run]);
      }
    }
  };
  for (const auto part : {&Recording::q, &Recording::dq, &Recording::ddq, &Recording::q_link}) {
    interpolate(part, interpolate_spline);
  }
  for (const auto part : {&Recording::tau, &Recording::tau_sim, &Recording::temperature}) {
    interpolate(part, interpolate_linear);
  }
  return result;
}

}  // namespace dyngen::runtime

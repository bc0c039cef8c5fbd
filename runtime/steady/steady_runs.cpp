// SPDX-License-Identifier: MIT
#include "runtime/steady/steady_runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "runtime/signals/standing.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// RecordedRows of one run of a recording: no window crosses from one to the next.
struct RecordedRows {
  Index first = 0, end = 0;
  double sample_time = 0;

  [[nodiscard]] Index samples(double seconds) const {
    return static_cast<Index>(std::lround(seconds / sample_time));
  }
};

std::vector<RecordedRows> runs_of(const Recording& recording, double least_seconds) {
  std::vector<RecordedRows> runs;
  for (std::size_t r = 0; r < recording.run_starts.size(); ++r) {
    RecordedRows rows;
    rows.first = recording.run_starts[r];
    rows.end =
        r + 1 < recording.run_starts.size() ? recording.run_starts[r + 1] : recording.samples();
    if (rows.end - rows.first < 3) continue;
    const double seconds = recording.time[rows.end - 1] - recording.time[rows.first];
    rows.sample_time = seconds / static_cast<double>(rows.end - 1 - rows.first);
    if (rows.sample_time > 0 && seconds > least_seconds) runs.push_back(rows);
  }
  return runs;
}

/// Speeds over windows: entry k is of rows first + k .. first + k + width.
struct WindowSpeeds {
  VectorXd speed;
  Index width = 0;
  double noise = 0;  ///< standard deviation of one of them
};

WindowSpeeds window_speeds(const VectorXd& q, const RecordedRows& rows, double window) {
  WindowSpeeds own;
  own.width = std::max<Index>(2, rows.samples(window));
  const Index n = rows.end - rows.first;
  const VectorXd part = q.segment(rows.first, n);
  if (n <= own.width) return own;
  const double time = static_cast<double>(own.width) * rows.sample_time;
  own.speed = (part.tail(n - own.width) - part.head(n - own.width)) / time;
  own.noise = std::numbers::sqrt2 * difference_noise(part) / time;
  return own;
}

double range_of(const VectorXd& q, const Stretch& stretch) {
  const auto part = q.segment(stretch.first, stretch.count);
  return part.maxCoeff() - part.minCoeff();
}

VectorXd mean_positions(const Recording& recording, const Stretch& stretch) {
  return recording.q.middleRows(stretch.first, stretch.count).colwise().mean().transpose();
}

Stretch stretch_of(const Recording& recording, const RecordedRows& rows, Index first, Index end) {
  return {rows.first + first, end - first, rows.sample_time, recording.time[rows.first + first], 0};
}

std::optional<SteadyRun> checked_run(const Recording& recording, Index joint,
                                     const RecordedRows& rows, Index first, Index end,
                                     const SteadyRules& rules) {
  const Index trim = rows.samples(rules.settling);
  first += trim;
  end -= trim;
  if (end - first < std::max<Index>(8, rows.samples(rules.least_run))) return std::nullopt;
  SteadyRun run{stretch_of(recording, rows, first, end), 0, true, {}};
  const VectorXd& time = recording.time;
  const Index last = run.stretch.first + run.stretch.count - 1;
  run.speed = (recording.q(last, joint) - recording.q(run.stretch.first, joint)) /
              (time[last] - time[run.stretch.first]);
  for (Index j = 0; j < recording.q.cols(); ++j) {
    if (j == joint) continue;
    if (range_of(recording.q.col(j), run.stretch) > rules.standing) run.alone = false;
  }
  run.posture = mean_positions(recording, run.stretch);
  return run;
}

/// The side from which joint j came to a pose: where it was when it was last `reach` away.
int side_of(const VectorXd& q, const RecordedRows& rows, Index begin, double pose, double reach) {
  for (Index k = begin; k >= rows.first; --k) {
    if (std::abs(q[k] - pose) > reach) return q[k] < pose ? -1 : 1;
  }
  return 0;
}

/// Windows in which every joint stands.
std::vector<bool> standing_windows(const Recording& recording, const RecordedRows& rows,
                                   Index& width, const SteadyRules& rules) {
  std::vector<bool> all;
  for (Index j = 0; j < recording.q.cols(); ++j) {
    const WindowSpeeds speeds = window_speeds(recording.q.col(j), rows, rules.window);
    width = speeds.width;
    all.resize(static_cast<std::size_t>(speeds.speed.size()), true);
    // a joint that drifts by a tenth of what counts as standing within the shortest pose moves
    constexpr double kPart = 0.1;
    const double least =
        std::max(rules.noise_factor * speeds.noise, kPart * rules.standing / rules.least_hold);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (std::abs(speeds.speed[static_cast<Index>(k)]) > least) all[k] = false;
    }
  }
  return all;
}

}  // namespace

std::vector<SteadyRun> find_steady_runs(const Recording& recording, Index joint,
                                        const SteadyRules& rules) {
  std::vector<SteadyRun> found;
  for (const RecordedRows& rows : runs_of(recording, rules.window)) {
    const WindowSpeeds windows = window_speeds(recording.q.col(joint), rows, rules.window);
    const VectorXd& speed = windows.speed;
    const double noise = rules.noise_factor * windows.noise;
    for (Index begin = 0; begin < speed.size();) {
      double least = speed[begin], most = speed[begin];
      Index end = begin;
      for (; end < speed.size(); ++end) {
        const double low = std::min(least, speed[end]), high = std::max(most, speed[end]);
        const double middle = 0.5 * std::abs(low + high);
        if (high - low > 2 * std::max(noise, rules.spread * middle)) break;
        least = low;
        most = high;
      }
      // slower than the noise, or than what counts as standing: no run
      const double mean = 0.5 * (least + most);
      const double travel = std::abs(mean) * static_cast<double>(end - begin) * rows.sample_time;
      const bool moves = least * most > 0 && travel > rules.standing;
      if (moves) {
        const auto run = checked_run(recording, joint, rows, begin, end - 1 + windows.width, rules);
        if (run) found.push_back(*run);
      }
      begin = std::max(end, begin + 1);
    }
  }
  return found;
}

std::vector<HeldPose> find_held_poses(const Recording& recording, const SteadyRules& rules) {
  std::vector<HeldPose> found;
  for (const RecordedRows& rows : runs_of(recording, rules.least_hold)) {
    Index width = 0;
    const std::vector<bool> standing = standing_windows(recording, rows, width, rules);
    const auto count = static_cast<Index>(standing.size());
    for (Index begin = 0; begin < count;) {
      Index end = begin;
      while (end < count && standing[static_cast<std::size_t>(end)]) ++end;
      const Index first = begin + rows.samples(rules.pose_settling), last = end - 1 + width;
      begin = std::max(end, begin + 1);
      if (last - first < std::max<Index>(8, rows.samples(rules.least_hold))) continue;
      HeldPose pose{stretch_of(recording, rows, first, last), {}, {}};
      pose.q = mean_positions(recording, pose.stretch);
      pose.from.resize(recording.q.cols());
      for (Index j = 0; j < recording.q.cols(); ++j) {
        const double range = range_of(recording.q.col(j), pose.stretch);
        pose.from[j] = side_of(recording.q.col(j), rows, pose.stretch.first, pose.q[j],
                               std::max(rules.reach.value, range));
      }
      found.push_back(std::move(pose));
    }
  }
  return found;
}

}  // namespace dyngen::runtime

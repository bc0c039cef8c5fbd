// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/left_out_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dyngen::runtime {

using Eigen::Index;

namespace {

constexpr double kFaint = 0.02;  // of the parallel filter's largest tap: less is not felt

void leave_out(RowBlock& rows, Index row, Index joint, Index size) {
  rows.counted(row, joint) = 0;
  rows.tau(row, joint) = 0;
  rows.Y.row(row).segment(joint * size, size).setZero();
}

}  // namespace

void leave_out_standstill(EffectRun& run, const Eigen::VectorXd& still_speed,
                          const EquationRules& rules) {
  const Motion& motion = run.motion;
  const Index factor = run.decimator.factor, first = first_sample(run.decimator);
  const Index reach = run.decimator.taps.size() / 2;  // of the filter around an equation
  const auto least = static_cast<Index>(std::ceil(rules.longest_reversal / motion.sample_time));
  const Index size = run.rows.Y.cols() / motion.joints();
  for (Index j = 0; j < motion.joints(); ++j) {
    for (Index start = 0; start < motion.samples();) {
      Index end = start;
      while (end < motion.samples() && std::abs(motion.dq(end, j)) < still_speed[j]) ++end;
      if (end - start >= least) {
        for (Index k = 0; k < run.rows.Y.rows(); ++k) {
          const Index at = first + k * factor;
          if (at + reach < start || at - reach >= end) continue;
          leave_out(run.rows, k, j, size);
        }
      }
      start = std::max(end, start) + 1;
    }
  }
}

void leave_out_joints(EffectRecordings& data, const std::vector<int>& joints) {
  if (joints.empty()) return;
  data.masked.resize(static_cast<std::size_t>(data.joints()), false);
  for (const int j : joints) {
    data.masked[static_cast<std::size_t>(j)] = true;
    for (EffectRun& run : data.runs) {
      const Index size = run.rows.Y.cols() / run.motion.joints();
      for (Index k = 0; k < run.rows.Y.rows(); ++k) leave_out(run.rows, k, j, size);
    }
  }
}

namespace {

/// Samples around an equation that it is made of.
Index felt(const Decimator& decimator) {
  const Index middle = decimator.taps.size() / 2;
  const double least = kFaint * decimator.taps.cwiseAbs().maxCoeff();
  Index reach = middle;
  while (reach > 0 && std::abs(decimator.taps[middle + reach]) < least) --reach;
  return reach;
}

/// Whether a joint reverses or stops at a sample.
bool sticks_at(const Motion& motion, int joint, Index at, double still_speed) {
  const auto speed = motion.dq.col(joint);
  const bool turns = at > 0 && (speed[at] < 0) != (speed[at - 1] < 0);
  return turns || std::abs(speed[at]) < still_speed;
}

/// Ascending ranges, those that meet joined.
std::vector<SampleRange> joined_ranges(std::vector<SampleRange> ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const SampleRange& a, const SampleRange& b) { return a.from < b.from; });
  std::vector<SampleRange> joined;
  for (const SampleRange& range : ranges) {
    if (!joined.empty() && range.from <= joined.back().to) {
      joined.back().to = std::max(joined.back().to, range.to);
    } else {
      joined.push_back(range);
    }
  }
  return joined;
}

}  // namespace

void leave_out_stiction(EffectRun& run, const Eigen::VectorXd& still_speed,
                        const std::vector<int>& joints) {
  const Motion& motion = run.motion;
  const Index factor = run.decimator.factor, first = first_sample(run.decimator);
  // the joint state's own filter widens a stiction interval by about the time between equations
  const Index reach = felt(run.decimator) + factor;
  const Index size = run.rows.Y.cols() / motion.joints();
  for (const int j : joints) {
    for (Index at = 0; at < motion.samples(); ++at) {
      if (!sticks_at(motion, j, at, still_speed[j])) continue;
      const Index from = std::max<Index>(0, (at - reach - first + factor - 1) / factor);
      const Index to = std::min<Index>(run.rows.Y.rows() - 1, (at + reach - first) / factor);
      for (Index k = from; k <= to; ++k) leave_out(run.rows, k, j, size);
    }
  }
}

void mark_stiction(EffectRun& run, const Motion& motion, const Eigen::VectorXd& still_speed,
                   const std::vector<int>& joints, double around) {
  const auto reach = static_cast<Index>(std::ceil(around / motion.sample_time));
  if (!joints.empty()) run.unknown.resize(static_cast<std::size_t>(motion.joints()));
  for (const int j : joints) {
    std::vector<SampleRange>& ranges = run.unknown[static_cast<std::size_t>(j)];
    for (Index at = 0; at < motion.samples(); ++at) {
      if (!sticks_at(motion, j, at, still_speed[j])) continue;
      ranges.push_back(
          {std::max<Index>(0, at - reach), std::min(motion.samples(), at + reach + 1)});
    }
    ranges = joined_ranges(std::move(ranges));
  }
}

namespace {

struct PieceRange {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  [[nodiscard]] bool holds(double q) const { return q >= lowest && q <= highest; }
};

PieceRange visited(const EffectRecordings& data, Index joint) {
  PieceRange range;
  for (const EffectRun& run : data.runs) {
    const auto q = run.motion.q.col(joint);
    range.lowest = std::min(range.lowest, q.minCoeff());
    range.highest = std::max(range.highest, q.maxCoeff());
  }
  return range;
}

}  // namespace

void leave_out_unvisited(EffectRecordings& heldout, const EffectRecordings& train,
                         const EquationRules& rules) {
  for (Index j = 0; j < heldout.joints(); ++j) {
    const PieceRange range = visited(train, j);
    double all = 0;
    std::vector<std::vector<Index>> outside;
    double count = 0;
    for (const EffectRun& run : heldout.runs) {
      outside.emplace_back();
      all += run.rows.counted.col(j).sum();
      const Index first = first_sample(run.decimator);
      for (Index k = 0; k < run.rows.Y.rows(); ++k) {
        if (range.holds(run.motion.q(first + k * run.decimator.factor, j))) continue;
        outside.back().push_back(k);
        count += run.rows.counted(k, j);
      }
    }
    if (all - count < rules.least_equations) continue;
    for (std::size_t r = 0; r < heldout.runs.size(); ++r) {
      EffectRun& run = heldout.runs[r];
      const Index size = run.rows.Y.cols() / run.motion.joints();
      for (const Index k : outside[r]) leave_out(run.rows, k, j, size);
    }
  }
}

}  // namespace dyngen::runtime

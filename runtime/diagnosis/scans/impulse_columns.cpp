// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/impulse_columns.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kResting = 0.015;  // of the largest speed: below it a joint may have stopped

double fastest(const EffectRecordings& data, int joint) {
  double speed = 0;
  for (const EffectRun& run : data.runs) {
    speed = std::max(speed, run.motion.dq.col(joint).cwiseAbs().maxCoeff());
  }
  return speed;
}

/// Samples from the middle of an impulse to its end, and between the middles of two.
Index width_of(const EffectRun& run) { return std::max<Index>(1, run.decimator.factor / 2); }

/// Samples whose torque an equation that counts is made of.
class FeltSamples {
 public:
  FeltSamples(const EffectRun& run, int joint)
      : felt_(static_cast<std::size_t>(run.motion.samples()) + 1, 0) {
    const Index factor = run.decimator.factor, first = first_sample(run.decimator);
    const Index reach = run.decimator.taps.size() / 2;
    const Index samples = run.motion.samples();
    for (Index k = 0; k < run.rows.counted.rows(); ++k) {
      if (!(run.rows.counted(k, joint) > 0)) continue;
      const Index middle = first + k * factor;
      for (Index i = std::max<Index>(0, middle - reach); i <= std::min(samples - 1, middle + reach);
           ++i) {
        felt_[static_cast<std::size_t>(i) + 1] = 1;
      }
    }
    std::partial_sum(felt_.begin(), felt_.end(), felt_.begin());
  }
  /// Whether any of them is from .. to - 1.
  [[nodiscard]] bool any(Index from, Index to) const {
    const Index last = static_cast<Index>(felt_.size()) - 1;
    const auto place = [&](Index i) {
      return static_cast<std::size_t>(std::clamp<Index>(i, 0, last));
    };
    return felt_[place(to)] > felt_[place(from)];
  }

 private:
  std::vector<Index> felt_;  // how many are before a sample
};

/// Samples in the middle of the impulses of a run: some apart from one another over each stretch in
/// which the joint may have stopped, two or more of each.
std::vector<Index> impulses_of(const EffectRun& run, int joint, double still, Index apart) {
  const auto dq = run.motion.dq.col(joint);
  const auto stiction = [&](Index k) {
    return std::abs(dq[k]) < still || (k > 0 && dq[k] * dq[k - 1] < 0);
  };
  std::vector<Index> middles;
  Index end = -1;  // of the last stretch
  for (Index k = 0; k < dq.size(); ++k) {
    if (!stiction(k)) continue;
    const Index from = k;
    Index to = k;
    for (Index i = k; i < std::min(dq.size(), to + apart); ++i) {
      if (stiction(i)) to = i;
    }
    const Index length = to - from, count = std::max<Index>(4, 3 + (length + apart) / apart);
    const Index first = (from + to) / 2 - (count - 1) * apart / 2;
    for (Index i = 0; i < count; ++i) {
      const Index middle = first + i * apart;
      if (middle > end) middles.push_back(middle);
    }
    end = middles.empty() ? -1 : middles.back();
    k = to;
  }
  return middles;
}

/// The same, without those that no counted equation contains, as during a longer standstill.
std::vector<Index> felt_impulses_of(const EffectRun& run, int joint, double still) {
  const Index width = width_of(run);
  std::vector<Index> middles = impulses_of(run, joint, still, width);
  const FeltSamples felt(run, joint);
  std::erase_if(middles,
                [&](Index middle) { return !felt.any(middle - width + 1, middle + width); });
  return middles;
}

/// A triangle of torque about a sample, behind the parallel filter.
/// @param equations  (rows of the run) 0 before
void add_impulse(const EffectRun& run, int joint, Index middle,
                 Eigen::Ref<Eigen::VectorXd> equations) {
  const Index factor = run.decimator.factor, first = first_sample(run.decimator);
  const Index width = width_of(run), reach = run.decimator.taps.size() / 2;
  const Index last = run.motion.samples();
  const Index from = std::max<Index>(0, middle - width), to = std::min(last, middle + width);
  const Index begin = std::max<Index>(0, (from - reach - first) / factor);
  const Index end = std::min(equations.size(), (to + reach - first) / factor + 1);
  for (Index k = begin; k < end; ++k) {
    const Index start = first + k * factor - reach;  // of the taps
    for (Index i = std::max(from, start); i < std::min(to, start + run.decimator.taps.size());
         ++i) {
      const double height =
          1 - std::abs(static_cast<double>(i - middle)) / static_cast<double>(width);
      equations[k] += run.decimator.taps[i - start] * height * run.rows.counted(k, joint);
    }
  }
}

}  // namespace

JointColumns impulse_columns(const EffectRecordings& data, int joint) {
  const double still = kResting * fastest(data, joint);
  std::vector<std::vector<Index>> middles;
  Index count = 0;
  for (const EffectRun& run : data.runs) {
    middles.push_back(felt_impulses_of(run, joint, still));
    count += static_cast<Index>(middles.back().size());
  }
  JointColumns columns = columns_of_joint(joint, MatrixXd::Zero(data.equations(), count));
  Index start = 0, column = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    for (const Index middle : middles[run]) {
      add_impulse(here, joint, middle,
                  columns.parts[0].col(column).segment(start, here.rows.Y.rows()));
      ++column;
    }
    start += here.rows.Y.rows();
  }
  return columns;
}

}  // namespace dyngen::runtime

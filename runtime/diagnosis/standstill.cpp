// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/standstill.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {

using Eigen::Index;

namespace {

constexpr double kLongest = 0.1;  // s below the speed at a reversal

}  // namespace

void leave_out_standstill(EffectRun& run, const Eigen::VectorXd& still_speed) {
  const Motion& motion = run.motion;
  const Index factor = run.decimator.factor, first = first_sample(run.decimator);
  const Index reach = run.decimator.taps.size() / 2;  // of the filter around an equation
  const auto least = static_cast<Index>(std::ceil(kLongest / motion.sample_time));
  const Index size = run.rows.Y.cols() / motion.joints();
  for (Index j = 0; j < motion.joints(); ++j) {
    for (Index start = 0; start < motion.samples();) {
      Index end = start;
      while (end < motion.samples() && std::abs(motion.dq(end, j)) < still_speed[j]) ++end;
      if (end - start >= least) {
        for (Index k = 0; k < run.rows.Y.rows(); ++k) {
          const Index at = first + k * factor;
          if (at + reach < start || at - reach >= end) continue;
          run.rows.counted(k, j) = 0;
          run.rows.tau(k, j) = 0;
          run.rows.Y.row(k).segment(j * size, size).setZero();
        }
      }
      start = std::max(end, start) + 1;
    }
  }
}

}  // namespace dyngen::runtime

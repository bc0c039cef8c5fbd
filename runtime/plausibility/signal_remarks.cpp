// SPDX-License-Identifier: MIT
#include "runtime/plausibility/signal_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/recordings/time_base.h"
#include "runtime/signals/differences.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSlowStep = 0.5;        // s: nobody samples a motion so rarely
constexpr double kQuickStep = 20e-6;     // s: nor so often
constexpr double kCounts = 50;           // range of integers that are no angles
constexpr double kBeyondTorque = 30;     // times taumax: a unit, not a peak
constexpr double kBeyondLimits = 0.05;   // of the range between limits: calibration, not a mistake
constexpr double kVelocityScale = 0.05;  // of velocities beside differences of positions
constexpr double kGoesWith = 0.5;        // correlation below which velocities say nothing

class Remarks {
 public:
  Remarks(const Recording& recording, std::vector<Remark>& remarks)
      : name_(recording.file_name), remarks_(remarks) {}

  void add(const char* kind, bool refused, Index joint, std::string text) {
    remarks_.push_back({kind, refused, static_cast<int>(joint), name_, std::move(text)});
  }

 private:
  std::string name_;
  std::vector<Remark>& remarks_;
};

bool all_integers(const VectorXd& values) {
  return (values.array() == values.array().round()).all();
}

void judge_time(const MotionSource& source, Remarks& remarks) {
  if (source.condition.stands) return;
  const double step = source.sample_time;
  if (step > kSlowStep) {
    remarks.add(
        "time_unit", true, 0,
        fmt::format("a sample every {:.4g} s while joints move: time looks like {}; give it "
                    "in seconds",
                    step, step < 100 ? "milliseconds" : "micro- or nanoseconds"));
  } else if (step < kQuickStep) {
    remarks.add("time_unit", true, 0,
                fmt::format("a sample every {:.3g} s: no controller is so quick; give time in "
                            "seconds",
                            step));
  }
}

void judge_positions(const JudgedRobot& robot, const Recording& recording, Remarks& remarks) {
  const bool limits = robot.lowest.size() == recording.joints();
  for (Index j = 0; j < recording.joints(); ++j) {
    const VectorXd q = recording.q.col(j);
    const double low = q.minCoeff(), high = q.maxCoeff();
    if (high - low > kCounts && all_integers(q)) {
      remarks.add("counts", true, j + 1,
                  fmt::format("q{} holds whole numbers from {:.0f} to {:.0f}: encoder counts? give "
                              "rad (m where the joint slides)",
                              j + 1, low, high));
      continue;
    }
    for (Index i = 0; i < j; ++i) {
      if (high > low && q == recording.q.col(i)) {
        remarks.add(
            "same_column", true, j + 1,
            fmt::format("q{} is q{} in every sample: one column stands twice", j + 1, i + 1));
      }
    }
    if (!limits || !std::isfinite(robot.lowest[j]) || !std::isfinite(robot.highest[j])) continue;
    const double range = robot.highest[j] - robot.lowest[j];
    const double beyond = std::max(robot.lowest[j] - low, high - robot.highest[j]);
    if (beyond <= kBeyondLimits * range) continue;
    remarks.add("range", beyond > range, j + 1,
                fmt::format("q{} goes from {:.4g} to {:.4g}, the robot file allows {:.4g} to "
                            "{:.4g} (qmin, qmax): other units, another zero, or another joint?",
                            j + 1, low, high, robot.lowest[j], robot.highest[j]));
  }
}

void judge_torques(const JudgedRobot& robot, const Recording& recording, Remarks& remarks) {
  const bool limits = robot.most_torque.size() == recording.joints();
  for (Index j = 0; j < recording.joints(); ++j) {
    const VectorXd tau = recording.tau.col(j);
    const double most = tau.cwiseAbs().maxCoeff();
    for (Index i = 0; i < j; ++i) {
      if (tau.maxCoeff() > tau.minCoeff() && tau == recording.tau.col(i)) {
        remarks.add(
            "same_column", true, j + 1,
            fmt::format("tau{} is tau{} in every sample: one column stands twice", j + 1, i + 1));
      }
    }
    if (limits && std::isfinite(robot.most_torque[j]) &&
        most > kBeyondTorque * robot.most_torque[j]) {
      remarks.add("torque_range", true, j + 1,
                  fmt::format("tau{} reaches {:.4g}, {:.3g} times the robot file's taumax: N mm or "
                              "mN m? give N m at the joint",
                              j + 1, most, most / robot.most_torque[j]));
    }
  }
}

/// Of samples a and b: correlation about zero, and the factor that makes b of a.
struct Fit {
  double correlation = 0, slope = 0;
};

Fit compared(const VectorXd& a, const VectorXd& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  if (!(aa > 0 && bb > 0)) return {};
  return {ab / std::sqrt(aa * bb), ab / aa};
}

/// Velocities as differences of positions over a few samples, of one run.
void append_velocities(const Recording& recording, std::size_t run, Index joint,
                       std::vector<double>& of_positions, std::vector<double>& given) {
  constexpr Index kHalf = 3;  // samples on either side: noise of positions counts less
  const Index first = recording.run_starts[run], end = run_end(recording, run);
  for (Index k = first + kHalf; k + kHalf < end; ++k) {
    const double time = recording.time[k + kHalf] - recording.time[k - kHalf];
    of_positions.push_back((recording.q(k + kHalf, joint) - recording.q(k - kHalf, joint)) / time);
    given.push_back(recording.dq.block(k - kHalf, joint, 2 * kHalf + 1, 1).mean());
  }
}

void judge_velocities(const Recording& recording, double sample_time, Remarks& remarks) {
  if (recording.dq.size() == 0) return;
  constexpr double kMostLag = 0.05;  // s
  const Index most = std::min<Index>(static_cast<Index>(kMostLag / sample_time), 100);
  for (Index j = 0; j < recording.joints(); ++j) {
    std::vector<double> differences, columns;
    for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
      append_velocities(recording, run, j, differences, columns);
    }
    const auto count = static_cast<Index>(columns.size());
    if (count < 4 * most + 64) continue;
    const Eigen::Map<const VectorXd> own(differences.data(), count), given(columns.data(), count);
    if (!(own.cwiseAbs().maxCoeff() > 0)) continue;
    if (given.cwiseAbs().maxCoeff() == 0) {
      remarks.add(
          "velocity", false, j + 1,
          fmt::format("qd{0} is 0 throughout while q{0} moves: it was not measured", j + 1));
      continue;
    }
    Fit best;
    Index lag = 0;
    for (Index shift = -most; shift <= most; ++shift) {
      const Fit fit = compared(own.segment(most, count - 2 * most),
                               given.segment(most + shift, count - 2 * most));
      if (std::abs(fit.correlation) <= std::abs(best.correlation) + 1e-6) continue;
      best = fit;
      lag = shift;
    }
    const Fit here =
        compared(own.segment(most, count - 2 * most), given.segment(most, count - 2 * most));
    if (std::abs(best.correlation) < kGoesWith) {
      remarks.add("velocity", false, j + 1,
                  fmt::format("qd{0} does not go with q{0} (correlation {1:.2f}): another joint's, "
                              "or another unit?",
                              j + 1, here.correlation));
      continue;
    }
    if (std::abs(best.slope - 1) > kVelocityScale) {
      remarks.add("velocity", false, j + 1,
                  fmt::format("qd{0} is {1:.4g} times what q{0} and time say: unit, sign, gear or "
                              "sampling rate?",
                              j + 1, best.slope));
    }
    // a lag that matters: what is left of velocities is a hundredth of them
    const double unlike = 1 - here.correlation / best.correlation;
    if (std::abs(lag) > 1 && unlike > 5e-5) {
      remarks.add("lag", false, j + 1,
                  fmt::format("qd{0} {1} q{0} by {2:.3g} ms", j + 1,
                              lag > 0 ? "lags behind" : "is ahead of",
                              1e3 * sample_time * static_cast<double>(std::abs(lag))));
    }
  }
}

/// For how many samples a position is held: the length that most stretches of equal values have; 1
/// where they have none.
Index held_samples(const VectorXd& q) {
  constexpr double kRegular =
      0.7;  // of the stretches, without those that are longer: the joint rests
  constexpr Index kLongest = 64;
  std::vector<Index> stretches(kLongest + 1, 0);
  Index length = 1, all = 0;
  for (Index k = 1; k < q.size(); ++k) {
    if (q[k] == q[k - 1]) {
      ++length;
      continue;
    }
    if (length <= kLongest) {
      ++stretches[static_cast<std::size_t>(length)];
      ++all;
    }
    length = 1;
  }
  const auto most = std::max_element(stretches.begin(), stretches.end());
  const bool regular = all > 64 && static_cast<double>(*most) > kRegular * static_cast<double>(all);
  return regular ? most - stretches.begin() : 1;
}

void judge_held_positions(const Recording& recording, double sample_time, Remarks& remarks) {
  for (Index j = 0; j < recording.joints(); ++j) {
    const Index held = held_samples(recording.q.col(j));
    if (held < 2) continue;
    remarks.add("lag", false, j + 1,
                fmt::format("q{} changes every {} samples only (held between them): it lags behind "
                            "torque by some {:.2g} ms",
                            j + 1, held, 0.5e3 * sample_time * static_cast<double>(held - 1)));
  }
}

void judge_clipped_torque(const MotionSource& source, Remarks& remarks) {
  const std::vector<bool>& clipped = source.condition.torque_clipped;
  for (std::size_t j = 0; j < clipped.size(); ++j) {
    if (!clipped[j]) continue;
    remarks.add(
        "clipped", false, static_cast<Index>(j) + 1,
        fmt::format("tau{} stands at its limit for a part of the time: what the motion took "
                    "there is not known, and parameters come out too small; leave that "
                    "motion out",
                    j + 1));
  }
}

void judge_dead_torque(const MotionSource& source, const Recording& recording, Remarks& remarks) {
  const std::vector<bool>& dead = source.condition.torque_dead;
  for (std::size_t j = 0; j < dead.size(); ++j) {
    if (!dead[j]) continue;
    remarks.add("torque_dead", false, static_cast<Index>(j) + 1,
                fmt::format("tau{} is {:.4g} throughout: it was not measured; the joint has no "
                            "equations",
                            j + 1, recording.tau(0, static_cast<Index>(j))));
  }
}

}  // namespace

void add_signal_remarks(const JudgedRobot& robot, const MotionSource& source,
                        std::vector<Remark>& remarks) {
  if (!source.recorded) return;
  const Recording& recording = *source.recorded;
  Remarks own(recording, remarks);
  judge_time(source, own);
  judge_positions(robot, recording, own);
  if (recording.tau.size() != 0) {
    judge_torques(robot, recording, own);
    judge_dead_torque(source, recording, own);
    judge_clipped_torque(source, own);
  }
  judge_velocities(recording, source.sample_time, own);
  judge_held_positions(recording, source.sample_time, own);
}

}  // namespace dyngen::runtime

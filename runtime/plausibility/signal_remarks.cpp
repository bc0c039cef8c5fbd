// SPDX-License-Identifier: MIT
#include "runtime/plausibility/signal_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/plausibility/derivative_remarks.h"
#include "runtime/recordings/held_columns.h"
#include "runtime/recordings/time_base.h"

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

void judge_held_positions(const Recording& recording, double sample_time, Remarks& remarks) {
  for (Index j = 0; j < recording.joints(); ++j) {
    const Index held = find_held(recording.q.col(j)).period;
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
  if (!source.condition.stands && recording.samples() > 1) {
    const double step = recording.time[1] - recording.time[0];  // its time base is uniform
    for (Remark& remark : derivative_remarks(recording, step)) {
      remarks.push_back(std::move(remark));
    }
  }
  judge_held_positions(recording, source.sample_time, own);
}

}  // namespace dyngen::runtime

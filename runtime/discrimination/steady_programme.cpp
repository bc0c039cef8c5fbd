// SPDX-License-Identifier: MIT
#include "runtime/discrimination/steady_programme.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "runtime/discrimination/joint_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// s of a run beside what a mean is taken of: settling at both ends.
constexpr double kSettling = 0.5;
/// s at least of a run at constant speed, settling included: a faster one is not made.
constexpr double kShortestRun = 1;
/// Of the fastest speed: the slowest one.
constexpr double kSlowest = 0.01;
/// Of the range: what a programme stays away from its ends.
constexpr double kMargin = 0.01;
/// Of speeds and accelerations: rounding stays within the limits.
constexpr double kWithin = 1 - 1e-9;
/// s of a pause between strokes.
constexpr double kPause = 0.2;

class ProgrammeMaker {
 public:
  ProgrammeMaker(const MotionLimits& limits, const ProgrammeOptions& options)
      : limits_(limits), options_(options) {
    limits_.speed *= kWithin;
    limits_.acceleration *= kWithin;
    const Index n = limits.lower.size();
    lower_ = limits.lower + kMargin * (limits.upper - limits.lower);
    upper_ = limits.upper - kMargin * (limits.upper - limits.lower);
    const VectorXd posture =
        options.posture.size() > 0 ? options.posture : 0.5 * (limits.lower + limits.upper);
    for (Index j = 0; j < n; ++j) paths_.emplace_back(posture[j]);
    posture_ = posture;
    joints_ = options.joints;
    if (joints_.empty()) {
      joints_.resize(static_cast<std::size_t>(n));
      std::iota(joints_.begin(), joints_.end(), 0);
    }
  }

  Programme run() {
    if (options_.kind == ProgrammeKind::kPoses) {
      add_poses();
    } else {
      for (const int joint : joints_) {
        options_.kind == ProgrammeKind::kSpeeds ? add_speeds(joint) : add_sweeps(joint);
        // back to the posture of the others
        move(joint, posture_[joint], calm_speed(joint));
      }
    }
    Programme programme;
    programme.steps = std::move(steps_);
    const auto ways = std::make_shared<const std::vector<JointPath>>(std::move(paths_));
    double duration = kPause;
    for (const JointPath& path : *ways) duration = std::max(duration, path.duration() + kPause);
    programme.motion = {duration,
                        [ways](const VectorXd& time) { return motion_along(*ways, time); }};
    return programme;
  }

 private:
  static JointMotion motion_along(const std::vector<JointPath>& paths, const VectorXd& time) {
    const auto n = static_cast<Index>(paths.size());
    JointMotion motion{MatrixXd(time.size(), n), MatrixXd(time.size(), n),
                       MatrixXd(time.size(), n)};
    for (Index j = 0; j < n; ++j) {
      for (Index k = 0; k < time.size(); ++k) {
        const JointPath::Instant at = paths[static_cast<std::size_t>(j)].at(time[k]);
        motion.q(k, j) = at.q;
        motion.dq(k, j) = at.dq;
        motion.ddq(k, j) = at.ddq;
      }
    }
    return motion;
  }

  [[nodiscard]] double calm_speed(Index joint) const { return 0.25 * limits_.speed[joint]; }

  /// One joint moves, the others wait. @return when it began to
  double move(Index joint, double to, double speed) {
    wait(kPause);
    const double begin = time_;
    JointPath& path = paths_[static_cast<std::size_t>(joint)];
    path.move(to, speed, limits_.acceleration[joint]);
    time_ = std::max(time_, path.duration());
    return begin;
  }

  void wait(double seconds) {
    time_ += seconds;
    for (JointPath& path : paths_) path.wait_until(time_);
  }

  /// A stroke with its step.
  void stroke(Index joint, double to, double speed) {
    const double from = paths_[static_cast<std::size_t>(joint)].position();
    const double distance = std::abs(to - from);
    if (!(distance > 0)) return;
    const double begin = move(joint, to, speed);
    const double whole = time_ - begin;
    // a stroke takes distance / speed and a ramp: what is left between both ramps is constant
    const double reached = std::min(speed, top_speed(joint, distance));
    const double ramp = whole - distance / reached;
    steps_.push_back({static_cast<int>(joint), begin + ramp, whole - 2 * ramp,
                      to > from ? reached : -reached, from, to, 0});
  }

  /// What a stroke of this length reaches before it has to brake.
  [[nodiscard]] double top_speed(Index joint, double distance) const {
    return std::sqrt(0.5 * limits_.acceleration[joint] * distance);
  }

  /// The fastest speed that the range holds for the shortest run.
  [[nodiscard]] double fastest(Index joint) const {
    const double range = upper_[joint] - lower_[joint], a = limits_.acceleration[joint];
    // v kShortestRun + v ramp = range, where the ramp takes 2 v / a, or 0.1 s if that is more
    constexpr double kRamp = 0.1;
    const double quadratic =
        0.25 * a * (std::sqrt(kShortestRun * kShortestRun + 8 * range / a) - kShortestRun);
    return std::min({limits_.speed[joint], quadratic, range / (kShortestRun + kRamp)});
  }

  void add_speeds(Index joint) {
    const double range = upper_[joint] - lower_[joint], a = limits_.acceleration[joint];
    const double fast = fastest(joint);
    const int count = options_.step_count();
    for (int place = 0; place < count; ++place) {
      // slow and fast in turn: what drifts with time is not taken for what depends on the speed
      const int k = place % 2 == 0 ? place / 2 : count - 1 - place / 2;
      const double share = count > 1 ? static_cast<double>(k) / (count - 1) : 1;
      const double speed = fast * std::pow(kSlowest, 1 - share);
      constexpr double kRamp = 0.1;
      const double ramp = std::max(kRamp, 2 * speed / a);
      const double distance = std::min(range, speed * (options_.hold_seconds() + kSettling + ramp));
      const double centre = std::clamp(posture_[joint], lower_[joint] + 0.5 * distance,
                                       upper_[joint] - 0.5 * distance);
      constexpr int kMostPasses = 4;
      const double used = std::max(0.1, distance / speed - ramp - kSettling);
      const int passes =
          std::clamp(static_cast<int>(std::lround(options_.hold_seconds() / used)), 1, kMostPasses);
      move(joint, centre - 0.5 * distance, calm_speed(joint));
      for (int pass = 0; pass < passes; ++pass) {
        stroke(joint, centre + 0.5 * distance, speed);
        stroke(joint, centre - 0.5 * distance, speed);
      }
    }
  }

  void add_sweeps(Index joint) {
    constexpr double kMostSpeed = 0.1;  // of the limit: a sweep is slow
    const double range = upper_[joint] - lower_[joint];
    const double speed =
        std::min(kMostSpeed * limits_.speed[joint], range / options_.hold_seconds());
    move(joint, lower_[joint], calm_speed(joint));
    for (int k = 0; k < options_.step_count(); ++k) {
      stroke(joint, upper_[joint], speed);
      stroke(joint, lower_[joint], speed);
    }
  }

  /// All joints that move go there at once and wait for one another.
  void all_to(const VectorXd& q, double share_of_speed) {
    double longest = 0;
    for (const int j : joints_) {
      JointPath& path = paths_[static_cast<std::size_t>(j)];
      path.move(q[j], share_of_speed * limits_.speed[j], limits_.acceleration[j]);
      longest = std::max(longest, path.duration());
    }
    time_ = std::max(time_, longest);
    for (JointPath& path : paths_) path.wait_until(time_);
  }

  void hold_pose(const VectorXd& q, int side) {
    const double begin = time_;
    wait(options_.hold_seconds());
    for (const int j : joints_) {
      steps_.push_back({j, begin, options_.hold_seconds(), 0, q[j], q[j], side});
    }
  }

  void add_poses() {
    constexpr double kSlow = 0.1, kCalm = 0.25;    // of the speed limit
    constexpr double kPart = 0.05, kWidest = 0.1;  // of the range; rad or m: the way to a pose
    const VectorXd range = upper_ - lower_;
    const VectorXd way = (kPart * range).cwiseMin(kWidest);
    for (int k = 0; k < options_.step_count(); ++k) {
      VectorXd q = posture_;
      for (std::size_t i = 0; i < joints_.size(); ++i) {
        const int j = joints_[i];
        q[j] = lower_[j] + way[j] + halton(k + 1, static_cast<int>(i)) * (range[j] - 2 * way[j]);
      }
      for (const int side : {-1, 1}) {
        all_to(q + side * way, kCalm);
        all_to(q, kSlow);
        hold_pose(q, side);
      }
    }
    all_to(posture_, kCalm);
  }

  /// Points that fill a cube evenly. Source: Halton 1960.
  static double halton(int index, int dimension) {
    constexpr int kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    constexpr int kBases = static_cast<int>(std::size(kPrimes));
    const int base = kPrimes[dimension % kBases];
    double value = 0, part = 1;
    for (int rest = index; rest > 0; rest /= base) {
      part /= base;
      value += part * (rest % base);
    }
    return value;
  }

  MotionLimits limits_;
  const ProgrammeOptions& options_;
  VectorXd lower_, upper_, posture_;
  std::vector<int> joints_;
  std::vector<JointPath> paths_;
  std::vector<ProgrammeStep> steps_;
  double time_ = 0;
};

}  // namespace

double ProgrammeOptions::hold_seconds() const {
  if (hold > 0) return hold;
  constexpr double kRun = 6, kPose = 2, kSweep = 30;
  return kind == ProgrammeKind::kSpeeds ? kRun : kind == ProgrammeKind::kPoses ? kPose : kSweep;
}

int ProgrammeOptions::step_count() const {
  if (count > 0) return count;
  constexpr int kSpeedCount = 10, kPoseCount = 20, kSweepCount = 2;
  return kind == ProgrammeKind::kSpeeds  ? kSpeedCount
         : kind == ProgrammeKind::kPoses ? kPoseCount
                                         : kSweepCount;
}

void ProgrammeOptions::validate(const MotionLimits& limits) const {
  const Index n = limits.lower.size();
  for (const int joint : joints) {
    if (joint >= 0 && joint < n) continue;
    throw std::invalid_argument(fmt::format("--joints: found {}, expected 1 to {}", joint + 1, n));
  }
  if (posture.size() != 0 && posture.size() != n) {
    throw std::invalid_argument(
        fmt::format("--posture: {} values, expected one for each of {} joints", posture.size(), n));
  }
  for (Index j = 0; j < posture.size(); ++j) {
    if (posture[j] >= limits.lower[j] && posture[j] <= limits.upper[j]) continue;
    throw std::invalid_argument(
        fmt::format("--posture: {} of joint {}, expected {:.6g} to {:.6g} as the limits allow",
                    posture[j], j + 1, limits.lower[j], limits.upper[j]));
  }
  for (Index j = 0; j < n; ++j) {
    if (std::isfinite(limits.speed[j]) && std::isfinite(limits.acceleration[j])) continue;
    throw std::invalid_argument(
        fmt::format("steady_programme(): joint {} has no limit of speed or acceleration", j + 1));
  }
}

Programme steady_programme(const MotionLimits& limits, const ProgrammeOptions& options) {
  options.validate(limits);
  return ProgrammeMaker(limits, options).run();
}

}  // namespace dyngen::runtime

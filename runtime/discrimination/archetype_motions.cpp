// SPDX-License-Identifier: MIT
#include "runtime/discrimination/archetype_motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "runtime/discrimination/joint_path.h"
#include "runtime/excitation/limited_trajectory.h"
#include "runtime/excitation/trajectory_basis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Where the free numbers of a motion along strokes stand; two postures of n joints follow, of
/// which the entries of the joint itself are not read.
enum Place : Index { kAmplitude, kCentre, kSlow, kFast, kRatio, kAcceleration, kPostures };

double between(double low, double high, double x) { return low + x * (high - low); }
double logarithmically(double low, double high, double x) { return low * std::pow(high / low, x); }

/// What the numbers mean for the joint that moves.
struct Strokes {
  double centre = 0, amplitude = 0;    ///< rad or m
  double slow = 0, fast = 0;           ///< rad/s or m/s
  double ratio = 0, acceleration = 0;  ///< of one reversal to the one before
};

Strokes strokes_of(const VectorXd& x, const MotionLimits& limits, Index joint) {
  constexpr double kLeastAmplitude = 0.02, kLeastSpeed = 0.012, kLeastAcceleration = 0.03;
  constexpr double kLeastRatio = 0.3, kMostRatio = 0.95;
  const double lower = limits.lower[joint], upper = limits.upper[joint];
  const double half = 0.5 * (upper - lower);
  Strokes s;
  s.amplitude = half * between(kLeastAmplitude, 1, x[kAmplitude]);
  s.centre = between(lower + s.amplitude, upper - s.amplitude, x[kCentre]);
  s.acceleration =
      limits.acceleration[joint] * logarithmically(kLeastAcceleration, 1, x[kAcceleration]);
  const double speed = std::isfinite(limits.speed[joint])
                           ? limits.speed[joint]
                           : std::sqrt(limits.acceleration[joint] * half);
  s.slow = speed * logarithmically(kLeastSpeed, 1, x[kSlow]);
  s.fast = speed * logarithmically(kLeastSpeed, 1, x[kFast]);
  s.ratio = between(kLeastRatio, kMostRatio, x[kRatio]);
  return s;
}

/// Where strokes begin and end. Patterns leave this point in one direction and come back in the
/// other. Every stop is thus a reversal: stiction holds a joint that stops without one for an
/// unknown time.
double end_of(const Strokes& s) { return s.centre - s.amplitude; }

/// There and back over the whole amplitude.
void both_ways(JointPath& path, const Strokes& s, double speed, double until) {
  fill(path, until, [&](JointPath& p, double size) {
    p.move(end_of(s) + 2 * size * s.amplitude, speed, s.acceleration);
    p.move(end_of(s), speed, s.acceleration);
  });
}

/// Every reversal a part of the one before.
void reversals(JointPath& path, const Strokes& s, double speed, double until) {
  constexpr int kReversals = 5;  // odd: the last is on the other side
  fill(path, until, [&](JointPath& p, double size) {
    double turn = s.amplitude;
    for (int i = 0; i < kReversals; ++i) {
      turn *= -s.ratio;
      p.move(end_of(s) + size * (s.amplitude - turn), speed, s.acceleration);
    }
    p.move(end_of(s), speed, s.acceleration);
  });
}

/// The k-th of count speeds from slow to fast.
double step_of(const Strokes& s, int k, int count) {
  return logarithmically(s.slow, s.fast, static_cast<double>(k) / (count - 1));
}

VectorXd posture_of(const VectorXd& x, const MotionLimits& limits, Index which) {
  const Index n = limits.lower.size();
  return limits.lower +
         x.segment(kPostures + which * n, n).cwiseProduct(limits.upper - limits.lower);
}

/// s: until all joints but one have gone from one posture to another.
double transfer_time(const VectorXd& from, const VectorXd& to, const MotionLimits& limits,
                     Index joint) {
  double longest = 0;
  for (Index j = 0; j < from.size(); ++j) {
    if (j == joint) continue;
    longest = std::max(
        longest, stroke_time(std::abs(to[j] - from[j]), limits.speed[j], limits.acceleration[j]));
  }
  return longest;
}

/// As near to `to` as an eighth of the time lets the joints get.
VectorXd in_reach(const VectorXd& from, const VectorXd& to, const MotionLimits& limits, Index joint,
                  double duration) {
  constexpr double kPart = 0.125;
  constexpr int kHalvings = 40;
  if (transfer_time(from, to, limits, joint) <= kPart * duration) return to;
  double low = 0, high = 1;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    const double time = transfer_time(from, from + middle * (to - from), limits, joint);
    (time > kPart * duration ? high : low) = middle;
  }
  return from + low * (to - from);
}

PlannedMotion along(std::vector<JointPath> paths, double duration) {
  const auto ways = std::make_shared<const std::vector<JointPath>>(std::move(paths));
  return {duration, [ways](const VectorXd& time) {
            const auto n = static_cast<Index>(ways->size());
            JointMotion motion{MatrixXd(time.size(), n), MatrixXd(time.size(), n),
                               MatrixXd(time.size(), n)};
            for (Index j = 0; j < n; ++j) {
              for (Index k = 0; k < time.size(); ++k) {
                const JointPath::Instant at = (*ways)[static_cast<std::size_t>(j)].at(time[k]);
                motion.q(k, j) = at.q;
                motion.dq(k, j) = at.dq;
                motion.ddq(k, j) = at.ddq;
              }
            }
            return motion;
          }};
}

/// One joint goes there and back, the others hold a posture; at two loads, two of them.
PlannedMotion stroke_motion(Archetype archetype, Index joint, double duration, const VectorXd& x,
                            const MotionLimits& limits) {
  constexpr int kSpeeds = 5;
  const Strokes s = strokes_of(x, limits, joint);
  const VectorXd posture = posture_of(x, limits, 0);
  std::vector<JointPath> paths;
  for (Index j = 0; j < posture.size(); ++j)
    paths.emplace_back(j == joint ? end_of(s) : posture[j]);
  JointPath& path = paths[static_cast<std::size_t>(joint)];
  switch (archetype) {
    case Archetype::kNestedReversals:
      for (int k = 0; k < 3; ++k) reversals(path, s, step_of(s, k, 3), duration * (k + 1) / 3);
      break;
    case Archetype::kSlowBothWays:
      for (int k = 0; k < kSpeeds; ++k) {
        both_ways(path, s, step_of(s, k, kSpeeds), duration * (k + 1) / kSpeeds);
      }
      break;
    case Archetype::kTwoLoads: {
      const VectorXd other = in_reach(posture, posture_of(x, limits, 1), limits, joint, duration);
      const double transfer = transfer_time(posture, other, limits, joint);
      const double half = 0.5 * duration - transfer;
      for (const double begin : {0.0, half + transfer}) {
        path.wait_until(begin);
        both_ways(path, s, s.slow, begin + 0.5 * half);
        both_ways(path, s, s.fast, begin + half);
      }
      for (Index j = 0; j < posture.size(); ++j) {
        if (j == joint) continue;
        JointPath& own = paths[static_cast<std::size_t>(j)];
        own.wait_until(half);
        own.move(other[j], limits.speed[j], limits.acceleration[j]);
        own.wait_until(duration - transfer);
        own.move(posture[j], limits.speed[j], limits.acceleration[j]);
      }
      break;
    }
    case Archetype::kColdAndWarm:
      both_ways(path, s, s.slow, 0.25 * duration);
      both_ways(path, s, s.fast, 0.75 * duration);
      both_ways(path, s, s.slow, duration);
      break;
    case Archetype::kTwoSpeeds:
      both_ways(path, s, s.slow, 0.6 * duration);
      both_ways(path, s, s.fast, duration);
      break;
    default:
      both_ways(path, s, s.slow, duration);
  }
  return along(std::move(paths), duration);
}

/// Sines of several joints: numbers are the base frequency, the size of every joint's motion, its
/// mean, and coefficients.
struct SineForm {
  double duration = 10;
  double least = 0.1, most = 0.1;  ///< Hz, of the base frequency
  int harmonics = 5;

  [[nodiscard]] TrajectoryFamily family(double x) const {
    const double wanted = logarithmically(least, most, x);
    const double repeats = std::max(1.0, std::round(wanted * duration));
    return {
        .form = TrajectoryForm::kFourier, .duration = duration / repeats, .harmonics = harmonics};
  }
};

PlannedMotion sine_motion(const SineForm& form, const VectorXd& x, const MotionLimits& limits) {
  constexpr double kUsed = 0.98;  // what peaks between the instants may add is less
  const Index n = limits.lower.size();
  const TrajectoryFamily family = form.family(x[0]);
  const TrajectoryBasis basis = basis_at(family, sought_times(family));
  const MatrixXd units = parameter_units(basis, limits);
  const Index shapes = units.rows() - 1;
  MatrixXd parameters(units.rows(), n);
  for (Index j = 0; j < n; ++j) {
    const double mean = between(limits.lower[j], limits.upper[j], x[1 + n + j]);
    const VectorXd shape = (2 * x.segment(1 + 2 * n + j * shapes, shapes).array() - 1)
                               .matrix()
                               .cwiseProduct(units.col(j).tail(shapes));
    const VectorXd moved = basis.Q.rightCols(shapes) * shape;
    const double up = limits.upper[j] - mean, down = mean - limits.lower[j];
    const double used = std::max(
        {moved.maxCoeff() / std::max(up, 1e-9), -moved.minCoeff() / std::max(down, 1e-9),
         (basis.dQ.rightCols(shapes) * shape).cwiseAbs().maxCoeff() / limits.speed[j],
         (basis.ddQ.rightCols(shapes) * shape).cwiseAbs().maxCoeff() / limits.acceleration[j]});
    parameters(0, j) = mean;
    parameters.col(j).tail(shapes) = shape * (used > 0 ? kUsed * x[1 + j] / used : 0);
  }
  return {form.duration, [family, parameters](const VectorXd& time) {
            const VectorXd phase = time.unaryExpr([&](double t) {
              return std::clamp(t - family.duration * std::floor(t / family.duration), 0.0,
                                family.duration);
            });
            return basis_at(family, phase).motion(parameters);
          }};
}

/// Numbers to begin with, by archetype: amplitude, centre, slow, fast, ratio, acceleration.
std::array<double, kPostures> first_numbers(Archetype archetype) {
  switch (archetype) {
    case Archetype::kNestedReversals:
      return {0.1, 0.5, 0.3, 0.9, 0.6, 0.9};
    case Archetype::kSlowBothWays:
      return {0.4, 0.5, 0.15, 0.7, 0.5, 0.9};
    case Archetype::kTwoLoads:
      return {0.6, 0.5, 0.5, 0.9, 0.5, 0.9};
    case Archetype::kColdAndWarm:
      return {0.6, 0.5, 0.6, 1.0, 0.5, 1.0};
    case Archetype::kTwoSpeeds:
      return {0.6, 0.5, 0.4, 1.0, 0.5, 1.0};
    default:
      return {0.95, 0.5, 0.7, 0.7, 0.5, 0.7};
  }
}

void add_strokes(std::vector<ArchetypeMotion>& motions, Index joint, const MotionLimits& limits,
                 double duration, std::mt19937_64& random) {
  constexpr int kStarts = 3;
  const Index n = limits.lower.size();
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Archetype archetype :
       {Archetype::kNestedReversals, Archetype::kSlowBothWays, Archetype::kTwoLoads,
        Archetype::kColdAndWarm, Archetype::kTwoSpeeds, Archetype::kSlowSweep}) {
    for (int i = 0; i < kStarts; ++i) {
      ArchetypeMotion motion{archetype, static_cast<int>(joint), {}, {}, {}};
      const auto first = first_numbers(archetype);
      motion.start.resize(kPostures + 2 * n);
      motion.start.head(kPostures) = Eigen::Map<const VectorXd>(first.data(), kPostures);
      // the first posture is the middle, the other ones are anywhere
      for (Index k = kPostures; k < motion.start.size(); ++k) {
        motion.start[k] = i == 0 && k < kPostures + n ? 0.5 : uniform(random);
      }
      if (i > 0) motion.start[kCentre] = uniform(random);
      motion.smaller = [](VectorXd x, double factor) {
        for (const Index place : {kAmplitude, kSlow, kFast, kAcceleration}) x[place] *= factor;
        return x;
      };
      motion.motion = [=](const VectorXd& x, const MotionLimits& within) {
        return stroke_motion(archetype, joint, duration, x, within);
      };
      motions.push_back(std::move(motion));
    }
  }
}

/// @param joint  that moves alone; -1: all of them
void add_sines(std::vector<ArchetypeMotion>& motions, Archetype archetype, int joint,
               const MotionLimits& limits, const SineForm& form, std::mt19937_64& random) {
  const Index n = limits.lower.size();
  const Index shapes = form.family(0).size() - 1;
  std::uniform_real_distribution<double> uniform(0, 1);
  ArchetypeMotion motion{archetype, joint, VectorXd(1 + 2 * n + n * shapes), {}, {}};
  for (double& x : motion.start) x = uniform(random);
  motion.start[0] = 0.5;
  for (Index j = 0; j < n; ++j) {
    const double size = joint >= 0 && j != joint ? 0 : 1;
    motion.start[1 + j] = size;
    motion.start[1 + n + j] = between(0.3, 0.7, motion.start[1 + n + j]);
  }
  motion.smaller = [n](VectorXd x, double factor) {
    x.segment(1, n) *= factor;
    return x;
  };
  motion.motion = [form](const VectorXd& x, const MotionLimits& within) {
    return sine_motion(form, x, within);
  };
  motions.push_back(std::move(motion));
}

}  // namespace

std::vector<ArchetypeMotion> archetype_motions(const MotionLimits& limits, int joint,
                                               double duration, std::uint64_t seed) {
  constexpr int kStarts = 3;
  std::mt19937_64 random(seed);
  std::vector<ArchetypeMotion> motions;
  const auto n = static_cast<int>(limits.lower.size());
  for (int j = joint < 0 ? 0 : joint; j < (joint < 0 ? n : joint + 1); ++j) {
    add_strokes(motions, j, limits, duration, random);
  }
  const double base = 1 / duration;
  const SineForm small{duration, std::max(base, 0.4), std::max(base, 3.0), 4};
  const SineForm wide{duration, base, base, 5};
  for (int i = 0; i < kStarts; ++i) {
    if (joint >= 0) add_sines(motions, Archetype::kSmallAndFast, joint, limits, small, random);
    add_sines(motions, Archetype::kSmallAndFast, -1, limits, small, random);
    add_sines(motions, Archetype::kAllJoints, -1, limits, wide, random);
  }
  return motions;
}

}  // namespace dyngen::runtime

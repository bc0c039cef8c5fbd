// SPDX-License-Identifier: MIT
#include "runtime/discrimination/joint_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dyngen::runtime {
namespace {

constexpr double kPi = std::numbers::pi;

/// s: what is faster no drive follows, and no equation of a recording sees.
constexpr double kShortestRamp = 0.1;

/// What is reached of a stroke: two ramps take the distance speed * ramp.
struct Ramps {
  double speed = 0, ramp = 0;
};

Ramps ramps_of(double distance, double speed, double acceleration) {
  const double reached =
      std::min({speed, std::sqrt(0.5 * acceleration * distance), distance / kShortestRamp});
  return {reached, std::max(2 * reached / acceleration, kShortestRamp)};
}

}  // namespace

double stroke_time(double distance, double speed, double acceleration) {
  if (!(distance > 0)) return 0;
  const Ramps ramps = ramps_of(distance, speed, acceleration);
  return distance / ramps.speed + ramps.ramp;
}

void JointPath::move(double to, double speed, double acceleration) {
  const double distance = std::abs(to - end_);
  if (!(distance > 0)) return;
  const Ramps ramps = ramps_of(distance, speed, acceleration);
  Stroke stroke;
  stroke.begin = duration_;
  stroke.from = end_;
  stroke.to = to;
  stroke.speed = ramps.speed;
  stroke.ramp = ramps.ramp;
  stroke.whole = stroke_time(distance, speed, acceleration);
  strokes_.push_back(stroke);
  duration_ += stroke.whole;
  end_ = to;
}

void JointPath::wait_until(double time) { duration_ = std::max(duration_, time); }

JointPath::Instant JointPath::at(double time) const {
  const auto after =
      std::upper_bound(strokes_.begin(), strokes_.end(), time,
                       [](double moment, const Stroke& stroke) { return moment < stroke.begin; });
  if (after == strokes_.begin()) return {start_, 0, 0};
  const Stroke& stroke = *(after - 1);
  const double t = time - stroke.begin;
  if (t >= stroke.whole) return {stroke.to, 0, 0};
  // the second half is the first one backwards
  const bool late = t > 0.5 * stroke.whole;
  const double s = late ? stroke.whole - t : t;
  const double T = stroke.ramp, a = 2 * stroke.speed / T, w = 2 * kPi / T;
  double x = 0, v = stroke.speed, acc = 0;
  if (s < T) {
    x = a * (0.25 * s * s + (std::cos(w * s) - 1) / (2 * w * w));
    v = a * (0.5 * s - std::sin(w * s) / (2 * w));
    acc = 0.5 * a * (1 - std::cos(w * s));
  } else {
    x = stroke.speed * (s - 0.5 * T);
  }
  const double way = stroke.to > stroke.from ? 1 : -1;
  x = std::min(x, std::abs(stroke.to - stroke.from));
  return late ? Instant{stroke.to - way * x, way * v, -way * acc}
              : Instant{stroke.from + way * x, way * v, way * acc};
}

void fill(JointPath& path, double until,
          const std::function<void(JointPath& path, double size)>& pattern) {
  constexpr double kShortest = 0.05;  // s that are not worth a pattern
  constexpr int kMost = 10000, kHalvings = 50;
  const auto time_of = [&](double size) {
    JointPath trial(path.position());
    pattern(trial, size);
    return trial.duration();
  };
  const double whole = time_of(1);
  for (int i = 0; i < kMost && until - path.duration() > kShortest; ++i) {
    const double room = until - path.duration();
    double size = 1;
    if (whole > room) {
      double low = 0, high = 1;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (low + high);
        (time_of(middle) > room ? high : low) = middle;
      }
      size = low;
    }
    const double before = path.duration();
    pattern(path, size);
    if (!(path.duration() > before) || size < 1) break;
  }
  path.wait_until(until);
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dyngen::runtime {

/// s: from rest to rest over a distance. An acceleration a sin^2 reaches the speed and falls back,
/// so that it has no jump, in 0.1 s at least; where the distance is too short for the speed, a
/// lower one is reached.
/// @param distance  rad or m, not negative        @param speed, acceleration  positive
double stroke_time(double distance, double speed, double acceleration);

/// The way of one joint: strokes from rest to rest and pauses, one after the other. Neither speed
/// nor acceleration is ever above what was asked, nor the position beyond the ends of a stroke.
class JointPath {
 public:
  explicit JointPath(double start) : start_(start), end_(start) {}

  void move(double to, double speed, double acceleration);
  /// Stands until then; nothing if it is later already.
  void wait_until(double time);

  [[nodiscard]] double duration() const { return duration_; }  ///< s
  [[nodiscard]] double position() const { return end_; }       ///< at the end

  struct Instant {
    double q = 0, dq = 0, ddq = 0;
  };
  /// Beyond its ends it stands.
  [[nodiscard]] Instant at(double time) const;

 private:
  struct Stroke {
    double begin = 0, from = 0, to = 0;
    double speed = 0, ramp = 0, whole = 0;  ///< reached; s of one ramp and of all of it
  };

  double start_, end_, duration_ = 0;
  std::vector<Stroke> strokes_;
};

/// Fills the time until then with a pattern that comes back to where it began: whole ones as often
/// as there is room, then one that is as small as it must be.
/// @param pattern  adds its strokes; size in (0, 1] makes all distances smaller
void fill(JointPath& path, double until,
          const std::function<void(JointPath& path, double size)>& pattern);

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/simulation/joint_spring.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dyngen::runtime {
namespace {

constexpr double kSmallestLoad = 1e-6, kLargestLoad = 1e9;  // N m or N
constexpr int kPlacesPerDecade = 40, kDecades = 15;
constexpr int kInverseIterations = 200;

}  // namespace

JointSpring::JointSpring(std::function<Twist(double load)> law, double floor)
    : law_(std::move(law)), floor_(floor), softness_(law_(0).slope) {
  if (!(floor > 0) || !(floor < softness_) || !std::isfinite(softness_)) {
    throw std::invalid_argument(
        fmt::format("JointSpring: the slope is {} without load and {} at least, expected positive "
                    "ones, the second below the first",
                    softness_, floor));
  }
  lowest_ = first_stiff_load(-1);
  highest_ = first_stiff_load(1);
  at_lowest_ = law_(lowest_).value;
  at_highest_ = law_(highest_).value;
}

/// Where the law's slope falls to the floor.
double JointSpring::first_stiff_load(double side) const {
  double soft = 0;
  for (int k = 0; k <= kPlacesPerDecade * kDecades; ++k) {
    double stiff = side * kSmallestLoad * std::pow(10.0, static_cast<double>(k) / kPlacesPerDecade);
    if (law_(stiff).slope >= floor_) {
      soft = stiff;
      continue;
    }
    for (int step = 0; step < 60; ++step) {
      const double middle = (soft + stiff) / 2;
      (law_(middle).slope >= floor_ ? soft : stiff) = middle;
    }
    return soft;
  }
  return side * kLargestLoad;
}

Twist JointSpring::twist(double load) const {
  if (load > highest_) return {at_highest_ + floor_ * (load - highest_), floor_};
  if (load < lowest_) return {at_lowest_ + floor_ * (load - lowest_), floor_};
  return law_(load);
}

double JointSpring::load(double twist) const {
  if (twist == 0) return 0;
  if (twist > at_highest_) return highest_ + (twist - at_highest_) / floor_;
  if (twist < at_lowest_) return lowest_ + (twist - at_lowest_) / floor_;
  double low = twist > 0 ? 0 : lowest_, high = twist > 0 ? highest_ : 0;
  double load = twist / softness_;
  for (int k = 0; k < kInverseIterations; ++k) {
    if (!(load >= low && load <= high)) load = (low + high) / 2;
    const Twist here = law_(load);
    const double error = here.value - twist;
    (error > 0 ? high : low) = load;
    load -= error / here.slope;
    if (std::abs(error) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(twist)) break;
  }
  return load;
}

}  // namespace dyngen::runtime

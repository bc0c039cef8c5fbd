// SPDX-License-Identifier: MIT
// Random numbers that are the same with every C++ library.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

namespace blind {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Of [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Evenly in the logarithm; both positive.
  double decade(double low, double high) { return low * std::pow(high / low, unit()); }
  /// 0 .. count - 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(unit() * static_cast<double>(count));
  }
  bool chance(double share) { return unit() < share; }
  double sign() { return chance(0.5) ? 1 : -1; }
  /// Of mean 0 and variance 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - unit()));
    return radius * std::cos(2 * 3.14159265358979323846 * unit());
  }
  /// A generator of its own for one part, so that parts do not shift one another.
  Random part(std::uint64_t number) {
    std::uint64_t z = engine_() + 0x9E3779B97F4A7C15ULL * (number + 1);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return Random(z ^ (z >> 31));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace blind

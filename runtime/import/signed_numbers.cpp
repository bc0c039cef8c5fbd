// SPDX-License-Identifier: MIT
#include "runtime/import/signed_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dyngen::runtime {
namespace {

constexpr std::array<int, 3> kBits = {8, 16, 32};  // of numbers on buses

}  // namespace

double signed_value(double value, int bits) {
  return bits > 0 && value >= std::ldexp(1.0, bits - 1) ? value - std::ldexp(1.0, bits) : value;
}

void UnsignedWatch::look(double value) {
  if (std::isnan(value) || !whole_) return;
  whole_ = value >= 0 && value == std::floor(value);
  largest_ = std::max(largest_, value);
  for (int i = 0; i < kRanges; ++i) {
    const double quarter = std::ldexp(1.0, kBits[static_cast<std::size_t>(i)] - 2);
    (value < quarter ? low_ : value < 3 * quarter ? between_ : high_)[i] = true;
  }
}

int UnsignedWatch::bits() const {
  for (int i = 0; whole_ && i < kRanges; ++i) {
    const int bits = kBits[static_cast<std::size_t>(i)];
    if (largest_ < std::ldexp(1.0, bits) && low_[i] && high_[i] && !between_[i]) return bits;
  }
  return 0;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/logs/number_conversion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace dyngen::runtime {
namespace {

/// The bits at `bytes`, in the order of this machine.
std::uint64_t stored_bits(const char* bytes, const StoredNumber& stored) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < stored.size; ++i) {
    const std::size_t from = stored.big_endian ? i : stored.size - 1 - i;
    bits = bits << 8 | static_cast<unsigned char>(bytes[from]);
  }
  return bits;
}

/// IEEE 754 binary16.
double half_value(std::uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 0x1F);
  const auto fraction = static_cast<double>(bits & 0x3FF);
  constexpr int kInfinite = 0x1F;
  const double magnitude = exponent == kInfinite
                               ? (fraction == 0 ? std::numeric_limits<double>::infinity()
                                                : std::numeric_limits<double>::quiet_NaN())
                           : exponent == 0 ? std::ldexp(fraction, -24)
                                           : std::ldexp(1024 + fraction, exponent - 25);
  return (bits >> 15 & 1U) != 0 ? -magnitude : magnitude;
}

std::int64_t with_sign(std::uint64_t bits, std::size_t size) {
  const auto shift = static_cast<int>(64 - 8 * size);
  return std::bit_cast<std::int64_t>(bits << shift) >> shift;
}

}  // namespace

std::optional<std::int64_t> stored_whole(const char* bytes, const StoredNumber& stored) {
  if (stored.kind == 'f') return std::nullopt;
  const std::uint64_t bits = stored_bits(bytes, stored);
  if (stored.kind == 'i') return with_sign(bits, stored.size);
  if (bits > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(bits);
}

double stored_value(const char* bytes, const StoredNumber& stored, std::int64_t origin) {
  const std::uint64_t bits = stored_bits(bytes, stored);
  if (stored.kind == 'f') {
    if (stored.size == 8) return std::bit_cast<double>(bits);
    if (stored.size == 4) {
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    }
    return half_value(bits);
  }
  const std::optional<std::int64_t> whole = stored_whole(bytes, stored);
  std::int64_t difference = 0;
  if (whole && !__builtin_sub_overflow(*whole, origin, &difference)) {
    return static_cast<double>(difference);
  }
  const double value = whole ? static_cast<double>(*whole) : static_cast<double>(bits);
  return value - static_cast<double>(origin);
}

std::optional<ColumnOrigin> origin_of_first(const char* bytes, const StoredNumber& stored) {
  const auto first = stored_whole(bytes, stored);
  if (!first || std::abs(static_cast<double>(*first)) <= std::ldexp(1.0, 53)) return std::nullopt;
  return ColumnOrigin{*first, 1};
}

}  // namespace dyngen::runtime

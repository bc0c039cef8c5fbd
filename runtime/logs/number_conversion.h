// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// How the numbers of an array are stored.
struct StoredNumber {
  char kind = 'f';       ///< f: float, i: signed, u: unsigned whole number (also truth values)
  std::size_t size = 8;  ///< bytes: f 2, 4, 8; i, u 1, 2, 4, 8
  bool big_endian = false;
};

/// The number at `bytes`. Whole numbers are counted from the origin, exactly.
/// @param origin  taken off; 0 for floats
double stored_value(const char* bytes, const StoredNumber& stored, std::int64_t origin);

/// The whole number at `bytes`; nothing for floats, and beyond 63 bits.
std::optional<std::int64_t> stored_whole(const char* bytes, const StoredNumber& stored);

/// What to take off an array of whole numbers that begins with this one: it, if no double has it
/// and its like.
std::optional<ColumnOrigin> origin_of_first(const char* bytes, const StoredNumber& stored);

}  // namespace dyngen::runtime

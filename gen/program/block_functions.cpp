// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/program/block_functions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gen/program/scalar_functions.h"

namespace dyngen::block {
namespace {

template <typename One>
inline void all_of(const double* x, double* result, std::size_t count, std::int64_t turn, One one) {
  bool near = true;
  for (std::size_t i = 0; i < count; ++i) near = near & (std::abs(x[i]) < scalar::kFarthest);
  if (!near) {
    std::transform(x, x + count, result, one);
    return;
  }
#pragma omp simd
  for (std::size_t i = 0; i < count; ++i) result[i] = scalar::turned_sine(x[i], turn);
}

}  // namespace

DYNGEN_WIDE void sines(const double* x, double* result, std::size_t count) {
  all_of(x, result, count, 0, scalar::sine);
}

DYNGEN_WIDE void cosines(const double* x, double* result, std::size_t count) {
  all_of(x, result, count, 1, scalar::cosine);
}

}  // namespace dyngen::block

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

/// Compiled for processors with AVX2 too, which the program looks for when it starts. Without fused
/// operations, so that both round alike.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DYNGEN_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define DYNGEN_WIDE
#endif

/// Functions of many values at once, without a branch for each of them.
namespace dyngen::block {

/// Those of scalar_functions.h, bit by bit. The result may stand where x does.
void sines(const double* x, double* result, std::size_t count);
void cosines(const double* x, double* result, std::size_t count);

}  // namespace dyngen::block

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>

#include "gen/passes/network.h"

namespace dyngen {

/// Names what occurs several times, up to sign and order: products of two nodes, and sums of two
/// terms, also times a common factor (a b + a c = a (b + c)). The one that saves most comes first;
/// longer products and sums come about step by step. Values stay; the operation count falls with
/// every step.
///
/// @param order  0: equal savings in the order of the program; else shuffled by this seed
///
/// Source: two-term divisors and two-literal cubes as in Rajski and Vasudevamurthi, "The
/// testability-preserving concurrent decomposition and factorization of Boolean expressions" (IEEE
/// Trans. CAD, 1992), after the kernels of Brayton and McMullen 1982; for polynomials Hosangadi,
/// Fallah and Kastner 2006.
void extract_divisors(Network& network, std::uint64_t order = 0);

}  // namespace dyngen

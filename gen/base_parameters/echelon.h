// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cln/real.h>

#include <cstddef>
#include <vector>

namespace dyngen {

/// Rows of numbers, all of one length.
using NumberMatrix = std::vector<std::vector<cln::cl_R>>;

/// What counts as rounding in sums of numbers of 60 digits of ordinary size: 1e-42.
const cln::cl_R& rounding_limit();

/// The reduced row echelon form: row i begins with a 1 at column pivots[i], where all others are 0.
struct Echelon {
  NumberMatrix rows;
  std::vector<std::size_t> pivots;

  [[nodiscard]] std::size_t rank() const { return rows.size(); }
};

/// The echelon form of the space that the rows span; the leftmost columns become pivots.
///
/// For numbers of 60 digits: what falls below 1e-42 of its row is taken as zero.
/// @param columns  length of the rows
Echelon echelon(NumberMatrix rows, std::size_t columns);

}  // namespace dyngen

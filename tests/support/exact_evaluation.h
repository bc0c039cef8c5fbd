// SPDX-License-Identifier: MIT
#pragma once

#include <cln/real.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "gen/trace/trace.h"

namespace dyngen::test {

/// Values of arrays by name and index: ("q", 2).
using ExactValues = std::map<std::pair<std::string, int>, cln::cl_R>;

/// Every output of a function in arithmetic of 60 digits, at random inputs.
///
/// @param seed   an input's value in +-3 depends on the seed, its array and its index alone: the
///               same for every function that reads it
/// @param given  values of inputs that are not random
/// @throws std::invalid_argument  if a statement reads what is not assigned yet
ExactValues exact_outputs(const Trace& trace, std::uint64_t seed, const ExactValues& given = {});

/// The largest difference of two functions' outputs, relative to the largest value of the array
/// that the output stands in; infinite if their outputs are not the same elements.
double exact_difference(const ExactValues& a, const ExactValues& b);

}  // namespace dyngen::test

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "gen/trace/trace.h"

namespace dyngen {

/// An element of an output array with the factor that it has in a sum.
struct WeightedOutput {
  std::string array;
  int index = 0;
  GiNaC::ex weight;  ///< an input, or a number
};

/// An input, and where the derivative by it goes.
struct DerivativeOutput {
  GiNaC::symbol input;
  std::string array;
  int index = 0;
};

/// The gradient of a weighted sum of a function's outputs, s = sum_i weight_i output_i, by reverse
/// accumulation over the function's own statements: exact, for a small multiple of its operations
/// however many inputs there are.
///
/// Statements are gone through backwards; each hands its own derivative ds/dv on to what it reads,
/// times the partial derivative of its value. sign() has the derivative 0.
///
/// @param function  its sin() and cos() stand alone in a statement, as Trace::sin_cos() writes them
/// @param weights   outputs that are not named have the weight 0
/// @param wanted    every output of the result, in this order; 0 where s does not depend on it
/// Source: Griewank and Walther, "Evaluating Derivatives" (2008), chapter 3.
Trace adjoint(const Trace& function, const std::vector<WeightedOutput>& weights,
              const std::vector<DerivativeOutput>& wanted);

}  // namespace dyngen

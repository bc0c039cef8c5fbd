// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/passes/search.h"
#include "gen/symbols/symbol_table.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Functions that read an array "folded" in place of "chi", and the function that computes it.
struct FoldedFunctions {
  std::vector<Trace> functions;    ///< in the order in which they were given
  Trace fold;                      ///< folded from chi, once per change of the parameters
  std::vector<std::string> names;  ///< of the entries of folded: "F_MX3", "F_ZZR3_minus_XXR3"
};

/// Takes all that depends on chi and numbers alone out of functions: sums and products of
/// parameters, the coefficients a and b of a x + b x together. What several functions need, and
/// what one needs up to sign, is one entry. A parameter that stands alone is copied.
///
/// No function needs more operations than before. The functions are best optimised() after.
///
/// @param functions  of one robot; their table of inputs is the next argument
/// @param inputs     gets the symbols of folded; must outlive the result
/// @param options    for the function fold itself
FoldedFunctions fold_parameters(const std::vector<Trace>& functions, SymbolTable& inputs,
                                const SearchOptions& options = {});

}  // namespace dyngen

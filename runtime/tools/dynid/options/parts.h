// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/tools/dynid/options/options.h"

namespace dyngen::runtime {

/// What dynid can be built or installed without.
enum class Part { kBlas, kBoost, kCeres, kExpat, kGnuplot, kJson, kMpi, kNlopt, kZlib };

struct PartWords {
  Part part;
  const char* name;     ///< of the library or program
  const char* package;  ///< of Debian
  const char* adds;     ///< what a dynid without it does not do
};

/// All parts, in the order of their names.
const std::vector<PartWords>& all_parts();

/// Tells whether a part is here.
using PresentParts = std::function<bool(Part)>;

/// Whether this dynid was built with a part; of gnuplot, whether it is in the path now.
bool has_part(Part part);

/// Which parts are here and which are not, a line each, for --version.
std::string parts_text(const PresentParts& has = has_part);

/// Why a call cannot be done: a line for each part that it needs and that is not here, with the
/// Debian package to install. Empty: all is here. Looks at options alone, never at files.
/// @param options    with the recordings of their list
/// @param processes  that mpirun started together
std::string missing_parts(const ToolOptions& options, int processes,
                          const PresentParts& has = has_part);

/// Stands for a function of a part that was left out: missing_parts() keeps calls away from it.
/// @throws std::logic_error
[[noreturn]] void call_absent(Part part);

}  // namespace dyngen::runtime

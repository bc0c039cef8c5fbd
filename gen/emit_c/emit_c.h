// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/functions/functions.h"

namespace dyngen {

enum class Scalar { kDouble, kFloat };

/// Where sines and cosines come from.
enum class Trig {
  kInline,  ///< all angles of a function at once, in the code itself
  kLibm     ///< sin() and cos() of the C library
};

/// How the C text is spelled.
struct EmitOptions {
  std::string prefix;  ///< a C identifier, in front of every external name
  Scalar scalar = Scalar::kDouble;
  Trig trig = Trig::kInline;
  std::string header_name;  ///< what the source includes
};

/// The files that make up a generated model.
struct CText {
  std::string header;
  std::string source;
  std::string wrapper{};  ///< see emit_cpp(); empty unless asked for
};

/// C99 that is also C++20: no allocation, no state, silent under the usual warnings.
///
/// @throws ModelError  if a number of the robot is too large for the arithmetic
///
/// The text depends on nothing but the arguments: the same input gives the same bytes.
CText emit_c(const CodeModel& code, const std::vector<RobotFunction>& functions,
             const EmitOptions& options);

}  // namespace dyngen

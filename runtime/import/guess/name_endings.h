// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/import/guess/column_words.h"

namespace dyngen::runtime {

/// A unit at the end of a name: "act_pos_deg", "TauNm", "qd_{n}_deg_per_s".
struct NameEnding {
  std::string ending;  ///< as a reason has it: "_deg"
  std::string unit;    ///< as a map has it: "deg/s"
};

/// @param name  of a column, or a pattern: marks and numbers at its end do not count
/// @param role  what its other words say that it is: the unit must be one of that. Nothing: angles,
///              lengths, their rates and torques alone, since "%" may be of anything
std::optional<NameEnding> unit_ending(std::string_view name, std::optional<ColumnRole> role);

}  // namespace dyngen::runtime

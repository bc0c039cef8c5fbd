// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runtime/logs/json_table.h"

namespace dyngen::runtime {

/// The path of what an array is part of, and its name.
using JsonArrayName = std::pair<std::string, std::string>;
using JsonArrays = std::map<JsonArrayName, JsonTable>;

/// Turns lists that are channels, each with all samples of one ("2 x N"), into lists that are
/// samples ("N x 2"). Which they are, the length of the time beside them says: that of a list of
/// numbers named like a time, or of the lists of numbers if all are of one length, in the same
/// object or in one that it is part of. Without such a list samples are along the longer side.
/// @param other_samples  the document has samples that are objects: matrices may be of the setup
/// @param file  for messages  @return  names of those that were turned
/// @throws LogError  both sides are as long as the time, or as each other where there is none
std::vector<std::string> turn_channels(JsonArrays& arrays, bool other_samples,
                                       const std::string& file);

}  // namespace dyngen::runtime

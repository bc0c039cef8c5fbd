// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/tools/dynid/options/options.h"

namespace dyngen::runtime {

/// Whether a call would write over one of its own inputs, by whatever name, or write two results to
/// one file: a sentence that names both. Empty: it would not. merge may replace what it merges.
/// @param options  with the recordings of their list
std::string output_collision(const ToolOptions& options);

}  // namespace dyngen::runtime

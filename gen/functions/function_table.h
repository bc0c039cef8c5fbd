// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "gen/functions/catalogue.h"

namespace dyngen {

/// What function_catalogue() holds: name, inputs, outputs and meaning of every function.
std::vector<FunctionSpec> function_table();

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <set>
#include <string>

#include "gen/emit_c/emit_c.h"

namespace dyngen {

/// The type <prefix>_pack, as many doubles as one register holds (GNU C vectors: 2, 4 or 8; one
/// number with other compilers and on other processors), and how one of them is reached.
std::string pack_helper(const EmitOptions& options);

/// The type <prefix>_lanes, one number of each of <PREFIX>_LANES samples, and what the batch
/// functions do with it: load, store, and the copies that fill up the last samples. Needs
/// pack_helper().
/// @param calls  names of the calls of lanes that are needed too ("sign_lanes", "exp_lanes"), and
///               "spread", which makes lanes of one number; others are left out
std::string lanes_helper(const EmitOptions& options, const std::set<std::string>& calls);

}  // namespace dyngen

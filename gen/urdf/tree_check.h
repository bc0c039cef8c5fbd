// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/bodies/body_tree.h"
#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// Reports links with two parents, loops, and links that do not hang together.
void check_is_tree(const BodyTree& tree, Diagnostics& diagnostics);

}  // namespace dyngen

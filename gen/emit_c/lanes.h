// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace dyngen {

/// The type <prefix>_doubles, as many doubles as one register holds (GNU C vectors: 2, 4 or 8; one
/// double with other compilers and on other processors), and how one of them is reached.
std::string doubles_helper(const std::string& prefix);

}  // namespace dyngen

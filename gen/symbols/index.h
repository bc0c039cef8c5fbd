// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace dyngen {

/// The number of a link, a joint or a node as the index of a container.
constexpr std::size_t at(int number) { return static_cast<std::size_t>(number); }

}  // namespace dyngen

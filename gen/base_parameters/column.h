// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <compare>

#include "gen/model/chi.h"

namespace dyngen {

/// A column of the regressor: one standard parameter of one link.
struct Column {
  int link = 0;
  Chi kind = Chi::kZZ;

  auto operator<=>(const Column&) const = default;
};

}  // namespace dyngen

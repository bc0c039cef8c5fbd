// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/base_parameters/base_parameters.h"

namespace dyngen {

/// What recordings can tell of the standard parameters.
struct Visibility {
  struct InSums {
    std::string name;
    std::vector<std::string> base;  ///< the base parameters that contain it
  };
  struct Hidden {
    std::vector<std::string> names;
    std::string reason;
  };
  std::vector<std::string> alone;  ///< identifiable by themselves
  std::vector<InSums> in_sums;     ///< only in the sum of a base parameter
  std::vector<Hidden> hidden;      ///< no motion shows them
};

/// @param base  of regroup(robot)
Visibility visibility(const SymbolicRobot& robot, const Regrouping& base);

}  // namespace dyngen

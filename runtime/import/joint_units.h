// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/import/column_lookup.h"
#include "runtime/import/import_map.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {

/// Units of a signal that a joint cannot have are errors: lengths and forces of a joint that turns,
/// angles and torques of one that slides. What is measured at a motor is not asked: a spindle turns
/// where its joint slides.
/// @param kinds    of each joint; empty: not known
/// @param columns  of each joint; empty: only offsets are looked at
/// @throws ImportError  at the unit in the map, or at the signal if the log has it
void check_joint_units(const ImportMap& map, const SignalMap& signal, ColumnQuantity quantity,
                       const std::vector<MotionKind>& kinds,
                       const std::vector<ColumnPlace>& columns);

}  // namespace dyngen::runtime

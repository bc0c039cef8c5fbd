// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/import/map_nodes.h"
#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// Keys of read_text_settings().
inline constexpr std::initializer_list<const char*> kTextFormatKeys = {"separator", "decimal",
                                                                       "skip", "columns"};

/// How a text is written: what is between columns, the decimal sign, lines to skip, names of the
/// columns ("q{1..7}" stands for q1 to q7).
LogTextSettings read_text_settings(const MapEntries& entries, MapFaults& faults);

}  // namespace dyngen::runtime

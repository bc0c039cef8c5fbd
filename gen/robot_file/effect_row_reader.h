// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>

#include "gen/robot_file/robot_file.h"
#include "gen/robot_file/row_words.h"

namespace dyngen {

/// Row `effect NAME key=value ...`; absent if it has no name, which is reported.
std::optional<EffectRow> read_effect_row(RowWords& words, const Word& keyword);

}  // namespace dyngen

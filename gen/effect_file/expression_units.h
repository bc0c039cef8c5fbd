// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gen/effect_file/effect_expression.h"
#include "gen/effect_file/units.h"

namespace dyngen {

/// The dimension of a name; none if it has none that is known.
using DimensionOfName = std::function<std::optional<Dimension>(const std::string& name)>;

/// The dimension of an expression. What does not fit together is reported at its place.
/// @return none where it is not known, or a message says what is wrong
std::optional<Dimension> dimension_of(const EffectExpression& expression,
                                      const DimensionOfName& dimension_of_name,
                                      Diagnostics& diagnostics);

/// Whether it holds numbers and pi alone: such a value is taken to have the unit that is wanted.
bool is_plain_number(const EffectExpression& expression);

}  // namespace dyngen

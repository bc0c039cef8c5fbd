// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace dyngen {

/// A decimal number with blanks around it at most, whatever the locale: sign, digits, point,
/// exponent. None for anything else: hexadecimal digits, "nan", "inf", a comma, numbers that no
/// double holds.
std::optional<long double> read_decimal(std::string_view text);

}  // namespace dyngen

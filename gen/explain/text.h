// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dyngen {

/// The words of a text on lines of at most 100 columns. @param first  what the first line begins
/// with; the others begin with as many blanks as `indent`
std::string fill_lines(std::string_view first, std::string_view text, std::size_t indent);

/// "XX1, XY1, XZ1"
std::string list_names(const std::vector<std::string>& names);

}  // namespace dyngen

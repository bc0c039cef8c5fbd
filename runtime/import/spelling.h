// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dyngen::runtime {

/// The word that was probably meant: at most a third of its letters are other ones (Levenshtein
/// distance, upper and lower case alike); empty: none is near.
std::string likely_word(std::string_view word, const std::vector<std::string>& words);

/// "'a', 'b' and 3 more" of many.
std::string listed(const std::vector<std::string>& words, std::size_t most = 12);

}  // namespace dyngen::runtime

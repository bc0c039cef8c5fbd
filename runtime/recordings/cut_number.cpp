// SPDX-License-Identifier: MIT
#include "runtime/recordings/cut_number.h"

#include <algorithm>

namespace dyngen::runtime {
namespace {

constexpr std::size_t kRowsOfOneForm = 20;   // p^20 (1 - p) < 2 %
constexpr std::size_t kRowsOfAnyForm = 100;  // 1 / 101 < 1 %

struct Digits {
  std::size_t all = 0, decimals = 0;
};

/// All digits count, those of an exponent too; decimals stand behind the last point or comma.
Digits digits_of(std::string_view word) {
  Digits digits;
  bool behind = false;
  for (const char c : word) {
    if (c >= '0' && c <= '9') {
      ++digits.all;
      if (behind) ++digits.decimals;
    } else if (c == '.' || c == ',') {
      behind = true;
      digits.decimals = 0;
    } else if (c == 'e' || c == 'E') {
      behind = false;
    }
  }
  return digits;
}

}  // namespace

void CutNumber::add(std::string_view word) {
  const Digits digits = digits_of(word);
  if (digits.all == 0) return;  // nan, or nothing
  ++rows_;
  fewest_digits_ = std::min(fewest_digits_, digits.all);
  fewest_decimals_ = std::min(fewest_decimals_, digits.decimals);
  most_decimals_ = std::max(most_decimals_, digits.decimals);
}

bool CutNumber::is_cut(std::string_view word) const {
  const Digits digits = digits_of(word);
  if (digits.all == 0) return false;
  const bool one_form = fewest_decimals_ == most_decimals_ && digits.decimals < fewest_decimals_;
  return (one_form && rows_ >= kRowsOfOneForm) ||
         (rows_ >= kRowsOfAnyForm && digits.all < fewest_digits_);
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace dyngen::runtime {

/// Whether the number at the very end of a file is cut off, by the numbers that stood at the ends
/// of the rows before.
///
/// It is if 20 rows and more have as many decimals each, and it has fewer: where a share p of the
/// numbers has so many decimals, that happens by chance with p^20 (1 - p), which is below 2 % for
/// every p. It is also if it has fewer digits than any of 100 rows and more: of rows alike, the
/// last one is the shortest by chance in less than 1 % of the files.
class CutNumber {
 public:
  /// A number at the end of a row.
  void add(std::string_view word);
  [[nodiscard]] bool is_cut(std::string_view word) const;

 private:
  std::size_t rows_ = 0;
  std::size_t fewest_digits_ = std::numeric_limits<std::size_t>::max();
  std::size_t fewest_decimals_ = std::numeric_limits<std::size_t>::max();
  std::size_t most_decimals_ = 0;
};

}  // namespace dyngen::runtime

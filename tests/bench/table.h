// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dyngen::bench {

/// Rows of text under a header, for a terminal or for docs/reference/benchmarks.md.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header

  /// First column to the left, the others to the right.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string markdown() const;
};

}  // namespace dyngen::bench

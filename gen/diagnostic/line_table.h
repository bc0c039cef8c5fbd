// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen {

/// Lines and columns of a text's bytes.
class LineTable {
 public:
  LineTable() = default;
  explicit LineTable(std::string_view text);

  /// The place of byte `offset`; the end of the text for offsets beyond it.
  /// @param text  the one that the table was made of
  [[nodiscard]] SourcePosition position_of(std::string_view text, std::size_t offset) const;

 private:
  std::vector<std::size_t> line_begins_ = {0};
};

}  // namespace dyngen

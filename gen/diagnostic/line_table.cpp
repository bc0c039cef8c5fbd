// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/diagnostic/line_table.h"

#include <algorithm>

#include "gen/diagnostic/utf8.h"

namespace dyngen {

LineTable::LineTable(std::string_view text) {
  for (std::size_t i = text.find('\n'); i != text.npos; i = text.find('\n', i + 1)) {
    line_begins_.push_back(i + 1);
  }
}

SourcePosition LineTable::position_of(std::string_view text, std::size_t offset) const {
  offset = std::min(offset, text.size());
  const auto next = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
  const std::size_t begin = *(next - 1);
  return {static_cast<int>(next - line_begins_.begin()),
          1 + character_count(text.substr(begin, offset - begin))};
}

}  // namespace dyngen

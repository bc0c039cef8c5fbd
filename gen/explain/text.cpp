// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/text.h"

#include <sstream>

namespace dyngen {

std::string fill_lines(std::string_view first, std::string_view text, std::size_t indent) {
  constexpr std::size_t kColumns = 80;
  std::istringstream words{std::string(text)};
  std::string result;
  std::string line(first);
  bool empty = true;
  for (std::string word; words >> word;) {
    if (!empty && line.size() + 1 + word.size() > kColumns) {
      result += line + "\n";
      line = std::string(indent, ' ');
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return result + line + "\n";
}

std::string list_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace dyngen

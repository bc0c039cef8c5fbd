// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/xml/attribute_ranges.h"

namespace dyngen {

std::vector<AttributeRange> attribute_ranges(std::string_view tag, std::size_t offset) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<AttributeRange> ranges;
  std::size_t at = tag.find_first_of(" \t\r\n/>");  // behind the element's name
  while (at < tag.size()) {
    const std::size_t name = tag.find_first_not_of(kBlanks, at);
    if (name == tag.npos || tag[name] == '/' || tag[name] == '>') break;
    const std::size_t name_end = tag.find_first_of(" \t\r\n=", name);
    const std::size_t quote = tag.find_first_of("\"'", name);
    if (name_end == tag.npos || quote == tag.npos) break;
    const std::size_t end = tag.find(tag[quote], quote + 1);
    if (end == tag.npos) break;
    ranges.push_back({{offset + name, offset + name_end}, {offset + quote + 1, offset + end}});
    at = end + 1;
  }
  return ranges;
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/xml/known_attributes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gen/diagnostic/diagnostic.h"
#include "gen/words/spelling.h"

namespace dyngen {

void warn_of_unknown_attributes(const XmlElement& element, std::span<const std::string_view> known,
                                std::string_view form, XmlValues& values) {
  for (const XmlAttribute& attribute : element.attributes) {
    const std::string_view name = attribute.name;
    if (name.find(':') != name.npos || name == "xmlns") continue;
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string_view near = nearest_word(name, known);
    values.warning(attribute,
                   fmt::format("'{}' is no attribute of <{}> in {}: it is passed over",
                               printable(attribute.name), element.name, form),
                   near.empty() ? fmt::format("it has {}", fmt::join(known, ", "))
                                : fmt::format("did you mean '{}'?", near));
  }
}

}  // namespace dyngen

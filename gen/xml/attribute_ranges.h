// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "gen/xml/xml_document.h"

namespace dyngen {

/// Where an attribute stands in its start tag.
struct AttributeRange {
  ByteRange name;
  ByteRange value;  ///< between the quotes
};

/// The attributes of a start tag, in its order.
/// @param tag     of well-formed XML: "<name a='1' b="2"/>"
/// @param offset  of the tag's first byte, which the ranges count from
std::vector<AttributeRange> attribute_ranges(std::string_view tag, std::size_t offset);

}  // namespace dyngen

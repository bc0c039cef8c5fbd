// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "gen/xml/xml_values.h"

namespace dyngen {

/// Warns of attributes that an element of a form does not have: what they say is passed over.
/// Attributes of other namespaces (with a ':') and xmlns are nobody's business.
/// @param form  "URDF", "MJCF"
void warn_of_unknown_attributes(const XmlElement& element, std::span<const std::string_view> known,
                                std::string_view form, XmlValues& values);

}  // namespace dyngen

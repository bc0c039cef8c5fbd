// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/xml/xml_values.h"

namespace dyngen {

/// Reports words that MJCF does not have in what carries dynamics (compiler, option, default,
/// worldbody): unknown attributes and elements as warnings, words that are no truth value, and what
/// MuJoCo refuses to see together, as errors.
void check_mjcf_words(const XmlElement& root, XmlValues& values);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/xml/xml_values.h"

namespace dyngen {

/// Warns of attributes of links and joints that URDF does not have. Those of <dynamics> and of
/// what has no dynamics are left to others.
void check_urdf_attributes(const XmlElement& robot, XmlValues& values);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/bodies/geometry.h"

namespace dyngen {

/// The shortest decimal within 1e-14 of the number's size + 1e-15: 0.333 stays 0.333 whatever
/// products rounded. Whatever the locale; "0" for 0.
std::string decimal(Real value);

/// An angle of a robot file: "0", "pi/2", "-5*pi/12" for multiples of pi/12 (within kSameAngle),
/// else its decimal. @param angle  rad
std::string angle_text(Real angle);

/// The shortest decimal that reads back as the double nearest to the number.
std::string exact_decimal(Real value);

}  // namespace dyngen

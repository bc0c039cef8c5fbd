// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dyngen {

/// Exponents of kg, m, s and K; rad is 1.
using Dimension = std::array<double, 4>;

/// What the words position, rate, acceleration and torque mean: rad and N m, or m and N.
enum class JointUnits { kRevolute, kPrismatic };

/// Reads a unit: words N m s kg K rad W J Hz 1 and position rate acceleration torque, joined by
/// '.' or '/' (each '/' divides by the next word alone), with whole powers: torque.s/rad,
/// kg.m^2.
/// @return none if it is no unit
std::optional<Dimension> dimension_of(std::string_view unit, JointUnits joint);

/// "N m s/rad": how people write it, for a joint of this kind.
std::string unit_text(std::string_view unit, JointUnits joint);

/// "kg m^2 s^-2", for messages.
std::string dimension_text(const Dimension& dimension);

Dimension operator+(const Dimension& a, const Dimension& b);
Dimension operator-(const Dimension& a, const Dimension& b);
Dimension operator*(const Dimension& a, double power);

}  // namespace dyngen

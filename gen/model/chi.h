// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace dyngen {

/// The standard parameters of a link, in the order of chi.
///
/// XX..ZZ are the elements of the inertia tensor about the origin of the link's frame
/// (XY = -integral x y dm), MX MY MZ the first moments, M the mass, IA the rotor inertia seen at
/// the joint, FV and FS viscous and Coulomb friction, OFF a constant torque.
enum class Chi { kXX, kXY, kXZ, kYY, kYZ, kZZ, kMX, kMY, kMZ, kM, kIA, kFV, kFS, kOFF };

inline constexpr std::size_t kChiCount = 14;
inline constexpr std::size_t kInertialCount = 10;  ///< XX .. M come first

inline constexpr std::size_t index(Chi kind) { return static_cast<std::size_t>(kind); }

inline constexpr std::array<std::string_view, kChiCount> kChiNames = {
    "XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M", "IA", "FV", "FS", "OFF"};

/// Unit of a parameter of a link that a revolute (else: a prismatic) joint moves.
inline std::string_view chi_unit(Chi kind, bool revolute) {
  switch (kind) {
    case Chi::kMX:
    case Chi::kMY:
    case Chi::kMZ:
      return "kg m";
    case Chi::kM:
      return "kg";
    case Chi::kIA:
      return revolute ? "kg m^2" : "kg";
    case Chi::kFV:
      return revolute ? "N m s/rad" : "N s/m";
    case Chi::kFS:
    case Chi::kOFF:
      return revolute ? "N m" : "N";
    default:
      return "kg m^2";
  }
}

/// "ZZ2", or "ZZR2" for a parameter that others are grouped into.
inline std::string chi_name(Chi kind, int link, bool grouped = false) {
  return std::string(kChiNames[index(kind)]) + (grouped ? "R" : "") + std::to_string(link);
}

}  // namespace dyngen

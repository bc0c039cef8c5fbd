// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

/// Places in chi, the order of gen/model/chi.h (which the runtime cannot include: another licence).
namespace dyngen::runtime {

inline constexpr int kChiPerLink = 14;
inline constexpr int kTenCount = 10;  ///< XX XY XZ YY YZ ZZ MX MY MZ M
inline constexpr int kRotorInertiaPlace = 10;
inline constexpr int kOffsetPlace = 13;
inline constexpr std::array<std::string_view, 4> kActuatorNames = {"IA", "FV", "FS", "OFF"};

/// Whether a place IA..OFF of a link must not be negative: all but OFF.
inline constexpr bool is_nonnegative(int kind) { return kind != kOffsetPlace; }

}  // namespace dyngen::runtime

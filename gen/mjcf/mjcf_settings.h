// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/mjcf/mjcf_pose.h"

namespace dyngen {

/// Where a body's inertia comes from.
enum class InertiaSource { kInertialElseGeoms, kGeoms, kInertial };

/// What <compiler> and <option> say of the whole model.
struct MjcfSettings {
  MjcfAngles angles;
  InertiaSource inertia = InertiaSource::kInertialElseGeoms;
  int first_group = 0, last_group = 5;  ///< of geoms whose inertia counts
  bool limits_by_range = true;          ///< a range alone makes a limit
  bool balance_inertia = false;         ///< moments that no body has become their mean
  Real least_mass = 0;                  ///< kg, of bodies
  Real least_moment = 0;                ///< kg m^2, of principal moments
  Real total_mass = -1;                 ///< kg, that all masses are scaled to; negative: none
  Vector3 gravity{{0, 0, -9.81L}};
  TextPlace gravity_place{};
};

/// Reads them, later elements over earlier ones; reports what is not supported.
MjcfSettings read_mjcf_settings(const XmlElement& root, const ReadingOptions& options,
                                XmlValues& values);

}  // namespace dyngen

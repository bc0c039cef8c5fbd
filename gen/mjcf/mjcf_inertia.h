// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/mjcf/mjcf_contents.h"
#include "gen/mjcf/mjcf_defaults.h"
#include "gen/mjcf/mjcf_settings.h"

namespace dyngen {

/// Gives a body its mass, centre of mass and inertia: of its inertial or of its geoms, as the
/// settings say, within the bounds that <compiler> sets.
void read_mjcf_inertia(const MjcfContents& contents, const MjcfSettings& settings,
                       const MjcfDefaults& defaults, XmlValues& values, TreeBody& body);

/// Scales masses and moments of all bodies to the total mass that <compiler> asks for.
void set_total_mass(const MjcfSettings& settings, BodyTree& tree);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Why centre of mass and momentum cannot be written; empty if they can: see CodeBodies.
std::string why_no_centroid(const CodeModel& code);

/// Writes the centre of mass of all links in frame 0 (m) as the output "p", 3, and their mass (kg)
/// as the output "mass". Bodies are composed from the tips to the base.
void write_center_of_mass(Trace& trace, const CodeModel& code);

/// Writes the Jacobian of the centre of mass as the output "J", 3 x n, row-major: its velocity in
/// the axes of frame 0 is J dq.
///
/// With h the first moment, about a point of the axis z of joint j, of the links that the joint
/// carries, m their mass and M that of all links, column j is z x h / M (revolute) or m z / M
/// (prismatic): the derivative of the first moment of all links by q_j.
void write_center_of_mass_jacobian(Trace& trace, const CodeModel& code);

/// Writes the momentum of all links as the output "h", 6: linear (kg m/s), then angular about the
/// origin of frame 0 (kg m^2/s), in the axes of frame 0. Rotors move with their links; their own
/// spin is left out.
///
/// It is the sum over the joints of what the composite body of each has by the joint's rate.
void write_momentum(Trace& trace, const CodeModel& code);

}  // namespace dyngen

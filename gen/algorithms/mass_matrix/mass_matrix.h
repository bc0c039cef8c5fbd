// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Elements of a symmetric matrix over the coordinates: [i][j] with i <= j.
using UpperTriangle = std::vector<std::vector<GiNaC::ex>>;

/// Writes the elements of the mass matrix, rotor inertia included, by composite bodies: the
/// shortest of the ways that were tried (see CompositeChoices).
UpperTriangle write_mass_elements(Trace& trace, const CodeModel& code,
                                  const std::vector<LinkFrame>& frames);

/// Writes an output array: n x n, row-major, both triangles (kg m^2; kg m and kg where joints are
/// prismatic).
void write_mass_matrix(Trace& trace, const CodeModel& code, const std::string& array);

}  // namespace dyngen

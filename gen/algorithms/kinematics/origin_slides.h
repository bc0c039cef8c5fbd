// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// For every link the distance (m) from its origin down its joint's axis to the point that stands
/// for the origin; element 0 is the base. A link's motion about such a point may be much simpler:
/// with d = 0 it is the parent's origin.
using OriginSlides = std::vector<GiNaC::ex>;

/// P between the points that stand for the origins.
void slide_origins(Trace& trace, const CodeModel& code, const OriginSlides& slides,
                   std::vector<LinkFrame>& frames);

/// The links whose parameters about another point are simple: MZ and M are not among the columns.
std::vector<bool> links_that_may_slide(const CodeModel& code, const std::vector<Column>& columns);

/// Chooses, from the base to the tips, which links slide, by what each choice costs.
///
/// A slide goes to the foot of the common normal with the parent's axis, along parallel axes to
/// the foot of their first one.
/// @param may_slide  of each link; element 0 is the base
/// @param count      operations with these slides
OriginSlides choose_slides(const CodeModel& code, const std::vector<bool>& may_slide,
                           const std::function<int(const OriginSlides&)>& count);

}  // namespace dyngen

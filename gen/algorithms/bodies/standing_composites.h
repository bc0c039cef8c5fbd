// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "gen/algorithms/bodies/link_inertia.h"
#include "gen/algorithms/bodies/moving_body.h"
#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Bodies of several links, at rest: K, h and m of a MovingBody.
struct StandingComposites {
  /// Of link j and the links that it carries, about the origin of frame j, in the axis frame of
  /// joint j: the axes of the anchor turned by alpha, whose z is the joint's. Element 0 is empty.
  std::vector<MovingBody> in_axis;
  MovingBody robot;  ///< all links, about the origin of frame 0, in its axes
};

/// Writes the composite bodies from the tips to the base.
/// @param inertia  of each link in its own frame; element 0 is the base's, and empty
StandingComposites write_standing_composites(Trace& trace, const CodeModel& code,
                                             const std::vector<LinkFrame>& frames,
                                             const std::vector<LinkInertia>& inertia);

/// The origin of link j seen from its parent's, in the axes in which write_standing_composites()
/// arrives there: the axis frame of the parent if the joints are parallel, else its link frame.
Vector3 write_step_to_parent(Trace& trace, const CodeModel& code,
                             const std::vector<LinkFrame>& frames, int link);

}  // namespace dyngen

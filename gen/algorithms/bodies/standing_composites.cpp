// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/bodies/standing_composites.h"

#include <fmt/format.h>

#include "gen/symbols/index.h"

namespace dyngen {

Vector3 write_step_to_parent(Trace& trace, const CodeModel& code,
                             const std::vector<LinkFrame>& frames, int link) {
  const LinkFrame& frame = frames[at(link)];
  if (!frame.parallel) return frame.P;
  const LinkFrame& parent = frames[at(code.link(link).parent)];
  return assign_vector(trace, "AP", link, turn(parent.from_anchor, frame.P));
}

StandingComposites write_standing_composites(Trace& trace, const CodeModel& code,
                                             const std::vector<LinkFrame>& frames,
                                             const std::vector<LinkInertia>& inertia) {
  StandingComposites result;
  result.in_axis.resize(frames.size());
  std::vector<MovingBody> in_link(frames.size());
  for (int j = code.size(); j >= 1; --j) {
    trace.section(fmt::format("link {} with the links it carries", j));
    const LinkFrame& frame = frames[at(j)];
    add(in_link[at(j)], write_standing_body(trace, {"L", j}, inertia[at(j)]));
    MovingBody& own = result.in_axis[at(j)];
    add(own, turned_about_z(trace, {"B", j}, frame.from_anchor,
                            assigned(trace, {"L", j}, in_link[at(j)])));
    own = assigned(trace, {"A", j}, own);

    const int parent = code.link(j).parent;
    const MovingBody body = turned_about_x(trace, {"X", j}, without_turn(frame.rotation), own);
    const PointStep step = {write_step_to_parent(trace, code, frames, j), {0, 0, 0}};
    add((frame.parallel ? result.in_axis : in_link)[at(parent)], moved(step, body));
  }
  result.robot = assigned(trace, {"R", 0}, in_link[0]);
  return result;
}

}  // namespace dyngen

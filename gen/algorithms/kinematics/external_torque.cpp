// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/external_torque.h"

#include <fmt/format.h>

#include <vector>

#include "gen/algorithms/kinematics/axes.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// The force and moment of the wrench in the axes of a frame.
struct TurnedWrench {
  Vector3 force, moment;
};

ex component(const Vector3& axis, const Vector3& v) {
  return axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
}

}  // namespace

void write_external_torque(Trace& trace, const CodeModel& code, int link) {
  const std::vector<LinkFrame> frames = write_frames(trace, code);
  const std::vector<int> path = path_to(code, link);
  trace.section("from the joints to the wrench's point");
  const std::vector<Vector3> levers =
      write_levers(trace, "L", frames, path, {code.link(link).tip_d, 0, 0});
  std::vector<TurnedWrench> turned(frames.size());
  const auto& w = code.load;
  turned[0] = {{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  std::vector<ex> torque(code.coordinate_names.size(), 0);
  for (const int j : path) {
    trace.section(fmt::format("force F and moment N in frame {}, torque of its joint", j));
    const LinkFrame& frame = frames[at(j)];
    const TurnedWrench& anchor = turned[at(frame.anchor)];
    const CodeLink& own = code.link(j);
    if (own.coordinate >= 0) {
      const Vector3 z = {0, -frame.from_anchor.sin_alpha, frame.from_anchor.cos_alpha};
      if (own.type == JointType::kPrismatic) {
        torque[at(own.coordinate)] = component(z, anchor.force);
      } else {
        Vector3 moment = cross(levers[at(j)], anchor.force);
        for (std::size_t k = 0; k < 3; ++k) moment[k] += anchor.moment[k];
        torque[at(own.coordinate)] = component(z, moment);
      }
    }
    turned[at(j)].force = assign_vector(
        trace, "F", j, to_child(trace, fmt::format("FA_{}", j), frame.from_anchor, anchor.force));
    turned[at(j)].moment = assign_vector(
        trace, "N", j, to_child(trace, fmt::format("NA_{}", j), frame.from_anchor, anchor.moment));
  }
  trace.section("joint torques");
  for (std::size_t k = 0; k < torque.size(); ++k) {
    trace.output("tau", static_cast<int>(k), torque[k]);
  }
}

}  // namespace dyngen

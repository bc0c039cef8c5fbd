// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/pose.h"

#include <fmt/format.h>

#include <vector>

#include "gen/algorithms/kinematics/axes.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/symbols/exact.h"
#include "gen/symbols/index.h"
#include "gen/trace/cheapest.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Origin of the file's frame of the path's last link. @param turn  place in the path where the way
/// along the axes begins
Vector3 write_origin(Trace& trace, const CodeModel& code, const std::vector<LinkFrame>& frames,
                     const std::vector<int>& path, const std::vector<Axes>& axes, int turn) {
  const int tip = path.back();
  trace.section(fmt::format("origin of frame {} in frame 0", tip));
  const std::vector<int> inner(path.begin(), path.begin() + turn);
  const bool all = inner.size() == path.size();
  const Vector3 beyond = {code.link(tip).tip_d, 0, 0};
  Vector3 p = write_levers(trace, "L", frames, inner, all ? beyond : Vector3{0, 0, 0})[0];
  if (all) return p;
  for (auto it = path.begin() + turn; it != path.end(); ++it) {
    const Vector3 offset = offset_in_base(trace, code, axes, *it);
    for (std::size_t k = 0; k < 3; ++k) p[k] += offset[k];
    p = assign_vector(trace, "p", *it, p);
  }
  const Vector3 last = in_base(axes[at(tip)], beyond);
  for (std::size_t k = 0; k < 3; ++k) p[k] += last[k];
  return p;
}

void write_elements(Trace& trace, const CodeModel& code, const std::vector<LinkFrame>& frames,
                    const std::vector<int>& path, int turn) {
  const std::vector<Axes> axes = write_axes(trace, frames, path);
  const Vector3 p = write_origin(trace, code, frames, path, axes, turn);
  const Axes& own = axes[at(path.back())];
  const CodeLink& link = code.link(path.back());
  const ex s = trace.constant("SAt", exact_sin(link.tip_alpha));
  const ex c = trace.constant("CAt", exact_cos(link.tip_alpha));
  trace.section("pose");
  for (std::size_t k = 0; k < 3; ++k) {
    const int row = 4 * static_cast<int>(k);
    trace.output("T", row, own.x[k]);
    trace.output("T", row + 1, c * own.y[k] + s * own.z[k]);
    trace.output("T", row + 2, c * own.z[k] - s * own.y[k]);
    trace.output("T", row + 3, p[k]);
  }
  for (int k = 12; k < 15; ++k) trace.output("T", k, 0);
  trace.output("T", 15, 1);
}

}  // namespace

void write_pose(Trace& trace, const CodeModel& code, int link) {
  const std::vector<LinkFrame> frames = write_frames(trace, code);
  const std::vector<int> path = path_to(code, link);
  const auto write = [&](Trace& target, int turn) {
    write_elements(target, code, frames, path, turn);
  };
  write(trace, cheapest_way(trace, static_cast<int>(path.size()) + 1, write));
}

}  // namespace dyngen

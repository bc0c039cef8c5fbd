// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/jacobian.h"

#include <fmt/format.h>

#include <vector>

#include "gen/algorithms/kinematics/axes.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/symbols/index.h"
#include "gen/trace/cheapest.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Velocity of the tip per joint rate, of the revolute joints from place `turn` of the path on, in
/// frame 0.
void write_in_base(Trace& trace, const CodeModel& code, const std::vector<int>& path,
                   const std::vector<Axes>& axes, std::size_t turn, std::vector<Vector3>& columns) {
  const int tip = path.back();
  Vector3 lever = in_base(axes[at(tip)], {code.link(tip).tip_d, 0, 0});
  for (std::size_t i = path.size(); i-- > turn;) {
    const int j = path[i];
    lever = assign_vector(trace, "r", j, lever);
    columns[at(j)] = assign_vector(trace, "v", j, cross(axes[at(j)].z, lever));
    const Vector3 offset = offset_in_base(trace, code, axes, j);
    for (std::size_t k = 0; k < 3; ++k) lever[k] += offset[k];
  }
}

/// The same of the joints before it, in the axes of their anchors.
void write_in_anchors(Trace& trace, const CodeModel& code, const std::vector<LinkFrame>& frames,
                      const std::vector<int>& path, const std::vector<Axes>& axes, std::size_t turn,
                      std::vector<Vector3>& columns) {
  const std::vector<Vector3> levers =
      write_levers(trace, "L", frames, path, {code.link(path.back()).tip_d, 0, 0});
  for (std::size_t i = 0; i < turn; ++i) {
    const int j = path[i];
    const LinkFrame& frame = frames[at(j)];
    const Vector3 z = {0, -frame.from_anchor.sin_alpha, frame.from_anchor.cos_alpha};
    const Vector3 turned = assign_vector(trace, "vA", j, cross(z, levers[at(j)]));
    columns[at(j)] = assign_vector(trace, "v", j, in_base(axes[at(frame.anchor)], turned));
  }
}

void write_columns(Trace& trace, const CodeModel& code, const std::vector<LinkFrame>& frames,
                   const std::vector<int>& path, std::size_t turn) {
  const std::vector<Axes> axes = write_axes(trace, frames, path);
  trace.section(fmt::format("v: velocity of the origin of frame {} per joint rate", path.back()));
  std::vector<Vector3> columns(frames.size(), Vector3{0, 0, 0});
  write_in_anchors(trace, code, frames, path, axes, turn, columns);
  write_in_base(trace, code, path, axes, turn, columns);

  std::vector<Vector3> linear(code.coordinate_names.size(), Vector3{0, 0, 0});
  std::vector<Vector3> angular = linear;
  for (const int j : path) {
    const CodeLink& link = code.link(j);
    if (link.coordinate < 0) continue;
    const std::size_t column = at(link.coordinate);
    const bool revolute = link.type == JointType::kRevolute;
    linear[column] = revolute ? columns[at(j)] : axes[at(j)].z;
    if (revolute) angular[column] = axes[at(j)].z;
  }
  const std::size_t n = linear.size();
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const ex value = k < 3 ? linear[i][k] : angular[i][k - 3];
      trace.output("J", static_cast<int>(k * n + i), value);
    }
  }
}

}  // namespace

void write_jacobian(Trace& trace, const CodeModel& code, int link) {
  const std::vector<LinkFrame> frames = write_frames(trace, code);
  const std::vector<int> path = path_to(code, link);
  const auto write = [&](Trace& target, int turn) {
    write_columns(target, code, frames, path, static_cast<std::size_t>(turn));
  };
  write(trace, cheapest_way(trace, static_cast<int>(path.size()) + 1, write));
}

}  // namespace dyngen

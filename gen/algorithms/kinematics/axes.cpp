// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/axes.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

Vector3 sum(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

std::vector<int> path_to(const CodeModel& code, int link) {
  std::vector<int> path;
  for (int j = link; j != 0; j = code.link(j).parent) path.push_back(j);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Axes> write_axes(Trace& trace, const std::vector<LinkFrame>& frames,
                             const std::vector<int>& path) {
  std::vector<Axes> all(frames.size());
  for (const int j : path) {
    const Axes& anchor = all[at(frames[at(j)].anchor)];
    const FrameRotation& r = frames[at(j)].from_anchor;
    Axes& own = all[at(j)];
    trace.section(fmt::format("axes x y z of frame {} in frame 0", j));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto assign = [&](const char* axis, const ex& value) {
        return trace.assign(fmt::format("{}{}_{}", axis, k + 1, j), value);
      };
      const ex across = assign("w", r.cos_alpha * anchor.y[k] + r.sin_alpha * anchor.z[k]);
      own.x[k] = assign("x", r.cos_angle * anchor.x[k] + r.sin_angle * across);
      own.y[k] = assign("y", r.cos_angle * across - r.sin_angle * anchor.x[k]);
      own.z[k] = assign("z", r.cos_alpha * anchor.z[k] - r.sin_alpha * anchor.y[k]);
    }
  }
  return all;
}

std::vector<Vector3> write_levers(Trace& trace, const std::string& name,
                                  const std::vector<LinkFrame>& frames,
                                  const std::vector<int>& path, const Vector3& point) {
  std::vector<Vector3> levers(frames.size(), Vector3{0, 0, 0});
  const auto turned = [&](int j, const Vector3& v) {
    return to_parent(trace, fmt::format("{}A_{}", name, j), frames[at(j)].from_anchor, v);
  };
  Vector3 from_child = point;  // the point seen from the link's origin, in its frame
  const LinkFrame* child = nullptr;
  for (auto it = path.rbegin(); it != path.rend(); ++it) {
    const int j = *it;
    const bool in_chain = child != nullptr && child->parallel;
    Vector3 lever = turned(j, in_chain ? child->P : from_child);
    // in a chain the child's lever is in the axes of the same anchor already
    if (in_chain) lever = sum(lever, from_child);
    levers[at(j)] = assign_vector(trace, name, j, lever);
    child = &frames[at(j)];
    from_child = levers[at(j)];
    if (!child->parallel)
      from_child = assign_vector(trace, name + "P", j, sum(child->P, from_child));
  }
  levers[0] = from_child;
  return levers;
}

Vector3 offset_in_base(Trace& trace, const CodeModel& code, const std::vector<Axes>& axes,
                       int link) {
  const CodeLink& own = code.link(link);
  const ex r = own.type == JointType::kPrismatic
                   ? trace.assign(fmt::format("R_{}", link), own.r + own.q)
                   : own.r;
  Vector3 offset;
  for (std::size_t k = 0; k < 3; ++k) {
    offset[k] = own.d * axes[at(own.parent)].x[k] + r * axes[at(link)].z[k];
  }
  return offset;
}

Vector3 in_base(const Axes& axes, const Vector3& v) {
  Vector3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = axes.x[k] * v[0] + axes.y[k] * v[1] + axes.z[k] * v[2];
  }
  return result;
}

}  // namespace dyngen

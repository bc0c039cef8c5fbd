// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Axes of a frame in another one.
struct Axes {
  Vector3 x = {1, 0, 0};
  Vector3 y = {0, 1, 0};
  Vector3 z = {0, 0, 1};
};

/// The links from the first one on the base to `link`.
std::vector<int> path_to(const CodeModel& code, int link);

/// Writes the axes in frame 0 of the frames on a path. Element j is link j, 0 the base; links off
/// the path have no meaning. Each frame is turned out of its anchor's: parallel joints turn as one.
std::vector<Axes> write_axes(Trace& trace, const std::vector<LinkFrame>& frames,
                             const std::vector<int>& path);

/// Writes the vectors from the origins of a path's links to a point, from the tip to the base.
/// Element j: from the origin of link j, in the axes of its anchor; element 0: from the base's, in
/// frame 0.
/// @param name   begins the names of what is assigned
/// @param point  in the frame of the path's last link
std::vector<Vector3> write_levers(Trace& trace, const std::string& name,
                                  const std::vector<LinkFrame>& frames,
                                  const std::vector<int>& path, const Vector3& point);

/// From the origin of a link's parent to its own, in frame 0: d x + r z. On the path of `axes`.
Vector3 offset_in_base(Trace& trace, const CodeModel& code, const std::vector<Axes>& axes,
                       int link);

/// A vector of the frame that has these axes.
Vector3 in_base(const Axes& axes, const Vector3& v);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/regressors/gravity_regressor.h"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "gen/algorithms/kinematics/frames.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// What a joint feels of the masses on a link that it carries.
struct Load {
  Vector3 per_moment = {0, 0, 0};  ///< torque per unit first moment, in the link's frame
  ex per_mass = 0;                 ///< torque per unit mass at the link's origin
  ex along_z = 0;                  ///< 1 or -1: the axis is the link's z axis, or along it
};

class GravityWriter {
 public:
  GravityWriter(Trace& trace, const CodeModel& code)
      : trace_(trace), code_(code), frames_(write_frames(trace, code)) {
    gravity_.resize(frames_.size());
    loads_.resize(frames_.size());
  }

  void write() {
    gravity_[0] = code_.gravity;
    for (int j = 1; j <= code_.size(); ++j) write_link(j);
    trace_.section("regressor");
    const int width = static_cast<int>(code_.beta.size());
    for (int j = 1; j <= code_.size(); ++j) {
      const int row = code_.link(j).coordinate;
      if (row < 0) continue;
      for (int c = 0; c < width; ++c) {
        const Column& column = code_.beta_columns[static_cast<std::size_t>(c)];
        trace_.output("Y", row * width + c, entry(column, j));
      }
    }
  }

 private:
  Vector3 turn(const std::string& name, int link, const FrameRotation& rotation, const Vector3& v) {
    const Vector3 turned = to_child(trace_, fmt::format("{}A2_{}", name, link), rotation, v);
    return assign_vector(trace_, name, link, turned);
  }

  void write_link(int j) {
    const CodeLink& link = code_.link(j);
    const LinkFrame& frame = frames_[static_cast<std::size_t>(j)];
    const auto anchor = static_cast<std::size_t>(frame.anchor);
    Vector3& gravity = gravity_[static_cast<std::size_t>(j)];
    std::map<int, Load>& loads = loads_[static_cast<std::size_t>(j)];
    trace_.section(fmt::format(
        "link {}: G acceleration against gravity, L torque of each joint that carries the link per "
        "unit first moment, in its frame, and per unit mass at its origin",
        j));
    gravity = turn("G", j, frame.from_anchor, gravity_[anchor]);

    const Vector3 about_z = {gravity[1], -gravity[0], 0};
    for (const auto& [joint, below] : loads_[static_cast<std::size_t>(link.parent)]) {
      Load& load = loads[joint];
      load.along_z = frame.parallel ? ex(frame.z_sign * below.along_z) : ex(0);
      const Vector3& c = below.per_moment;
      const ex carried = c[0] * frame.P[0] + c[1] * frame.P[1] + c[2] * frame.P[2];
      load.per_mass = trace_.assign(fmt::format("LM_{}_{}", joint, j), below.per_mass + carried);
      if (!load.along_z.is_zero()) {
        for (std::size_t k = 0; k < 3; ++k) load.per_moment[k] = load.along_z * about_z[k];
        continue;
      }
      const auto low = loads_[anchor].find(joint);
      load.per_moment =
          low != loads_[anchor].end()
              ? turn(fmt::format("L{}_", joint), j, frame.from_anchor, low->second.per_moment)
              : turn(fmt::format("L{}_", joint), j, frame.rotation, c);
    }
    if (link.type == JointType::kRevolute) loads[j] = {about_z, 0, 1};
    if (link.type == JointType::kPrismatic) loads[j].per_mass = gravity[2];
  }

  [[nodiscard]] ex entry(const Column& column, int joint) const {
    const auto& loads = loads_[static_cast<std::size_t>(column.link)];
    const auto load = loads.find(joint);
    if (load == loads.end()) return 0;
    switch (column.kind) {
      case Chi::kMX:
        return load->second.per_moment[0];
      case Chi::kMY:
        return load->second.per_moment[1];
      case Chi::kMZ:
        return load->second.per_moment[2];
      case Chi::kM:
        return load->second.per_mass;
      default:
        return 0;
    }
  }

  Trace& trace_;
  const CodeModel& code_;
  std::vector<LinkFrame> frames_;
  std::vector<Vector3> gravity_;
  std::vector<std::map<int, Load>> loads_;  // of each link, by joint
};

}  // namespace

void write_gravity_regressor(Trace& trace, const CodeModel& code) {
  GravityWriter(trace, code).write();
}

}  // namespace dyngen

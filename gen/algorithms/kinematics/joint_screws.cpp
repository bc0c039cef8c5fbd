// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/joint_screws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace dyngen {
namespace {

using GiNaC::ex;

/// A vector that only turns along a chain of parallel axes, in the frame below the chain.
using Anchored = std::optional<Vector3>;

bool is_own_axis(const Vector3& a) {
  return a[0].is_zero() && a[1].is_zero() && (a[2].is_equal(1) || a[2].is_equal(-1));
}

Vector3 plus(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// Carries the screws from the parent's frame to the link's.
class ScrewCarrier {
 public:
  ScrewCarrier(Trace& trace, int link, const LinkFrame& frame)
      : trace_(trace), link_(link), frame_(frame) {}

  Vector3 assign(const char* quantity, int joint, const Vector3& v) {
    Vector3 result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = trace_.assign(fmt::format("{}{}_{}_{}", quantity, k + 1, joint, link_), v[k]);
    }
    return result;
  }
  Vector3 turn(const char* quantity, int joint, const FrameRotation& rotation, const Vector3& v) {
    const std::string help = fmt::format("{}A2_{}_{}", quantity, joint, link_);
    return assign(quantity, joint, to_child(trace_, help, rotation, v));
  }
  /// A vector and what is added to it in the parent's frame.
  /// @param anchored  of the parent in, of the link out
  Vector3 carry(const char* quantity, int joint, const Vector3& from, const Vector3& more,
                Anchored& anchored) {
    if (frame_.parallel && anchored && is_zero(more)) {
      return turn(quantity, joint, frame_.from_anchor, *anchored);
    }
    const std::string below = std::string(quantity) + "A";
    const Vector3 v = assign(below.c_str(), joint, plus(from, more));
    anchored = frame_.parallel ? std::nullopt : Anchored(v);
    return turn(quantity, joint, frame_.rotation, v);
  }

 private:
  Trace& trace_;
  int link_;
  const LinkFrame& frame_;
};

/// A revolute joint of the link with an axis along a leader's takes the lead.
void change_leader(std::vector<JointScrew>& screws, int joint) {
  const std::vector<JointScrew> before = screws;
  for (JointScrew& screw : screws) {
    const auto leader = std::find_if(before.begin(), before.end(), [&](const JointScrew& other) {
      return other.joint == screw.leader;
    });
    if (!is_own_axis(leader->a)) continue;
    if (!screw.leads()) {
      for (std::size_t k = 0; k < 3; ++k) screw.b[k] += screw.sign * leader->b[k];
    }
    screw.sign *= leader->a[2];
    screw.leader = joint;
    screw.a = {0, 0, 0};
  }
}

/// The point of other axes that lies on the own one, or a new one.
int center_on_axis(std::map<int, Vector3>& centers, int joint) {
  for (const auto& [center, to_origin] : centers) {
    if (to_origin[0].is_zero() && to_origin[1].is_zero()) return center;
  }
  centers[joint] = {0, 0, 0};
  return joint;
}

}  // namespace

const JointScrew* LinkScrews::find(int joint) const {
  const auto it = std::find_if(joints.begin(), joints.end(),
                               [&](const JointScrew& screw) { return screw.joint == joint; });
  return it == joints.end() ? nullptr : &*it;
}

std::vector<LinkScrews> write_joint_screws(Trace& trace, const CodeModel& code,
                                           const std::vector<LinkFrame>& frames) {
  const std::size_t count = code.links.size() + 1;
  std::vector<LinkScrews> screws(count);
  std::vector<std::map<int, Anchored>> b_anchored(count), center_anchored(count);
  for (int j = 1; j <= code.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const CodeLink& link = code.link(j);
    const auto parent = static_cast<std::size_t>(link.parent);
    const LinkFrame& frame = frames[at];
    const LinkScrews& at_anchor = screws[static_cast<std::size_t>(frame.anchor)];
    LinkScrews& own = screws[at];
    own = screws[parent];
    b_anchored[at] = b_anchored[parent];
    center_anchored[at] = center_anchored[parent];
    if (!own.joints.empty()) {
      trace.section(fmt::format(
          "link {}: A, B angular velocity of the link and velocity of its origin, in its frame, "
          "per unit rate of the joints that carry it",
          j));
    }
    ScrewCarrier carrier(trace, j, frame);
    for (auto& [center, to_origin] : own.centers) {
      to_origin = carrier.carry("PC", center, to_origin, frame.P, center_anchored[at][center]);
    }
    for (JointScrew& screw : own.joints) {
      Anchored& anchored = b_anchored[at][screw.joint];
      screw.b = carrier.carry("B", screw.joint, screw.b, cross(screw.a, frame.P), anchored);
      screw.b_below = anchored;
      if (!screw.leads()) continue;
      const JointScrew* low = at_anchor.find(screw.joint);
      screw.a = low != nullptr ? carrier.turn("A", screw.joint, frame.from_anchor, low->a)
                               : carrier.turn("A", screw.joint, frame.rotation, screw.a);
    }
    if (link.coordinate < 0) continue;
    JointScrew joint{.joint = j, .leader = j};
    if (link.type == JointType::kRevolute) {
      change_leader(own.joints, j);
      for (JointScrew& screw : own.joints) {
        if (screw.leader != j) continue;
        screw.b = carrier.assign("B", screw.joint, screw.b);
        screw.b_below.reset();
        b_anchored[at].erase(screw.joint);
      }
      joint.a = {0, 0, 1};
      joint.center = center_on_axis(own.centers, j);
    } else {
      joint.b = {0, 0, 1};
    }
    own.joints.push_back(joint);
  }
  return screws;
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/joint_screws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace dyngen {
namespace {

using GiNaC::ex;

/// A vector that only turns along a chain of parallel axes, in the frame below the chain.
using Anchored = std::optional<Vector3>;

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

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
  /// @param anchored  of the parent in, of the link out
  Vector3 carry_velocity(const JointScrew& from, Anchored& anchored) {
    const Vector3 arm = cross(from.a, frame_.P);
    if (frame_.parallel && anchored && is_zero(arm)) {
      return turn("B", from.joint, frame_.from_anchor, *anchored);
    }
    const Vector3 b = assign("BA", from.joint, plus(from.b, arm));
    anchored = frame_.parallel ? std::nullopt : Anchored(b);
    return turn("B", from.joint, frame_.rotation, b);
  }

 private:
  Trace& trace_;
  int link_;
  const LinkFrame& frame_;
};

/// A revolute joint of the link with an axis along a leader's takes the lead.
void change_leader(std::vector<JointScrew>& screws, int joint) {
  std::vector<JointScrew> before = screws;
  for (JointScrew& screw : screws) {
    const JointScrew& leader = *find_screw(before, screw.leader);
    if (!is_own_axis(leader.a)) continue;
    if (!screw.leads()) {
      for (std::size_t k = 0; k < 3; ++k) screw.b[k] += screw.sign * leader.b[k];
    }
    screw.sign *= leader.a[2];
    screw.leader = joint;
    screw.a = {0, 0, 0};
  }
}

}  // namespace

const JointScrew* find_screw(const std::vector<JointScrew>& screws, int joint) {
  const auto it = std::find_if(screws.begin(), screws.end(),
                               [&](const JointScrew& screw) { return screw.joint == joint; });
  return it == screws.end() ? nullptr : &*it;
}

std::vector<std::vector<JointScrew>> write_joint_screws(Trace& trace, const CodeModel& code,
                                                        const std::vector<LinkFrame>& frames) {
  const std::size_t count = code.links.size() + 1;
  std::vector<std::vector<JointScrew>> screws(count);
  std::vector<std::vector<Anchored>> anchored(count);  // of each screw's b
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    const LinkFrame& frame = frames[static_cast<std::size_t>(j)];
    const auto& from_anchor = screws[static_cast<std::size_t>(frame.anchor)];
    std::vector<JointScrew>& own = screws[static_cast<std::size_t>(j)];
    std::vector<Anchored>& own_anchored = anchored[static_cast<std::size_t>(j)];
    own = screws[static_cast<std::size_t>(link.parent)];
    own_anchored = anchored[static_cast<std::size_t>(link.parent)];
    if (!own.empty()) {
      trace.section(fmt::format(
          "link {}: A, B angular velocity of the link and velocity of its origin, in its frame, "
          "per unit rate of the joints that carry it",
          j));
    }
    ScrewCarrier carrier(trace, j, frame);
    for (std::size_t s = 0; s < own.size(); ++s) {
      const JointScrew before = own[s];
      own[s].b = carrier.carry_velocity(before, own_anchored[s]);
      if (!before.leads()) continue;
      const JointScrew* low = find_screw(from_anchor, before.joint);
      own[s].a = low != nullptr ? carrier.turn("A", before.joint, frame.from_anchor, low->a)
                                : carrier.turn("A", before.joint, frame.rotation, before.a);
    }
    if (link.coordinate < 0) continue;
    JointScrew joint{.joint = j, .leader = j};
    if (link.type == JointType::kRevolute) {
      change_leader(own, j);
      for (std::size_t s = 0; s < own.size(); ++s) {
        if (own[s].leader != j) continue;
        own[s].b = carrier.assign("B", own[s].joint, own[s].b);
        own_anchored[s].reset();
      }
      joint.a = {0, 0, 1};
    } else {
      joint.b = {0, 0, 1};
    }
    own.push_back(joint);
    own_anchored.emplace_back();
  }
  return screws;
}

}  // namespace dyngen

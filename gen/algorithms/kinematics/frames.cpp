// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/frames.h"

#include <fmt/format.h>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// The angle of a chain of parallel joints against its anchor, before sin and cos are taken.
struct Chain {
  int anchor = 0;
  ex alpha = 0;
  ex angle = 0;
  std::string suffix;  // joints in it: "2", "2_3"
};

FrameRotation write_rotation(Trace& trace, const std::string& suffix, const ex& alpha,
                             const ex& angle) {
  FrameRotation rotation;
  rotation.sin_alpha = trace.constant("SA" + suffix, exact_sin(alpha));
  rotation.cos_alpha = trace.constant("CA" + suffix, exact_cos(alpha));
  const Trace::SinCos turn = trace.sin_cos(suffix, angle);
  rotation.sin_angle = turn.sin;
  rotation.cos_angle = turn.cos;
  return rotation;
}

}  // namespace

Vector3 to_child(Trace& trace, const std::string& name, const FrameRotation& r, const Vector3& v) {
  const ex y = trace.assign(name, r.cos_alpha * v[1] + r.sin_alpha * v[2]);
  return {r.cos_angle * v[0] + r.sin_angle * y, r.cos_angle * y - r.sin_angle * v[0],
          r.cos_alpha * v[2] - r.sin_alpha * v[1]};
}

Vector3 to_parent(Trace& trace, const std::string& name, const FrameRotation& r, const Vector3& v) {
  const ex y = r.sin_angle * v[0] + r.cos_angle * v[1];
  const ex x = r.cos_angle * v[0] - r.sin_angle * v[1];
  if (r.sin_alpha.is_zero()) return {x, r.cos_alpha * y, r.cos_alpha * v[2]};
  if (r.cos_alpha.is_zero()) return {x, -r.sin_alpha * v[2], (r.sin_alpha * y).expand()};
  const ex shared = trace.assign(name, y);
  return {x, r.cos_alpha * shared - r.sin_alpha * v[2], r.sin_alpha * shared + r.cos_alpha * v[2]};
}

FrameRotation without_turn(const FrameRotation& rotation) {
  FrameRotation result = rotation;
  result.sin_angle = 0;
  result.cos_angle = 1;
  return result;
}

Vector3 turn(const FrameRotation& r, const Vector3& v) {
  return {r.cos_angle * v[0] - r.sin_angle * v[1], r.sin_angle * v[0] + r.cos_angle * v[1], v[2]};
}

Vector3 turn_back(const FrameRotation& r, const Vector3& v) {
  return {r.cos_angle * v[0] + r.sin_angle * v[1], r.cos_angle * v[1] - r.sin_angle * v[0], v[2]};
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

Vector3 assign_vector(Trace& trace, const std::string& name, int link, const Vector3& v) {
  Vector3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = trace.assign(fmt::format("{}{}_{}", name, k + 1, link), v[k]);
  }
  return result;
}

std::vector<LinkFrame> write_frames(Trace& trace, const CodeModel& code,
                                    const std::vector<ex>& shifts) {
  const auto shift = [&](int j) {
    return shifts.empty() ? ex(0) : shifts[static_cast<std::size_t>(j)];
  };
  trace.section("sines and cosines of the joint angles");
  std::vector<LinkFrame> frames(code.links.size() + 1);
  std::vector<Chain> chains(code.links.size() + 1);
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    LinkFrame& frame = frames[static_cast<std::size_t>(j)];
    Chain& chain = chains[static_cast<std::size_t>(j)];
    const std::string number = std::to_string(j);
    const bool revolute = link.type == JointType::kRevolute;
    const ex angle = revolute ? ex(link.q + link.theta) : link.theta;

    frame.rotation = write_rotation(trace, number, link.alpha, angle);
    const ex along = link.type == JointType::kPrismatic
                         ? trace.assign("R_" + number, link.r + link.q)
                         : link.r + shift(j);
    frame.P = {link.d, trace.assign("P2_" + number, -along * frame.rotation.sin_alpha),
               trace.assign("P3_" + number, along * frame.rotation.cos_alpha - shift(link.parent))};

    frame.parallel = link.parent != 0 && is_zero_number(GiNaC::sin(link.alpha));
    if (!frame.parallel) {
      chain = {link.parent, link.alpha, angle, number};
      frame.anchor = link.parent;
      frame.from_anchor = frame.rotation;
      continue;
    }
    // Rz(a) Rx(pi) = Rx(pi) Rz(-a): an axis turned over joins the chain with the sign changed
    const Chain& first = chains[static_cast<std::size_t>(link.parent)];
    frame.z_sign = frame.rotation.cos_alpha;
    chain = {first.anchor, first.alpha + link.alpha, frame.z_sign * first.angle + angle,
             revolute ? first.suffix + "_" + number : first.suffix};
    frame.anchor = first.anchor;
    frame.from_anchor = write_rotation(trace, chain.suffix, chain.alpha, chain.angle.expand());
  }
  return frames;
}

}  // namespace dyngen

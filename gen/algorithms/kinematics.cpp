// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics.h"

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
  rotation.sin_alpha = trace.constant("SA" + suffix, GiNaC::sin(alpha));
  rotation.cos_alpha = trace.constant("CA" + suffix, GiNaC::cos(alpha));
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

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 assign_vector(Trace& trace, const std::string& name, int link, const Vector3& v) {
  Vector3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = trace.assign(fmt::format("{}{}_{}", name, k + 1, link), v[k]);
  }
  return result;
}

std::vector<LinkFrame> write_frames(Trace& trace, const CodeModel& code) {
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
                         : link.r;
    frame.P = {link.d, trace.assign("P2_" + number, -along * frame.rotation.sin_alpha),
               trace.assign("P3_" + number, along * frame.rotation.cos_alpha)};

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

namespace {

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

/// U = skew(WP) + skew(W) skew(W)
Matrix3 write_u(Trace& trace, int j, const Vector3& W, const Vector3& WP) {
  const auto product = [&](std::size_t a, std::size_t b) {
    return trace.assign(fmt::format("DV{}{}_{}", a + 1, b + 1, j), W[a] * W[b]);
  };
  const ex dv11 = product(0, 0), dv22 = product(1, 1), dv33 = product(2, 2);
  const ex dv12 = product(0, 1), dv13 = product(0, 2), dv23 = product(1, 2);
  const auto element = [&](int row, int column, const ex& value) {
    return trace.assign(fmt::format("U{}{}_{}", row, column, j), value);
  };
  return {{{element(1, 1, -dv22 - dv33), element(1, 2, dv12 - WP[2]), element(1, 3, dv13 + WP[1])},
           {element(2, 1, dv12 + WP[2]), element(2, 2, -dv11 - dv33), element(2, 3, dv23 - WP[0])},
           {element(3, 1, dv13 - WP[1]), element(3, 2, dv23 + WP[0]),
            element(3, 3, -dv11 - dv22)}}};
}

}  // namespace

std::vector<LinkMotion> write_motion(Trace& trace, const CodeModel& code,
                                     const std::vector<LinkFrame>& frames,
                                     const MotionTerms& terms) {
  std::vector<LinkMotion> motions(code.links.size() + 1);
  for (LinkMotion& motion : motions) {
    for (std::size_t k = 0; k < 3; ++k) {
      motion.W[k] = motion.WP[k] = motion.VP[k] = 0;
      for (std::size_t i = 0; i < 3; ++i) motion.U[k][i] = 0;
    }
  }
  if (terms.gravity) motions[0].VP = code.gravity;
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    const LinkFrame& frame = frames[static_cast<std::size_t>(j)];
    const LinkMotion& parent = motions[static_cast<std::size_t>(link.parent)];
    const LinkMotion& anchor = motions[static_cast<std::size_t>(frame.anchor)];
    LinkMotion& own = motions[static_cast<std::size_t>(j)];
    const bool revolute = link.type == JointType::kRevolute;
    const ex dq = terms.velocity ? link.dq : ex(0);
    const ex ddq = terms.acceleration ? link.ddq : ex(0);
    trace.section(fmt::format(
        "forward, link {}: W angular velocity, WP its derivative, VP acceleration of O{}, in frame {}",
        j, j, j));

    const ex turn = revolute ? dq : ex(0);
    const ex rate = frame.parallel ? frame.z_sign * parent.rate + turn : turn;
    Vector3 W = to_child(trace, fmt::format("WA2_{}", j), frame.from_anchor, anchor.W);
    W[2] = W[2].is_zero() || !frame.parallel ? W[2] + rate : frame.z_sign * parent.W[2] + turn;
    own.W = assign_vector(trace, "W", j, W);
    own.rate = trace.assign(fmt::format("DQ_{}", j), rate);

    Vector3 WP = to_child(trace, fmt::format("WPA2_{}", j), frame.from_anchor, anchor.WP);
    WP[0] += own.rate * own.W[1];
    WP[1] -= own.rate * own.W[0];
    if (frame.parallel) WP[2] = frame.z_sign * parent.WP[2];
    if (revolute) WP[2] += ddq;
    own.WP = assign_vector(trace, "WP", j, WP);

    Vector3 shift;  // acceleration of the own origin against the parent's
    for (std::size_t k = 0; k < 3; ++k) {
      shift[k] = 0;
      for (std::size_t i = 0; i < 3; ++i) shift[k] += parent.U[k][i] * frame.P[i];
    }
    Vector3 slide = {0, 0, 0};  // of a prismatic joint, in the own frame
    if (link.type == JointType::kPrismatic) {
      const ex twice = trace.assign(fmt::format("DQ2_{}", j), 2 * dq);
      slide = {twice * own.W[1], -twice * own.W[0], ddq};
    }
    own.rides_on_anchor = is_zero(shift) && is_zero(slide) &&
                          (!frame.parallel || parent.rides_on_anchor);
    const bool from_anchor = frame.parallel && own.rides_on_anchor;
    const Vector3& carrier = from_anchor ? anchor.VP : parent.VP;
    for (std::size_t k = 0; k < 3; ++k) shift[k] += carrier[k];
    const Vector3 VA = assign_vector(trace, "VA", j, shift);
    Vector3 VP = to_child(trace, fmt::format("VPA2_{}", j),
                          from_anchor ? frame.from_anchor : frame.rotation, VA);
    for (std::size_t k = 0; k < 3; ++k) VP[k] += slide[k];
    own.VP = assign_vector(trace, "VP", j, VP);
    own.U = write_u(trace, j, own.W, own.WP);
  }
  return motions;
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics.h"

#include <fmt/format.h>

namespace dyngen {
namespace {

using GiNaC::ex;

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

/// Writes the angular quantities of one link.
class LinkRotation {
 public:
  LinkRotation(Trace& trace, int link, LinkMotion& own) : trace_(trace), link_(link), own_(own) {}

  /// W, W2 W3, W1 W3, W1 W2, and the rate about z that the chain of parallel axes adds.
  void write_velocity(const LinkFrame& frame, const LinkMotion& anchor, const LinkMotion& parent,
                      const ex& turn) {
    const ex rate = frame.parallel ? frame.z_sign * parent.rate + turn : turn;
    Vector3 W = to_child(trace_, name("WA2"), frame.from_anchor, anchor.W);
    W[2] = W[2].is_zero() || !frame.parallel ? W[2] + rate : frame.z_sign * parent.W[2] + turn;
    own_.W = assign_vector(trace_, "W", link_, W);
    own_.rate = trace_.assign(name("DQ"), rate);
    own_.WW = {assign("DV23", own_.W[1] * own_.W[2]), assign("DV13", own_.W[0] * own_.W[2]),
               assign("DV12", own_.W[0] * own_.W[1])};
  }

  /// WP3, which both ways below need.
  void write_axial_acceleration(const LinkFrame& frame, const LinkMotion& parent, const ex& ddq) {
    const FrameRotation& r = frame.rotation;
    const ex carried = frame.parallel ? ex(frame.z_sign * parent.WP[2])
                                      : ex(r.cos_alpha * parent.WP[2] - r.sin_alpha * parent.WP[1]);
    own_.WP[2] = assign("WP3", carried + ddq);
  }

  /// The third column of U from the anchor's U, the rest of WP and U from it.
  void write_from_column(const FrameRotation& rotation, const LinkMotion& anchor) {
    Vector3 column;  // U of the anchor times the axis z
    for (std::size_t k = 0; k < 3; ++k) {
      column[k] = rotation.cos_alpha * anchor.U[k][2] - rotation.sin_alpha * anchor.U[k][1];
    }
    const Vector3 u = to_child(trace_, name("UA"), rotation, column);
    const ex u13 = assign("U13", u[0]), u23 = assign("U23", u[1]), u33 = assign("U33", u[2]);
    own_.WP[0] = assign("WP1", own_.WW[0] - u23);
    own_.WP[1] = assign("WP2", u13 - own_.WW[1]);
    const ex dv22 = square(1), dv33 = square(2);
    const ex d23 = assign("D23", dv22 - dv33);
    const ex u11 = assign("U11", -dv22 - dv33), u22 = assign("U22", u33 + d23);
    own_.D = {d23, assign("D31", u33 - u11), assign("D12", u11 - u22)};
    write_u({u11, u22, u33}, u13, u23);
  }

  /// WP from the anchor's WP, U from W and WP.
  void write_from_acceleration(const FrameRotation& rotation, const LinkMotion& anchor) {
    const Vector3 carried = to_child(trace_, name("WPA2"), rotation, anchor.WP);
    own_.WP[0] = assign("WP1", carried[0] + own_.rate * own_.W[1]);
    own_.WP[1] = assign("WP2", carried[1] - own_.rate * own_.W[0]);
    const ex dv11 = square(0), dv22 = square(1), dv33 = square(2);
    own_.D = {assign("D23", dv22 - dv33), assign("D31", dv33 - dv11), assign("D12", dv11 - dv22)};
    write_u({assign("U11", -dv22 - dv33), assign("U22", -dv11 - dv33), assign("U33", -dv11 - dv22)},
            assign("U13", own_.WW[1] + own_.WP[1]), assign("U23", own_.WW[0] - own_.WP[0]));
  }

 private:
  [[nodiscard]] std::string name(const char* quantity) const {
    return fmt::format("{}_{}", quantity, link_);
  }
  ex assign(const char* quantity, const ex& value) { return trace_.assign(name(quantity), value); }
  ex square(std::size_t k) {
    return trace_.assign(fmt::format("DV{}{}_{}", k + 1, k + 1, link_), own_.W[k] * own_.W[k]);
  }

  void write_u(const Vector3& diagonal, const ex& u13, const ex& u23) {
    const Vector3& WP = own_.WP;
    const Vector3& WW = own_.WW;
    own_.U = {{{diagonal[0], assign("U12", WW[2] - WP[2]), u13},
               {assign("U21", WW[2] + WP[2]), diagonal[1], u23},
               {assign("U31", WW[1] - WP[1]), assign("U32", WW[0] + WP[0]), diagonal[2]}}};
  }

  Trace& trace_;
  int link_;
  LinkMotion& own_;
};

/// Right angles and parallel axes.
bool is_plain(const FrameRotation& rotation) {
  return rotation.sin_alpha.is_zero() || rotation.cos_alpha.is_zero();
}

std::vector<LinkMotion> standing_links(std::size_t count) {
  LinkMotion standing;
  for (std::size_t k = 0; k < 3; ++k) {
    standing.W[k] = standing.WP[k] = standing.VP[k] = standing.WW[k] = standing.D[k] = 0;
    for (std::size_t i = 0; i < 3; ++i) standing.U[k][i] = 0;
  }
  return std::vector<LinkMotion>(count, standing);
}

/// VP of a link.
void write_acceleration(Trace& trace, int j, const CodeLink& link, const LinkFrame& frame,
                        const LinkMotion& anchor, const LinkMotion& parent, const ex& dq,
                        const ex& ddq, LinkMotion& own) {
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
  own.rides_on_anchor =
      is_zero(shift) && is_zero(slide) && (!frame.parallel || parent.rides_on_anchor);
  const bool from_anchor = frame.parallel && own.rides_on_anchor;
  const Vector3& carrier = from_anchor ? anchor.VP : parent.VP;
  for (std::size_t k = 0; k < 3; ++k) shift[k] += carrier[k];
  const Vector3 VA = assign_vector(trace, "VA", j, shift);
  Vector3 VP = to_child(trace, fmt::format("VPA2_{}", j),
                        from_anchor ? frame.from_anchor : frame.rotation, VA);
  for (std::size_t k = 0; k < 3; ++k) VP[k] += slide[k];
  own.VP = assign_vector(trace, "VP", j, VP);
}

}  // namespace

std::vector<LinkMotion> write_motion(Trace& trace, const CodeModel& code,
                                     const std::vector<LinkFrame>& frames,
                                     const MotionTerms& terms) {
  std::vector<LinkMotion> motions = standing_links(code.links.size() + 1);
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
    trace.section(
        fmt::format("forward, link {}: W angular velocity, WP its derivative, VP acceleration of "
                    "O{}, in frame {}",
                    j, j, j));
    LinkRotation rotation(trace, j, own);
    rotation.write_velocity(frame, anchor, parent, revolute ? dq : ex(0));
    rotation.write_axial_acceleration(frame, parent, revolute ? ddq : ex(0));
    if (is_plain(frame.from_anchor)) {
      rotation.write_from_column(frame.from_anchor, anchor);
    } else {
      rotation.write_from_acceleration(frame.from_anchor, anchor);
    }
    write_acceleration(trace, j, link, frame, anchor, parent, dq, ddq, own);
  }
  return motions;
}

}  // namespace dyngen

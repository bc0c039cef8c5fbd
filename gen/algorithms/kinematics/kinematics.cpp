// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/kinematics/kinematics.h"

#include <fmt/format.h>

#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Right angles and parallel axes.
bool is_plain(const FrameRotation& rotation) {
  return rotation.sin_alpha.is_zero() || rotation.cos_alpha.is_zero();
}

/// Writes W, WP and U of one link in one view.
class ViewRotation {
 public:
  /// @param mark         begins the names: "" in the link's frame, "A" in the axis frame
  /// @param carries_wp   WP1 and WP2 are needed for themselves
  ViewRotation(Trace& trace, int link, std::string mark, bool carries_wp, LinkMotion& own)
      : trace_(trace), link_(link), mark_(std::move(mark)), carries_wp_(carries_wp), own_(own) {}

  void write_velocity(const Vector3& W) {
    for (std::size_t k = 0; k < 3; ++k) own_.W[k] = assign("W" + std::to_string(k + 1), W[k]);
  }

  /// From the third column of U.
  void write_from_column(const Vector3& column) {
    write_products();
    const ex u13 = assign("U13", column[0]), u23 = assign("U23", column[1]),
             u33 = assign("U33", column[2]);
    own_.WP[0] = assign("WP1", own_.WW[0] - u23);
    own_.WP[1] = assign("WP2", u13 - own_.WW[1]);
    const bool about_two_axes = own_.W[0].is_zero() || own_.W[1].is_zero() || own_.W[2].is_zero();
    if (about_two_axes) {
      write_squares();
    } else {
      const ex dv22 = square(1), dv33 = square(2);
      const ex d23 = assign("D23", dv22 - dv33);
      const ex u11 = assign("U11", -dv22 - dv33), u22 = assign("U22", u33 + d23);
      own_.D = {d23, assign("D31", u33 - u11), assign("D12", u11 - u22)};
      own_.U[0][0] = u11;
      own_.U[1][1] = u22;
    }
    own_.U[2][2] = u33;
    write_others(u13, u23);
  }

  /// From WP1 and WP2.
  void write_from_acceleration(const ex& wp1, const ex& wp2) {
    write_products();
    own_.WP[0] = assign("WP1", wp1);
    own_.WP[1] = assign("WP2", wp2);
    write_squares();
    write_others(assign("U13", own_.WW[1] + own_.WP[1]), assign("U23", own_.WW[0] - own_.WP[0]));
  }

 private:
  ex assign(const std::string& quantity, const ex& value) {
    return trace_.assign(fmt::format("{}{}_{}", mark_, quantity, link_), value);
  }
  ex square(std::size_t k) {
    return assign(fmt::format("DV{}{}", k + 1, k + 1), own_.W[k] * own_.W[k]);
  }

  void write_products() {
    own_.WW = {assign("DV23", own_.W[1] * own_.W[2]), assign("DV13", own_.W[0] * own_.W[2]),
               assign("DV12", own_.W[0] * own_.W[1])};
  }

  void write_squares() {
    const ex dv11 = square(0), dv22 = square(1), dv33 = square(2);
    own_.D = {assign("D23", dv22 - dv33), assign("D31", dv33 - dv11), assign("D12", dv11 - dv22)};
    own_.U[0][0] = assign("U11", -dv22 - dv33);
    own_.U[1][1] = assign("U22", -dv11 - dv33);
    own_.U[2][2] = assign("U33", -dv11 - dv22);
  }

  void write_others(const ex& u13, const ex& u23) {
    const Vector3& WP = own_.WP;
    const Vector3& WW = own_.WW;
    Matrix3& U = own_.U;
    U[0][1] = assign("U12", WW[2] - WP[2]);
    U[1][0] = assign("U21", WW[2] + WP[2]);
    U[0][2] = u13;
    U[1][2] = u23;
    if (carries_wp_) {
      U[2][0] = assign("U31", WW[1] - WP[1]);
      U[2][1] = assign("U32", WW[0] + WP[0]);
    } else {  // U31 + U13 = 2 W1 W3: no WP1, WP2, nor W1 W3, W2 W3
      const ex twice = assign("W3T", 2 * own_.W[2]);
      U[2][0] = assign("U31", own_.W[0] * twice - u13);
      U[2][1] = assign("U32", own_.W[1] * twice - u23);
    }
  }

  Trace& trace_;
  int link_;
  std::string mark_;
  bool carries_wp_;
  LinkMotion& own_;
};

/// What the rest of the recursion reads of a link's motion.
struct Readers {
  bool wp = false;                  ///< a link on a non-parallel axis hangs on it and takes WP over
  bool link = false, axis = false;  ///< the views
};

std::vector<Readers> find_readers(const CodeModel& code, const std::vector<LinkFrame>& frames,
                                  const RneaForm& form) {
  std::vector<Readers> readers(code.links.size() + 1);
  for (int j = 1; j <= code.size(); ++j) {
    const std::size_t at = static_cast<std::size_t>(j);
    const LinkForm& own = form[at - 1];
    const LinkFrame& frame = frames[at];
    (own.inertia == View::kLink ? readers[at].link : readers[at].axis) = true;
    Readers& parent = readers[static_cast<std::size_t>(code.link(j).parent)];
    readers[static_cast<std::size_t>(frame.anchor)].link = true;
    if (!frame.parallel) {
      parent.wp = true;
    } else if (own.acceleration == View::kLink && !is_zero(frame.P)) {
      parent.link = true;
    } else {
      parent.axis = true;
    }
  }
  return readers;
}

std::vector<ChainMotion> standing_links(std::size_t count) {
  LinkMotion standing;
  for (std::size_t k = 0; k < 3; ++k) {
    standing.W[k] = standing.WP[k] = standing.VP[k] = standing.WW[k] = standing.D[k] = 0;
    for (std::size_t i = 0; i < 3; ++i) standing.U[k][i] = 0;
  }
  return std::vector<ChainMotion>(count, ChainMotion{standing, standing, 0, true});
}

/// Writes the forward recursion link by link.
class Forward {
 public:
  Forward(Trace& trace, const CodeModel& code, const std::vector<LinkFrame>& frames,
          const MotionTerms& terms, const RneaForm& form)
      : trace_(trace),
        code_(code),
        frames_(frames),
        terms_(terms),
        form_(form),
        readers_(find_readers(code, frames, form)),
        motions_(standing_links(code.links.size() + 1)) {
    if (terms.gravity) motions_[0].link.VP = motions_[0].axis.VP = code.gravity;
  }

  void write_link(int j) {
    const CodeLink& link = code_.link(j);
    const bool revolute = link.type == JointType::kRevolute;
    const ex dq = terms_.velocity ? link.dq : ex(0);
    const ex ddq = terms_.acceleration ? link.ddq : ex(0);
    trace_.section(
        fmt::format("forward, link {}: W angular velocity, WP its derivative, VP acceleration of "
                    "O{}, in frame {}",
                    j, j, j));
    write_rotation(j, revolute ? dq : ex(0), revolute ? ddq : ex(0));
    write_acceleration(j, dq, ddq);
  }

  [[nodiscard]] std::vector<ChainMotion> result() && { return std::move(motions_); }

 private:
  [[nodiscard]] std::string name(const char* quantity, int j) const {
    return fmt::format("{}_{}", quantity, j);
  }
  ChainMotion& motion(int j) { return motions_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] const LinkFrame& frame(int j) const { return frames_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] const LinkForm& form(int j) const { return form_[static_cast<std::size_t>(j - 1)]; }

  void write_rotation(int j, const ex& dq, const ex& ddq) {
    const LinkFrame& frame = this->frame(j);
    const ChainMotion& parent = motion(code_.link(j).parent);
    const LinkMotion& anchor = motion(frame.anchor).link;
    const FrameRotation& full = frame.from_anchor;
    const FrameRotation fixed = without_turn(full);
    ChainMotion& own = motion(j);

    const bool euler = form(j).euler_tensor;
    const bool plain = is_plain(full);
    const bool in_axis = form(j).inertia == View::kAxis;
    ViewRotation axis(trace_, j, "A", !plain || (!euler && in_axis), own.axis);
    ViewRotation link(trace_, j, "", !plain || (!euler && !in_axis) || readers_[at(j)].wp,
                      own.link);

    const ex rate = frame.parallel ? frame.z_sign * parent.rate + dq : dq;
    Vector3 W = to_child(trace_, name("WA2", j), fixed, anchor.W);
    W[2] = W[2].is_zero() || !frame.parallel ? W[2] + rate : frame.z_sign * parent.link.W[2] + dq;
    own.rate = trace_.assign(name("DQ", j), rate);
    W[2] = trace_.assign(name("W3", j), W[2]);  // the same in both
    const Readers& readers = readers_[at(j)];
    axis.write_velocity(W);
    link.write_velocity(turn_back(full, own.axis.W));

    const FrameRotation& r = frame.rotation;
    const ex carried = frame.parallel
                           ? ex(frame.z_sign * parent.link.WP[2])
                           : ex(r.cos_alpha * parent.link.WP[2] - r.sin_alpha * parent.link.WP[1]);
    own.axis.WP[2] = own.link.WP[2] = trace_.assign(name("WP3", j), carried + ddq);
    if (plain) {
      Vector3 column;  // U of the anchor times the axis z
      for (std::size_t k = 0; k < 3; ++k) {
        column[k] = full.cos_alpha * anchor.U[k][2] - full.sin_alpha * anchor.U[k][1];
      }
      const Vector3 u = to_child(trace_, name("UA", j), fixed, column);
      if (readers.axis) axis.write_from_column(u);
      if (readers.link) link.write_from_column(turn_back(full, u));
    } else {  // WP of the anchor, and what the own rate adds
      const Vector3 wp = to_child(trace_, name("WPA2", j), fixed, anchor.WP);
      if (readers.axis) {
        axis.write_from_acceleration(wp[0] + own.rate * own.axis.W[1],
                                     wp[1] - own.rate * own.axis.W[0]);
      }
      if (!readers.link) return;
      const Vector3 turned = turn_back(full, wp);
      link.write_from_acceleration(turned[0] + own.rate * own.link.W[1],
                                   turned[1] - own.rate * own.link.W[0]);
    }
  }

  /// VP of the origin, from the parent's in one of its views.
  void write_acceleration(int j, const ex& dq, const ex& ddq) {
    const CodeLink& robot_link = code_.link(j);
    const LinkFrame& frame = this->frame(j);
    const ChainMotion& parent = motion(robot_link.parent);
    ChainMotion& own = motion(j);
    const bool slides = robot_link.type == JointType::kPrismatic;
    const ex twice = slides ? trace_.assign(name("DQ2", j), 2 * dq) : ex(0);
    const auto finish = [&](LinkMotion& view, const char* mark, Vector3 VP) {
      if (slides) {  // along the axis z, the same in both views
        VP[0] += twice * view.W[1];
        VP[1] -= twice * view.W[0];
        VP[2] += ddq;
      }
      view.VP = assign_vector(trace_, fmt::format("{}VP", mark), j, VP);
    };

    own.rides_on_anchor =
        is_zero(frame.P) && !slides && (!frame.parallel || parent.rides_on_anchor);
    const bool from_axis =
        frame.parallel && (own.rides_on_anchor || form(j).acceleration == View::kAxis);
    const LinkMotion& carrier = from_axis ? parent.axis : parent.link;
    const Vector3 P = from_axis ? write_turned_origin(j) : frame.P;
    Vector3 VA;
    for (std::size_t k = 0; k < 3; ++k) {
      VA[k] = carrier.VP[k];
      for (std::size_t i = 0; i < 3; ++i) VA[k] += carrier.U[k][i] * P[i];
    }
    VA = assign_vector(trace_, from_axis ? "AVA" : "VA", j, VA);
    if (from_axis || !frame.parallel) {
      const Vector3 VP = to_child(trace_, name("VPA2", j), without_turn(frame.rotation), VA);
      finish(own.axis, "A", VP);
      own.link.VP = assign_vector(trace_, "VP", j, turn_back(frame.from_anchor, own.axis.VP));
    } else {
      finish(own.link, "", to_child(trace_, name("VPA2", j), frame.rotation, VA));
      own.axis.VP = assign_vector(trace_, "AVP", j, turn(frame.from_anchor, own.link.VP));
    }
  }

  /// Origin of a parallel axis in the parent's axis frame.
  Vector3 write_turned_origin(int j) {
    return assign_vector(trace_, "AP", j,
                         turn(frame(code_.link(j).parent).from_anchor, frame(j).P));
  }

  Trace& trace_;
  const CodeModel& code_;
  const std::vector<LinkFrame>& frames_;
  const MotionTerms& terms_;
  const RneaForm& form_;
  std::vector<Readers> readers_;
  std::vector<ChainMotion> motions_;
};

}  // namespace

std::vector<ChainMotion> write_chain_motion(Trace& trace, const CodeModel& code,
                                            const std::vector<LinkFrame>& frames,
                                            const MotionTerms& terms, const RneaForm& form) {
  Forward forward(trace, code, frames, terms, form);
  for (int j = 1; j <= code.size(); ++j) forward.write_link(j);
  return std::move(forward).result();
}

std::vector<LinkMotion> write_motion(Trace& trace, const CodeModel& code,
                                     const std::vector<LinkFrame>& frames,
                                     const MotionTerms& terms) {
  LinkForm plain;
  plain.acceleration = View::kLink;
  std::vector<LinkMotion> result;
  for (const ChainMotion& motion :
       write_chain_motion(trace, code, frames, terms, RneaForm(code.links.size(), plain))) {
    result.push_back(motion.link);
  }
  return result;
}

}  // namespace dyngen

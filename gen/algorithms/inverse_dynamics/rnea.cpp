// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/inverse_dynamics/rnea.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "gen/algorithms/bodies/link_inertia.h"
#include "gen/algorithms/bodies/link_wrench.h"
#include "gen/algorithms/inverse_dynamics/effects.h"
#include "gen/algorithms/inverse_dynamics/friction.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Force and moment about the origin.
struct CarriedWrench {
  Vector3 force = {0, 0, 0};
  Vector3 moment = {0, 0, 0};

  void add(const Vector3& more_force, const Vector3& more_moment) {
    for (std::size_t k = 0; k < 3; ++k) {
      force[k] += more_force[k];
      moment[k] += more_moment[k];
    }
  }
};

Vector3 sum(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

ex chi(const CodeLink& link, Chi kind) { return link.chi[index(kind)]; }

/// Writes the backward recursion. The wrench that a link hands over is kept in both views; what
/// stands in one of them is turned into the other only where the parent's frame is at an angle.
class Backward {
 public:
  Backward(Trace& trace, const CodeModel& code, const std::vector<LinkFrame>& frames,
           const std::vector<ChainMotion>& motions, const std::vector<LinkInertia>& inertia,
           const RneaForm& form)
      : trace_(trace),
        code_(code),
        frames_(frames),
        motions_(motions),
        inertia_(inertia),
        form_(form),
        link_(code.links.size() + 1),
        axis_(code.links.size() + 1) {}

  /// Acts on a link, about a point z on its axis from its origin.
  void add_wrench(int link, const Vector3& force, const Vector3& moment, const ex& z) {
    link_[static_cast<std::size_t>(link)].add(force, sum(moment, cross({0, 0, z}, force)));
  }

  /// @return force and moment of link j on its joint along the axis
  CarriedWrench write_link(int j) {
    trace_.section(
        fmt::format("backward, link {}: F force, N moment of the link about O{}; E, T with the "
                    "links it carries",
                    j, j));
    const std::size_t at = static_cast<std::size_t>(j);
    const bool in_axis = form_[at - 1].inertia == View::kAxis;
    CarriedWrench& own = in_axis ? axis_[at] : link_[at];
    write_own(j, own);

    CarriedWrench& link = link_[at];
    CarriedWrench& axis = axis_[at];
    join_along_axis(link, axis);
    const std::string mark = in_axis ? "A" : "";
    link.force = assign_vector(trace_, "E", j, link.force);
    link.moment = assign_vector(trace_, "T", j, link.moment);
    axis.force = assign_vector(trace_, "AE", j, axis.force);
    axis.moment = assign_vector(trace_, "AT", j, axis.moment);
    if (code_.link(j).parent != 0) hand_over(j);
    return link;
  }

 private:
  void write_own(int j, CarriedWrench& own) {
    const std::size_t at = static_cast<std::size_t>(j);
    const View view = form_[at - 1].inertia;
    const std::string mark = view == View::kAxis ? "A" : "";
    const LinkMotion& motion = motions_[at].in(view);
    const LinkInertia inertia = view == View::kAxis
                                    ? turned(trace_, j, inertia_[at], frames_[at].from_anchor)
                                    : inertia_[at];
    const Vector3 F = assign_vector(trace_, mark + "F", j, link_force(inertia, motion));
    const Vector3 N =
        assign_vector(trace_, mark + "N", j, link_moment(trace_, mark, j, inertia, motion));
    own.add(F, N);
  }

  /// The components along the axis are the same in both views: they stand in the link's.
  static void join_along_axis(CarriedWrench& link, CarriedWrench& axis) {
    link.force[2] += axis.force[2];
    link.moment[2] += axis.moment[2];
    axis.force[2] = axis.moment[2] = 0;
  }

  /// All of a vector in the axis frame, or in the link's.
  static Vector3 in_axis(const FrameRotation& turned_by, const Vector3& link, const Vector3& axis) {
    const Vector3 v = sum(turn(turned_by, link), axis);
    return {v[0], v[1], link[2]};
  }
  static Vector3 in_link(const FrameRotation& turned_by, const Vector3& link, const Vector3& axis) {
    const Vector3 v = sum(link, turn_back(turned_by, axis));
    return {v[0], v[1], link[2]};
  }

  void hand_over(int j) {
    const std::size_t at = static_cast<std::size_t>(j);
    const std::size_t to = static_cast<std::size_t>(code_.link(j).parent);
    const LinkFrame& frame = frames_[at];
    const LinkForm& form = form_[at - 1];
    const FrameRotation& turned_by = frame.from_anchor;
    const FrameRotation fixed = without_turn(frame.rotation);
    const auto name = [&](const char* quantity) { return fmt::format("{}_{}", quantity, j); };

    // of the parent: the view in which the vector arrives
    Vector3 force, moment;
    const bool force_in_axis = frame.parallel && form.force == View::kAxis;
    const bool moment_in_axis = frame.parallel && form.moment == View::kAxis;
    const CarriedWrench& link = link_[at];
    const CarriedWrench& axis = axis_[at];
    if (force_in_axis || !frame.parallel) {
      force = assign_vector(trace_, "EB", j, in_axis(turned_by, link.force, axis.force));
      force = to_parent(trace_, name("EA"), fixed, force);
    } else {
      force = assign_vector(trace_, "EB", j, in_link(turned_by, link.force, axis.force));
      force = to_parent(trace_, name("EA"), frame.rotation, force);
    }
    if (moment_in_axis || !frame.parallel) {
      moment = to_parent(trace_, name("TA"), fixed, in_axis(turned_by, link.moment, axis.moment));
    } else {
      moment = to_parent(trace_, name("TA"), frame.rotation,
                         in_link(turned_by, link.moment, axis.moment));
    }
    force = assign_vector(trace_, "FA", j, force);
    const Vector3 P = force_in_axis
                          ? assign_vector(trace_, "AP", j, turn(frames_[to].from_anchor, frame.P))
                          : frame.P;
    (force_in_axis ? axis_ : link_)[to].add(force, cross(P, force));
    (moment_in_axis ? axis_ : link_)[to].add({0, 0, 0}, moment);
  }

  Trace& trace_;
  const CodeModel& code_;
  const std::vector<LinkFrame>& frames_;
  const std::vector<ChainMotion>& motions_;
  const std::vector<LinkInertia>& inertia_;
  const RneaForm& form_;
  std::vector<CarriedWrench> link_, axis_;  // of the links that hang on each, in each view
};

}  // namespace

void write_rnea(Trace& trace, const CodeModel& code, const RneaTerms& terms, const RneaForm& form) {
  trace.section("parameters of the links");
  const std::vector<ex> shifts = origin_shifts(code, form);
  const std::vector<LinkInertia> inertia = write_inertia(trace, code, form, shifts);
  const std::vector<LinkFrame> frames = write_frames(trace, code, shifts);
  const std::vector<ChainMotion> motions =
      write_chain_motion(trace, code, frames, terms.motion, form);

  Backward backward(trace, code, frames, motions, inertia, form);
  if (terms.wrench) {
    const auto& w = code.wrench;
    const int link = code.wrench_link();
    backward.add_wrench(link, {-w[0], -w[1], -w[2]}, {-w[3], -w[4], -w[5]},
                        -shifts[static_cast<std::size_t>(link)]);
  }
  std::vector<ex> torque(code.links.size() + 1), load(code.coordinate_names.size());
  for (int j = code.size(); j >= 1; --j) {
    const CodeLink& link = code.link(j);
    ex& own = torque[static_cast<std::size_t>(j)];
    const CarriedWrench wrench = backward.write_link(j);
    own = link.type == JointType::kPrismatic ? wrench.force[2] : wrench.moment[2];
    if (link.coordinate >= 0) load[static_cast<std::size_t>(link.coordinate)] = own;
    if (terms.rotor && terms.motion.acceleration) own += chi(link, Chi::kIA) * link.ddq;
    if (terms.friction) own += friction_torque(link);
  }
  EffectTorques effects;
  effects.torque.assign(load.size(), 0);
  if (terms.effects && !code.effects.empty()) effects = write_effects(trace, code, load);
  trace.section("joint torques");
  for (int j = 1; j <= code.size(); ++j) {
    const CodeLink& link = code.link(j);
    if (link.coordinate < 0) continue;
    const ex& own = effects.torque[static_cast<std::size_t>(link.coordinate)];
    trace.output("tau", link.coordinate, torque[static_cast<std::size_t>(j)] + own);
  }
  for (const Output& output : effects.memory) {
    trace.output(output.array, output.index, output.value);
  }
}

void write_joint_wrenches(Trace& trace, const CodeModel& code) {
  // every force and moment in the links' own frames: nothing is left in the other view
  const RneaForm form(code.links.size(), LinkForm{.moment = View::kLink});
  const std::vector<ex> shifts = origin_shifts(code, form);
  const std::vector<LinkInertia> inertia = write_inertia(trace, code, form, shifts);
  const std::vector<LinkFrame> frames = write_frames(trace, code, shifts);
  const std::vector<ChainMotion> motions = write_chain_motion(trace, code, frames, {}, form);
  Backward backward(trace, code, frames, motions, inertia, form);
  const int joints = static_cast<int>(code.coordinate_names.size());
  for (int j = code.size(); j >= 1; --j) {
    const CarriedWrench wrench = backward.write_link(j);
    const int coordinate = code.link(j).coordinate;
    if (coordinate < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      trace.output("w", k * joints + coordinate, wrench.force[at]);
      trace.output("w", (3 + k) * joints + coordinate, wrench.moment[at]);
    }
  }
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/derivatives/derivatives.h"

#include <fmt/format.h>

#include <vector>

#include "gen/algorithms/bodies/link_inertia.h"
#include "gen/algorithms/bodies/moving_body.h"
#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Force and moment about the origin.
struct CompositeWrench {
  Vector3 f = {0, 0, 0};
  Vector3 n = {0, 0, 0};
};

/// What a composite body hands on to the joints that carry it.
struct Efforts {
  CompositeWrench inertia;   ///< for unit acceleration of its joint
  CompositeWrench velocity;  ///< per unit of its joint's rate
  CompositeWrench position;  ///< per unit of its joint's coordinate
  Vector3 coriolis;  ///< per unit of angular velocity of what carries it: torque of its joint
};

/// What the motion below a joint is, in its axis frame.
struct AxisMotion {
  ex x2, y2;    ///< twice the angular velocity across the axis
  ex x, y;      ///< angular velocity across the axis
  Vector3 a;    ///< U z: relative acceleration of a point at z
  ex VPx, VPy;  ///< acceleration of the origin across the axis, less gravity
};

class Derivatives {
 public:
  /// @param rates  2; with 1 the derivatives by velocities are half as large, and no others exist
  Derivatives(Trace& trace, const CodeModel& code, const RneaForm& form, int rates = 2)
      : trace_(trace), code_(code), form_(form), rates_(rates) {
    trace_.section("parameters of the links");
    const std::vector<ex> shifts = origin_shifts(code, form);
    inertia_ = write_inertia(trace, code, form, shifts);
    frames_ = write_frames(trace, code, shifts);
    motions_ = write_chain_motion(trace, code, frames_, {}, form);
    const std::size_t count = code.links.size() + 1;
    in_link_.resize(count);
    in_axis_.resize(count);
    steps_.resize(count);
    axis_.resize(count);
    const std::size_t n = code.coordinate_names.size();
    position_.assign(n * n, 0);
    velocity_.assign(n * n, 0);
    acceleration_.assign(n * n, 0);
    add_wrench(-shifts[at(code.wrench_link())]);
  }

  void write() {
    for (int j = 1; j <= code_.size(); ++j) write_axis(j);
    for (int j = code_.size(); j >= 1; --j) write_body(j);
    for (int i = code_.size(); i >= 1; --i) {
      if (code_.link(i).coordinate >= 0) write_joint(i);
    }
  }

  void add_drives() {
    for (const CodeLink& link : code_.links) {
      if (link.coordinate < 0) continue;
      element(velocity_, link.coordinate, link.coordinate) += link.chi[index(Chi::kFV)];
      element(acceleration_, link.coordinate, link.coordinate) += link.chi[index(Chi::kIA)];
    }
  }

  void output(const DerivativeOutputs& outputs) {
    trace_.section("derivatives");
    const auto write = [&](const std::string& array, const std::vector<ex>& values) {
      if (array.empty()) return;
      for (std::size_t k = 0; k < values.size(); ++k) {
        trace_.output(array, static_cast<int>(k), values[k]);
      }
    };
    write(outputs.position, position_);
    write(outputs.velocity, velocity_);
    write(outputs.acceleration, acceleration_);
  }

 private:
  ex assign(const char* name, int link, const ex& value) {
    return trace_.assign(fmt::format("{}_{}", name, link), value);
  }
  [[nodiscard]] bool revolute(int j) const { return code_.link(j).type == JointType::kRevolute; }
  ex& element(std::vector<ex>& matrix, int row, int column) {
    return matrix[at(row) * code_.coordinate_names.size() + at(column)];
  }

  /// The environment of the link that feels it; the origin stands at -z of the file's.
  void add_wrench(const ex& z) {
    const auto& w = code_.wrench;
    MovingBody& last = in_link_[at(code_.wrench_link())];
    last.f = {-w[0], -w[1], -w[2]};
    const Vector3 lever = cross({0, 0, z}, last.f);
    for (std::size_t k = 0; k < 3; ++k) last.n[k] = lever[k] - w[k + 3];
  }

  void write_axis(int j) {
    trace_.section(fmt::format("axis {}: what carries it turns and accelerates", j));
    const LinkFrame& frame = frames_[at(j)];
    const LinkMotion& anchor = motions_[at(frame.anchor)].link;
    const LinkMotion& own = motions_[at(j)].axis;
    AxisMotion& axis = axis_[at(j)];
    const FrameRotation fixed = without_turn(frame.from_anchor);
    Vector3 column;  // U of the anchor times the axis z
    for (std::size_t k = 0; k < 3; ++k) {
      column[k] = fixed.cos_alpha * anchor.U[k][2] - fixed.sin_alpha * anchor.U[k][1];
    }
    axis.a =
        assign_vector(trace_, "UZ", j, to_child(trace_, fmt::format("UA_{}", j), fixed, column));
    axis.x = own.W[0];
    axis.y = own.W[1];
    axis.x2 = assign("W21", j, rates_ * own.W[0]);
    axis.y2 = assign("W22", j, rates_ * own.W[1]);
    axis.VPx = own.VP[0];
    axis.VPy = own.VP[1];
    write_step(j);
  }

  /// From the parent's origin to the own, in the parent's axis frame if the axes are parallel, else
  /// in its link frame.
  void write_step(int j) {
    const CodeLink& link = code_.link(j);
    const LinkFrame& frame = frames_[at(j)];
    const ChainMotion& parent = motions_[at(link.parent)];
    PointStep& step = steps_[at(j)];
    const Vector3& W = frame.parallel ? parent.axis.W : parent.link.W;
    step.P = frame.P;
    if (frame.parallel) {
      step.P = assign_vector(trace_, "AP", j, turn(frames_[at(link.parent)].from_anchor, frame.P));
    }
    Vector3 twice;
    for (std::size_t k = 0; k < 3; ++k) {
      twice[k] = trace_.assign(
          fmt::format("W2{}{}_{}", k + 1, frame.parallel ? "A" : "L", link.parent), rates_ * W[k]);
    }
    step.V2 = cross(twice, step.P);
    if (link.type == JointType::kPrismatic) {
      const ex slide = assign("DQ2", j, rates_ * link.dq);
      step.V2[1] -= slide * frame.rotation.sin_alpha;
      step.V2[2] += slide * frame.rotation.cos_alpha;
    }
    step.V2 = assign_vector(trace_, "VR", j, step.V2);
  }

  void write_body(int j) {
    trace_.section(fmt::format("link {} with the links it carries", j));
    const LinkFrame& frame = frames_[at(j)];
    const bool own_in_axis = form_[at(j) - 1].inertia == View::kAxis;
    const LinkInertia& inertia = inertia_[at(j)];
    if (own_in_axis) {
      add(in_axis_[at(j)],
          write_rigid_body(trace_, {"A", j}, turned(trace_, j, inertia, frame.from_anchor),
                           motions_[at(j)].axis, rates_));
    } else {
      add(in_link_[at(j)],
          write_rigid_body(trace_, {"L", j}, inertia, motions_[at(j)].link, rates_));
    }
    const MovingBody in_link = assigned(trace_, {"L", j}, in_link_[at(j)]);
    MovingBody body = in_axis_[at(j)];
    add(body, turned_about_z(trace_, {"B", j}, frame.from_anchor, in_link));
    body = assigned(trace_, {"A", j}, body);
    in_axis_[at(j)] = body;

    const int parent = code_.link(j).parent;
    if (parent == 0) return;
    body = turned_about_x(trace_, {"X", j}, without_turn(frame.rotation), body);
    add((frame.parallel ? in_axis_ : in_link_)[at(parent)], moved(steps_[at(j)], body));
  }

  void write_joint(int i) {
    trace_.section(
        fmt::format("joint {}: efforts per unit of its coordinate, rate, acceleration, and its "
                    "torque's derivatives",
                    i));
    Efforts efforts = own_efforts(i);
    assign_efforts(i, i, "", efforts);
    for (int j = i;;) {
      if (code_.link(j).coordinate >= 0) meet(i, j, efforts);
      const int parent = code_.link(j).parent;
      if (parent == 0) break;
      efforts = carried(i, j, efforts);
      j = parent;
    }
  }

  Efforts own_efforts(int i) {
    const MovingBody& body = in_axis_[at(i)];
    const auto& [x2, y2, x, y, a, VPx, VPy] = axis_[at(i)];
    const auto& [K, h, m, G, p, f, n] = body;
    Efforts result;
    if (!revolute(i)) {
      result.inertia = {{0, 0, m}, {h[1], -h[0], 0}};
      result.coriolis = {p[1], -p[0], 0};
      const Vector3 twice = {y2, -x2, 0};
      result.velocity.f = {m * twice[0], m * twice[1], 0};
      result.velocity.n = cross(h, twice);
      result.position.f = {m * a[0], m * a[1], m * a[2]};
      result.position.n = cross(h, a);
      result.position.n[0] -= f[1];
      result.position.n[1] += f[0];
      return result;
    }
    const ex Jxx = assign("JXX", i, K[3] + K[5]), Jyy = assign("JYY", i, K[0] + K[5]),
             Jzz = assign("JZZ", i, K[0] + K[3]);
    const ex trace_xy = assign("GXY", i, G[0][0] + G[1][1]);
    result.inertia = {{-h[1], h[0], 0}, {-K[2], -K[4], Jzz}};
    result.coriolis = {-G[2][0], -G[2][1], trace_xy};
    result.velocity.n = {Jxx * y2 + K[1] * x2 - G[0][2], -K[1] * y2 - Jyy * x2 - G[1][2],
                         trace_xy - K[2] * y2 + K[4] * x2};
    result.velocity.f = {-p[1] - x2 * h[2], p[0] - y2 * h[2], y2 * h[1] + x2 * h[0]};
    result.position.n = {assign("GYZ", i, G[1][1] + G[2][2]) * y + G[0][1] * x + Jxx * a[0] -
                             K[1] * a[1] - K[2] * a[2] + h[2] * VPx - n[1],
                         -G[1][0] * y - assign("GXZ", i, G[0][0] + G[2][2]) * x - K[1] * a[0] +
                             Jyy * a[1] - K[4] * a[2] + h[2] * VPy + n[0],
                         -G[2][0] * y + G[2][1] * x - K[2] * a[0] - K[4] * a[1] + Jzz * a[2] -
                             h[0] * VPx - h[1] * VPy};
    result.position.f = cross(a, h);
    result.position.f[0] += -x * p[2] + m * VPy - f[1];
    result.position.f[1] += -y * p[2] - m * VPx + f[0];
    result.position.f[2] += y * p[1] + x * p[0];
    return result;
  }

  void assign_wrench(int i, int j, const std::string& name, CompositeWrench& wrench) {
    const auto vector = [&](const char* kind, Vector3& v) {
      for (std::size_t k = 0; k < 3; ++k) {
        v[k] = trace_.assign(fmt::format("{}{}{}_{}_{}", name, kind, k + 1, i, j), v[k]);
      }
    };
    vector("F", wrench.f);
    vector("N", wrench.n);
  }
  void assign_efforts(int i, int j, const std::string& mark, Efforts& efforts) {
    assign_wrench(i, j, mark + "I", efforts.inertia);
    assign_wrench(i, j, mark + "V", efforts.velocity);
    assign_wrench(i, j, mark + "Q", efforts.position);
    for (std::size_t k = 0; k < 3; ++k) {
      efforts.coriolis[k] =
          trace_.assign(fmt::format("{}B{}_{}_{}", mark, k + 1, i, j), efforts.coriolis[k]);
    }
  }

  /// Efforts of joint i from the axis frame of link j to that of its parent.
  Efforts carried(int i, int j, const Efforts& efforts) {
    const LinkFrame& frame = frames_[at(j)];
    const FrameRotation fixed = without_turn(frame.rotation);
    const int parent = code_.link(j).parent;
    const PointStep& step = steps_[at(j)];
    const auto turned_x = [&](const char* name, const Vector3& v) {
      return to_parent(trace_, fmt::format("{}X_{}_{}", name, i, j), fixed, v);
    };
    const auto carry = [&](const char* name, const CompositeWrench& from) {
      CompositeWrench to = {turned_x(name, from.f), turned_x(name, from.n)};
      const Vector3 lever = cross(step.P, to.f);
      for (std::size_t k = 0; k < 3; ++k) to.n[k] += lever[k];
      return to;
    };
    Efforts result;
    result.inertia = carry("I", efforts.inertia);
    result.velocity = carry("V", efforts.velocity);
    result.position = carry("Q", efforts.position);
    result.coriolis = turned_x("B", efforts.coriolis);
    const Vector3 drag = cross(step.V2, result.inertia.f);
    for (std::size_t k = 0; k < 3; ++k) result.coriolis[k] += drag[k];
    if (frame.parallel) {
      assign_efforts(i, parent, "", result);
      return result;
    }
    assign_efforts(i, parent, "L", result);
    const FrameRotation& rotation = frames_[at(parent)].from_anchor;
    for (CompositeWrench* wrench : {&result.inertia, &result.velocity, &result.position}) {
      wrench->f = turn(rotation, wrench->f);
      wrench->n = turn(rotation, wrench->n);
    }
    result.coriolis = turn(rotation, result.coriolis);
    assign_efforts(i, parent, "", result);
    return result;
  }

  /// Joint j carries joint i, or is joint i.
  void meet(int i, int j, const Efforts& efforts) {
    const auto& [x2, y2, x, y, a, VPx, VPy] = axis_[at(j)];
    const int own = code_.link(i).coordinate, below = code_.link(j).coordinate;
    const auto& [inertia, velocity, position, b] = efforts;
    const auto along = [&](const CompositeWrench& wrench) {
      return revolute(j) ? wrench.n[2] : wrench.f[2];
    };
    element(acceleration_, below, own) = element(acceleration_, own, below) = along(inertia);
    element(velocity_, below, own) = along(velocity);
    element(position_, below, own) = along(position);
    if (i == j) return;
    if (revolute(j)) {
      element(velocity_, own, below) = b[2] + inertia.n[0] * y2 - inertia.n[1] * x2;
      element(position_, own, below) = b[0] * y - b[1] * x + inertia.n[0] * a[0] +
                                       inertia.n[1] * a[1] + inertia.n[2] * a[2] +
                                       inertia.f[0] * VPy - inertia.f[1] * VPx;
    } else {
      element(velocity_, own, below) = inertia.f[0] * y2 - inertia.f[1] * x2;
      element(position_, own, below) =
          inertia.f[0] * a[0] + inertia.f[1] * a[1] + inertia.f[2] * a[2];
    }
  }

  Trace& trace_;
  const CodeModel& code_;
  const RneaForm& form_;
  int rates_ = 2;  ///< how many times velocities stand in what is called twice a velocity
  std::vector<LinkInertia> inertia_;
  std::vector<LinkFrame> frames_;
  std::vector<ChainMotion> motions_;
  std::vector<MovingBody> in_link_, in_axis_;  // of the links that hang on each, in each view
  std::vector<PointStep> steps_;
  std::vector<AxisMotion> axis_;
  std::vector<ex> position_, velocity_, acceleration_;
};

RneaForm euler_form(const CodeModel& code) {
  RneaForm form(code.links.size());
  for (LinkForm& link : form) link.euler_tensor = true;
  form.back().inertia = View::kAxis;
  return form;
}

}  // namespace

void write_derivatives(Trace& trace, const CodeModel& code, const DerivativeOutputs& outputs) {
  const RneaForm form = euler_form(code);
  Derivatives derivatives(trace, code, form);
  derivatives.write();
  derivatives.add_drives();
  derivatives.output(outputs);
}

void write_half_velocity_derivative(Trace& trace, const CodeModel& code, const std::string& array) {
  const RneaForm form = euler_form(code);
  Derivatives derivatives(trace, code, form, 1);
  derivatives.write();
  derivatives.output({.velocity = array});
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/derivatives/coriolis_matrix.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "gen/algorithms/bodies/standing_composites.h"
#include "gen/algorithms/derivatives/derivatives.h"
#include "gen/algorithms/kinematics/kinematics.h"
#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// What the composite body of a joint i hands on to the joints that carry it; r is the place of a
/// point against the origin where it stands.
struct CoriolisEfforts {
  Vector3 f = {0, 0, 0};  ///< integral of a dm, a the velocity of a point per unit rate of joint i
  Matrix3 D;              ///< integral of a r^T dm
  Vector3 F = {0, 0, 0};  ///< force of the acceleration that joint i adds, per unit of its rate
  Vector3 N = {0, 0, 0};  ///< and its moment
};

class CoriolisColumns {
 public:
  CoriolisColumns(Trace& trace, const CodeModel& code) : trace_(trace), code_(code) {
    trace.section("parameters of the links");
    RneaForm form(code.links.size());
    for (LinkForm& link : form) link.euler_tensor = true;
    const std::vector<ex> shifts = origin_shifts(code, form);
    const std::vector<LinkInertia> inertia = write_inertia(trace, code, form, shifts);
    frames_ = write_frames(trace, code, shifts);
    motions_ = write_chain_motion(
        trace, code, frames_, {.velocity = true, .acceleration = false, .gravity = false}, form);
    bodies_ = write_standing_composites(trace, code, frames_, inertia).in_axis;
    elements_.assign(code.coordinate_names.size() * code.coordinate_names.size(), 0);
  }

  void write() {
    for (int i = code_.size(); i >= 1; --i) {
      if (code_.link(i).coordinate >= 0) write_joint(i);
    }
    trace_.section("Coriolis matrix");
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      trace_.output("C", static_cast<int>(k), elements_[k]);
    }
  }

 private:
  [[nodiscard]] bool revolute(int j) const { return code_.link(j).type == JointType::kRevolute; }
  ex& element(int row, int column) {
    return elements_[at(code_.link(row).coordinate) * code_.coordinate_names.size() +
                     at(code_.link(column).coordinate)];
  }

  /// w_(j-1) + w_j of a revolute joint, 2 w_j of a prismatic one, in the joint's axis frame.
  Vector3 velocity_sum(int j) {
    const Vector3& W = motions_[at(j)].axis.W;
    const auto assign = [&](int k, const ex& value) {
      return trace_.assign(fmt::format("WS{}_{}", k, j), value);
    };
    const ex along = revolute(j) ? assign(3, 2 * W[2] - code_.link(j).dq) : ex(0);
    return {assign(1, 2 * W[0]), assign(2, 2 * W[1]), along};
  }

  CoriolisEfforts own_efforts(int i) {
    const auto& [K, h, m, G, p, f, n] = bodies_[at(i)];
    const Vector3 w = velocity_sum(i);
    CoriolisEfforts result;
    if (!revolute(i)) {
      result.f = {0, 0, m};
      result.D[2] = h;
      result.F = {m * w[1], -m * w[0], 0};
      result.N = cross(h, {w[1], -w[0], 0});
      return result;
    }
    // the acceleration of r is z (w . r) - (w . z) r
    result.f = {-h[1], h[0], 0};
    result.D = {{{-K[1], -K[3], -K[4]}, {K[0], K[1], K[2]}, {0, 0, 0}}};
    result.F = {-w[2] * h[0], -w[2] * h[1], w[0] * h[0] + w[1] * h[1]};
    result.N = {w[0] * K[1] + w[1] * K[3] + w[2] * K[4], -w[2] * K[2] - w[0] * K[0] - w[1] * K[1],
                0};
    return result;
  }

  void assign(int i, int j, const std::string& mark, CoriolisEfforts& efforts) {
    const auto vector = [&](const std::string& name, Vector3& v) {
      for (std::size_t k = 0; k < 3; ++k) {
        v[k] = trace_.assign(fmt::format("{}{}{}_{}_{}", mark, name, k + 1, i, j), v[k]);
      }
    };
    vector("V", efforts.f);
    for (std::size_t k = 0; k < 3; ++k) vector("D" + std::to_string(k + 1), efforts.D[k]);
    vector("F", efforts.F);
    vector("N", efforts.N);
  }

  /// Efforts of joint i from the axis frame of link j to that of its parent.
  CoriolisEfforts carried(int i, int j, const CoriolisEfforts& efforts) {
    const LinkFrame& frame = frames_[at(j)];
    const FrameRotation fixed = without_turn(frame.rotation);
    const int parent = code_.link(j).parent;
    const Vector3 P = write_step_to_parent(trace_, code_, frames_, j);
    const auto turned_x = [&](const char* name, const Vector3& v) {
      return to_parent(trace_, fmt::format("{}X_{}_{}", name, i, j), fixed, v);
    };
    CoriolisEfforts result;
    result.f = turned_x("V", efforts.f);
    result.D = turned_about_x(trace_, fmt::format("DX_{}_{}", i, j), fixed, efforts.D);
    result.F = turned_x("F", efforts.F);
    result.N = turned_x("N", efforts.N);
    const Vector3 lever = cross(P, result.F);
    for (std::size_t k = 0; k < 3; ++k) {
      result.N[k] += lever[k];
      for (std::size_t l = 0; l < 3; ++l) result.D[k][l] += result.f[k] * P[l];
    }
    if (frame.parallel) {
      assign(i, parent, "", result);
      return result;
    }
    assign(i, parent, "L", result);
    const FrameRotation& rotation = frames_[at(parent)].from_anchor;
    for (Vector3* v : {&result.f, &result.F, &result.N}) *v = turn(rotation, *v);
    result.D = turned_about_z(trace_, fmt::format("DZ_{}_{}", i, j), rotation, result.D);
    assign(i, parent, "", result);
    return result;
  }

  void write_joint(int i) {
    trace_.section(fmt::format("joint {}: forces of its motion on the joints that carry it", i));
    CoriolisEfforts efforts = own_efforts(i);
    assign(i, i, "", efforts);
    for (int j = i;;) {
      if (code_.link(j).coordinate >= 0) meet(i, j, efforts);
      const int parent = code_.link(j).parent;
      if (parent == 0) break;
      efforts = carried(i, j, efforts);
      j = parent;
    }
  }

  /// Joint j carries joint i, or is joint i.
  void meet(int i, int j, const CoriolisEfforts& efforts) {
    const auto& [f, D, F, N] = efforts;
    element(j, i) = revolute(j) ? N[2] : F[2];
    if (i == j) return;
    const Vector3 w = velocity_sum(j);
    element(i, j) = revolute(j) ? w[0] * D[2][0] + w[1] * D[2][1] - w[2] * (D[0][0] + D[1][1])
                                : f[0] * w[1] - f[1] * w[0];
  }

  Trace& trace_;
  const CodeModel& code_;
  std::vector<LinkFrame> frames_;
  std::vector<ChainMotion> motions_;
  std::vector<MovingBody> bodies_;
  std::vector<ex> elements_;
};

}  // namespace

void write_coriolis_matrix(Trace& trace, const CodeModel& code) {
  write_half_velocity_derivative(trace, code, "C");
}

void write_coriolis_matrix_fast(Trace& trace, const CodeModel& code) {
  CoriolisColumns(trace, code).write();
}

}  // namespace dyngen

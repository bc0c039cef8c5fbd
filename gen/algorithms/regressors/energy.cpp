// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/regressors/energy.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/kinematics/origin_slides.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// What the energy of a link depends on, in its frame.
struct LinkState {
  Vector3 W = {0, 0, 0};        ///< angular velocity
  Vector3 V = {0, 0, 0};        ///< velocity of the origin
  Vector3 G = {0, 0, 0};        ///< acceleration against gravity
  ex GO = 0;                    ///< G . O: potential energy per unit mass at the origin
  ex rate = 0;                  ///< angular velocity about z against the anchor
  bool rides_on_anchor = true;  ///< V is the anchor's
};

class EnergyWriter {
 public:
  EnergyWriter(Trace& trace, const CodeModel& code, const OriginSlides& slides)
      : trace_(trace), code_(code), slides_(slides), frames_(write_frames(trace, code)) {
    slide_origins(trace, code, slides, frames_);
  }

  void write() {
    states_.resize(frames_.size());
    states_[0].G = code_.gravity;
    for (int j = 1; j <= code_.size(); ++j) write_state(j);
    trace_.section("energy per unit parameter");
    for (std::size_t c = 0; c < code_.beta_columns.size(); ++c) {
      trace_.output("H", static_cast<int>(c), entry(code_.beta_columns[c]));
    }
  }

 private:
  Vector3 turn(const std::string& name, int link, const FrameRotation& rotation, const Vector3& v) {
    return to_child(trace_, fmt::format("{}A2_{}", name, link), rotation, v);
  }

  void write_state(int j) {
    const CodeLink& link = code_.link(j);
    const LinkFrame& frame = frames_[static_cast<std::size_t>(j)];
    const LinkState& parent = states_[static_cast<std::size_t>(link.parent)];
    const LinkState& anchor = states_[static_cast<std::size_t>(frame.anchor)];
    LinkState& own = states_[static_cast<std::size_t>(j)];
    const bool prismatic = link.type == JointType::kPrismatic;
    trace_.section(fmt::format(
        "link {}: W angular velocity, V velocity of O{}, G acceleration against gravity, in frame "
        "{}",
        j, j, j));

    const ex own_rate = prismatic ? ex(0) : link.dq;
    own.rate = frame.parallel ? frame.z_sign * parent.rate + own_rate : own_rate;
    Vector3 W = turn("W", j, frame.from_anchor, anchor.W);
    W[2] =
        W[2].is_zero() || !frame.parallel ? W[2] + own.rate : frame.z_sign * parent.W[2] + own_rate;
    own.W = assign_vector(trace_, "W", j, W);
    own.G = assign_vector(trace_, "G", j, turn("G", j, frame.from_anchor, anchor.G));
    const Vector3& P = frame.P;
    own.GO = trace_.assign(fmt::format("GO_{}", j), parent.GO + parent.G[0] * P[0] +
                                                        parent.G[1] * P[1] + parent.G[2] * P[2]);

    Vector3 VA = cross(parent.W, P);
    const bool shifted = !VA[0].is_zero() || !VA[1].is_zero() || !VA[2].is_zero();
    own.rides_on_anchor = !shifted && !prismatic && (!frame.parallel || parent.rides_on_anchor);
    const bool from_anchor = frame.parallel && own.rides_on_anchor;
    const LinkState& carrier = from_anchor ? anchor : parent;
    for (std::size_t k = 0; k < 3; ++k) VA[k] += carrier.V[k];
    VA = assign_vector(trace_, "VA", j, VA);
    Vector3 V = turn("V", j, from_anchor ? frame.from_anchor : frame.rotation, VA);
    if (prismatic) V[2] += link.dq;
    own.V = assign_vector(trace_, "V", j, V);
  }

  [[nodiscard]] ex first_moment(const LinkState& state, std::size_t k) const {
    return cross(state.V, state.W)[k] + state.G[k];
  }

  [[nodiscard]] ex entry(const Column& column) const {
    const LinkState& state = states_[static_cast<std::size_t>(column.link)];
    const ex& slide = slides_[static_cast<std::size_t>(column.link)];
    const Vector3& W = state.W;
    const Vector3& V = state.V;
    const CodeLink& link = code_.link(column.link);
    switch (column.kind) {
      case Chi::kXX:
        return W[0] * W[0] / 2;
      case Chi::kYY:
        return W[1] * W[1] / 2;
      case Chi::kZZ:
        return W[2] * W[2] / 2;
      case Chi::kXY:
        return W[0] * W[1];
      case Chi::kXZ:
        return W[0] * W[2];
      case Chi::kYZ:
        return W[1] * W[2];
      case Chi::kMX:
        return first_moment(state, 0) -
               slide * trace_.assign(product_name("W13", column), W[0] * W[2]);
      case Chi::kMY:
        return first_moment(state, 1) -
               slide * trace_.assign(product_name("W23", column), W[1] * W[2]);
      case Chi::kMZ:
        return first_moment(state, 2);
      case Chi::kM:
        return (V[0] * V[0] + V[1] * V[1] + V[2] * V[2]) / 2 + state.GO;
      case Chi::kIA:
        return link.dq * link.dq / 2;
      default:
        return 0;
    }
  }

  [[nodiscard]] static std::string product_name(const char* product, const Column& column) {
    return fmt::format("{}_{}", product, column.link);
  }

  Trace& trace_;
  const CodeModel& code_;
  const OriginSlides& slides_;
  std::vector<LinkFrame> frames_;
  std::vector<LinkState> states_;
};

}  // namespace

void write_energy_regressor(Trace& trace, const CodeModel& code) {
  const std::vector<bool> may_slide = links_that_may_slide(code, code.beta_columns);
  const OriginSlides slides = choose_slides(code, may_slide, [&](const OriginSlides& trial) {
    Trace scratch(&code.inputs);
    EnergyWriter(scratch, code, trial).write();
    scratch.drop_dead_code();
    return scratch.count().total();
  });
  EnergyWriter(trace, code, slides).write();
}

void write_power(Trace& trace, const CodeModel& code) {
  for (std::size_t c = 0; c < code.beta_columns.size(); ++c) {
    const Column& column = code.beta_columns[c];
    const ex& dq = code.link(column.link).dq;
    ex power = 0;
    if (column.kind == Chi::kFV) power = dq * dq;
    if (column.kind == Chi::kFS) power = dq * GiNaC::csgn(dq);
    if (column.kind == Chi::kOFF) power = dq;
    trace.output("P", static_cast<int>(c), power);
  }
}

}  // namespace dyngen

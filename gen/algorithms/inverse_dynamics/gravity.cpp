// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/inverse_dynamics/gravity.h"

#include <fmt/format.h>

#include <vector>

#include "gen/algorithms/code_model/link_form.h"
#include "gen/algorithms/inverse_dynamics/form_search.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/symbols/index.h"

namespace dyngen {
namespace {

using GiNaC::ex;

constexpr int kTrials = 40;

/// How the torque of a link's joint is written.
struct TorqueForm {
  View view = View::kAxis;
  bool sums_torques = true;  ///< of parallel joints, rather than their first moments
};

class Gravity {
 public:
  Gravity(Trace& trace, const CodeModel& code, const std::vector<TorqueForm>& form)
      : trace_(trace), code_(code), form_(form), frames_(write_frames(trace, code)) {}

  void write() {
    trace_.section("VP acceleration of a standing link, -g, in its frame");
    const std::size_t count = code_.links.size() + 1;
    in_link_.resize(count);
    in_axis_.resize(count);
    in_link_[0] = code_.gravity;
    for (int j = 1; j <= code_.size(); ++j) write_acceleration(j);
    const Vector3 none = {0, 0, 0};
    moments_.assign(count, none);
    chain_moments_.assign(count, none);
    masses_.assign(count, 0);
    torques_.assign(count, 0);
    for (int j = code_.size(); j >= 1; --j) write_link(j);
    trace_.section("joint torques");
    for (int j = 1; j <= code_.size(); ++j) {
      const CodeLink& link = code_.link(j);
      if (link.coordinate < 0) continue;
      const bool revolute = link.type == JointType::kRevolute;
      trace_.output("tau", link.coordinate,
                    revolute ? torques_[at(j)] : masses_[at(j)] * in_link_[at(j)][2]);
    }
  }

 private:
  void write_acceleration(int j) {
    const LinkFrame& frame = frames_[at(j)];
    in_axis_[at(j)] =
        assign_vector(trace_, "AVP", j,
                      to_child(trace_, fmt::format("VPA2_{}", j), without_turn(frame.from_anchor),
                               in_link_[at(frame.anchor)]));
    in_link_[at(j)] = assign_vector(trace_, "VP", j, turn_back(frame.from_anchor, in_axis_[at(j)]));
  }

  void write_link(int j) {
    trace_.section(fmt::format("link {}: MS first moments with the links it carries", j));
    const CodeLink& link = code_.link(j);
    const LinkFrame& frame = frames_[at(j)];
    const TorqueForm& form = form_[at(j) - 1];
    const auto chi = [&](Chi kind) { return link.chi[index(kind)]; };
    ex& mass = masses_[at(j)];
    mass = trace_.assign(fmt::format("M_{}", j), mass + chi(Chi::kM));
    const std::array<ex, 3> own = {chi(Chi::kMX), chi(Chi::kMY), chi(Chi::kMZ)};
    Vector3 MS = moments_[at(j)];
    for (std::size_t k = 0; k < 3; ++k) MS[k] += own[k];
    MS = assign_vector(trace_, "MS", j, MS);
    const Vector3 turned = assign_vector(trace_, "AMS", j, turn(frame.from_anchor, MS));
    Vector3 total = chain_moments_[at(j)];
    for (std::size_t k = 0; k < 3; ++k) total[k] += turned[k];
    total = assign_vector(trace_, "AMT", j, total);

    if (form.view == View::kLink) {
      torques_[at(j)] += cross(MS, in_link_[at(j)])[2];
    } else if (form.sums_torques) {
      torques_[at(j)] += cross(turned, in_axis_[at(j)])[2];
    } else {
      torques_[at(j)] = cross(total, in_axis_[at(j)])[2];
    }
    torques_[at(j)] = trace_.assign(fmt::format("T3_{}", j), torques_[at(j)]);

    if (link.parent == 0) return;
    const std::size_t to = at(link.parent);
    masses_[to] += mass;
    for (std::size_t k = 0; k < 3; ++k) moments_[to][k] += frame.P[k] * mass;
    const Vector3 handed =
        to_parent(trace_, fmt::format("MSA_{}", j), without_turn(frame.rotation), total);
    Vector3& target = (frame.parallel ? chain_moments_ : moments_)[to];
    for (std::size_t k = 0; k < 3; ++k) target[k] += handed[k];
    if (frame.parallel) torques_[to] += frame.z_sign * torques_[at(j)];
  }

  Trace& trace_;
  const CodeModel& code_;
  const std::vector<TorqueForm>& form_;
  std::vector<LinkFrame> frames_;
  std::vector<Vector3> in_link_, in_axis_;        // VP
  std::vector<Vector3> moments_, chain_moments_;  // in the link's frame; in the axis frame
  std::vector<ex> masses_, torques_;
};

}  // namespace

void write_gravity_torque(Trace& trace, const CodeModel& code) {
  using Forms = std::vector<TorqueForm>;
  const auto cost = [&](const Forms& forms) {
    Trace trial = trace;
    Gravity(trial, code, forms).write();
    trial.drop_dead_code();
    return trial.count().total();
  };
  FormSearch<TorqueForm> search(cost, kTrials);
  search.try_forms(Forms(code.links.size()));
  search.descend([](const Forms& forms, std::size_t at) {
    Forms others;
    for (const TorqueForm& form :
         {TorqueForm{View::kLink, true}, {View::kAxis, true}, {View::kAxis, false}}) {
      if (form.view != forms[at].view || form.sums_torques != forms[at].sums_torques) {
        others.push_back(form);
      }
    }
    return others;
  });
  Gravity(trace, code, search.best()).write();
}

}  // namespace dyngen

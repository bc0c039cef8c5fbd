// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/inverse_dynamics/friction.h"

#include "gen/algorithms/inverse_dynamics/effects.h"
#include "gen/algorithms/inverse_dynamics/rnea_search.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Torque of the rigid links on each coordinate; empty if no effect reads it.
std::vector<ex> write_load(Trace& trace, const CodeModel& code) {
  if (!effects_read(code, {"tau_load"})) return {};
  RneaTerms terms;
  terms.rotor = terms.friction = false;
  write_shortest_rnea(trace, code, terms);
  std::vector<ex> load(code.coordinate_names.size(), 0);
  for (const Output& output : trace.take_outputs()) {
    load[static_cast<std::size_t>(output.index)] = output.value;
  }
  return load;
}

void write(Trace& trace, const CodeModel& code, bool friction) {
  EffectTorques effects;
  effects.torque.assign(code.coordinate_names.size(), 0);
  if (!code.effects.empty()) {
    effects = write_effects(trace, code, write_load(trace, code));
    trace.section("joint torques");
  }
  for (const CodeLink& link : code.links) {
    if (link.coordinate < 0) continue;
    const ex& own = effects.torque[static_cast<std::size_t>(link.coordinate)];
    trace.output("tau", link.coordinate, friction ? friction_torque(link) + own : own);
  }
  for (const Output& output : effects.memory) {
    trace.output(output.array, output.index, output.value);
  }
}

}  // namespace

ex friction_torque(const CodeLink& link) {
  ex torque = link.chi[index(Chi::kFV)] * link.dq + link.chi[index(Chi::kOFF)];
  const ex FS = link.chi[index(Chi::kFS)];
  if (!FS.is_zero()) torque += FS * GiNaC::csgn(link.dq);
  return torque;
}

void write_friction(Trace& trace, const CodeModel& code) { write(trace, code, true); }

void write_effect_torque(Trace& trace, const CodeModel& code) { write(trace, code, false); }

std::string why_no_effects(const CodeModel& code) {
  return code.effects.empty() ? "the robot has no effect that runs in a controller" : "";
}

std::vector<std::string_view> friction_inputs(const CodeModel& code) {
  if (effects_read(code, {"q", "qdd", "tau_load"})) return {"q", "dq", "ddq"};
  return {"dq"};
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/functions/functions.h"

#include <algorithm>

#include "gen/algorithms/rnea.h"

namespace dyngen {
namespace {

void write_id(Trace& trace, const CodeModel& code) { write_rnea(trace, code, RneaTerms{}); }

void write_gravity(Trace& trace, const CodeModel& code) {
  RneaTerms terms;
  terms.motion = {.velocity = false, .acceleration = false, .gravity = true};
  terms.rotor = terms.friction = false;
  write_rnea(trace, code, terms);
}

void write_coriolis(Trace& trace, const CodeModel& code) {
  RneaTerms terms;
  terms.motion = {.velocity = true, .acceleration = false, .gravity = false};
  terms.rotor = terms.friction = false;
  write_rnea(trace, code, terms);
}

}  // namespace

const std::vector<FunctionSpec>& function_catalogue() {
  static const std::vector<FunctionSpec> kCatalogue = {
      {"id",
       {"q", "dq", "ddq"},
       "tau",
       "tau = M(q) ddq + c(q, dq) + g(q) + friction: inverse dynamics by customised Newton-Euler "
       "[KD02, ch. 9].",
       write_id},
      {"gravity", {"q"}, "tau", "tau = g(q): the torque that holds the arm still.", write_gravity},
      {"coriolis",
       {"q", "dq"},
       "tau",
       "tau = c(q, dq): Coriolis and centrifugal torque.",
       write_coriolis},
      {"friction",
       {"dq"},
       "tau",
       "tau = FS sign(dq) + FV dq + OFF: friction and offset torque, sign(0) = 0.",
       write_friction},
  };
  return kCatalogue;
}

const FunctionSpec* find_function(std::string_view name) {
  const auto& catalogue = function_catalogue();
  const auto it = std::find_if(catalogue.begin(), catalogue.end(),
                               [&](const FunctionSpec& spec) { return spec.name == name; });
  return it == catalogue.end() ? nullptr : &*it;
}

RobotFunction write_function(const FunctionSpec& spec, const CodeModel& code) {
  RobotFunction function{&spec, Trace(&code.inputs)};
  spec.write(function.trace, code);
  function.trace.drop_dead_code();
  return function;
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/forward_dynamics/forward_dynamics.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "gen/algorithms/inverse_dynamics/rnea_search.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/mass_matrix/determinacy.h"
#include "gen/algorithms/mass_matrix/mass_matrix.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Of each coordinate: those that carry it, the nearest first.
std::vector<std::vector<std::size_t>> carriers(const CodeModel& code) {
  std::vector<std::vector<std::size_t>> result(code.coordinate_names.size());
  for (const CodeLink& link : code.links) {
    if (link.coordinate < 0) continue;
    for (int i = link.parent; i != 0; i = code.link(i).parent) {
      const int coordinate = code.link(i).coordinate;
      if (coordinate < 0) continue;
      result[static_cast<std::size_t>(link.coordinate)].push_back(
          static_cast<std::size_t>(coordinate));
    }
  }
  return result;
}

/// tau - c - g - friction - effects
std::vector<ex> write_net_torque(Trace& trace, const CodeModel& code) {
  RneaTerms terms;
  terms.motion.acceleration = false;
  terms.effects = true;
  write_shortest_rnea(trace, code, terms);
  std::vector<ex> torque(code.coordinate_names.size(), 0);
  for (const Output& output : trace.take_outputs()) {
    if (output.array == "tau") {
      torque[static_cast<std::size_t>(output.index)] = output.value;
    } else {  // what effects remember
      trace.output(output.array, output.index, output.value);
    }
  }
  trace.section(code.effects.empty()
                    ? "torque that accelerates: tau less Coriolis, gravity and friction"
                    : "torque that accelerates: tau less Coriolis, gravity, friction and effects");
  for (const CodeLink& link : code.links) {
    if (link.coordinate < 0) continue;
    ex& own = torque[static_cast<std::size_t>(link.coordinate)];
    own = trace.assign(fmt::format("E_{}", link.coordinate + 1), link.tau - own);
  }
  return torque;
}

}  // namespace

std::string why_no_forward_dynamics(const CodeModel& code) {
  if (effects_read(code, {"qdd", "tau_load"})) {
    return "an effect reads accelerations or the torque of the links: its torque is known when the "
           "accelerations are";
  }
  const int joint = undetermined_joint(code);
  if (joint == 0) return {};
  return fmt::format(
      "joint {}, with the joints that it carries, has a motion that moves neither "
      "mass nor rotor: accelerations are not determined",
      joint);
}

void write_forward_dynamics(Trace& trace, const CodeModel& code) {
  std::vector<ex> b = write_net_torque(trace, code);
  UpperTriangle H = write_mass_elements(trace, code, write_frames(trace, code));
  const std::vector<std::vector<std::size_t>> lambda = carriers(code);
  const std::size_t n = H.size();
  const auto name = [](const char* stem, std::size_t i, std::size_t j) {
    return fmt::format("{}_{}_{}", stem, i + 1, j + 1);
  };
  const auto name_of = [](const char* stem, std::size_t i) {
    return fmt::format("{}_{}", stem, i + 1);
  };

  trace.section("M = L^T D L from the tips to the base: DI = 1/D, B = L^-T torque");
  UpperTriangle L(n, std::vector<ex>(n, 0));
  std::vector<ex> y(n);
  for (std::size_t k = n; k-- > 0;) {
    const ex inverse = trace.assign(name_of("DI", k), GiNaC::pow(H[k][k], -1));
    for (const std::size_t i : lambda[k])
      L[i][k] = trace.assign(name("L", k, i), H[i][k] * inverse);
    for (const std::size_t i : lambda[k]) {
      for (const std::size_t j : lambda[k]) {
        if (j > i) continue;
        H[j][i] = trace.assign(name("H", j, i), H[j][i] - L[i][k] * H[j][k]);
      }
      b[i] = trace.assign(name_of("B", i), b[i] - L[i][k] * b[k]);
    }
    y[k] = trace.assign(name_of("Y", k), b[k] * inverse);
  }
  trace.section("L ddq = D^-1 B, from the base to the tips");
  std::vector<ex> ddq(n);
  for (std::size_t k = 0; k < n; ++k) {
    ddq[k] = y[k];
    for (const std::size_t i : lambda[k]) ddq[k] -= L[i][k] * ddq[i];
    ddq[k] = trace.assign(name_of("A", k), ddq[k]);
  }
  for (std::size_t k = 0; k < n; ++k) trace.output("ddq", static_cast<int>(k), ddq[k]);
}

}  // namespace dyngen

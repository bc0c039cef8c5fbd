// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/code_model/code_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;
using BodyValues = std::array<ex, kInertialCount>;

constexpr const char* kKeepStandard = "--no-regroup keeps the parameters of each body";

/// The first unknown parameter of the file that the value needs; empty if there is none.
std::string unknown_parameter(const ex& value, const SymbolicRobot& robot) {
  for (const FileSymbol& entry : robot.parameters) {
    if (!entry.known && value.has(entry.symbol)) return entry.name;
  }
  return {};
}

/// The bodies in the numbers of the file; lengths that are known at run time only are read from
/// chi. @return why there are none; empty if there are
std::string numbers_of_bodies(const CodeModel& code, const SymbolicRobot& robot,
                              std::vector<BodyValues>& bodies) {
  GiNaC::exmap lengths;
  for (const FileSymbol& length : robot.geometry) {
    const SymbolInfo* entry = code.inputs.find_name(length.name);
    if (entry != nullptr) lengths[length.symbol] = entry->symbol;
  }
  for (const SymbolicLink& link : robot.links) {
    BodyValues body;
    for (std::size_t k = 0; k < kInertialCount; ++k) {
      const ex value = with_known_values(link.chi[k], robot);
      const std::string unknown = unknown_parameter(value, robot);
      if (!unknown.empty()) {
        return fmt::format("{} is unknown, and base parameters do not show it; {}", unknown,
                           kKeepStandard);
      }
      body[k] = value.subs(lengths, GiNaC::subs_options::no_pattern);
    }
    bodies.push_back(std::move(body));
  }
  return {};
}

/// A body on the last link, from the argument's frame to the link's.
void add_payload_to(BodyValues& body, const CodeModel& code) {
  const CodeLink& last = code.links.back();
  BodyValues payload;
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    payload[k] = code.inputs.find_name(fmt::format("payload_{}", kChiNames[k]))->symbol;
  }
  payload = move_to_parent(payload, last.tip_alpha, last.tip_d, 0, 0);
  for (std::size_t k = 0; k < kInertialCount; ++k) body[k] += payload[k];
}

/// Why the parameters are not those of bodies with mass; empty if they may be.
std::string why_no_masses(const std::vector<BodyValues>& bodies) {
  ex total = 0;
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    const ex& mass = bodies[j][index(Chi::kM)];
    total += mass;
    const auto moments = bodies[j].begin() + static_cast<std::ptrdiff_t>(index(Chi::kMX));
    const bool any = std::any_of(moments, moments + 3, [](const ex& v) { return !v.is_zero(); });
    if (mass.is_zero() && any) {
      return fmt::format("link {} has first moments and no mass", j + 1);
    }
  }
  return total.expand().is_zero() ? "the mass of the whole robot is 0" : "";
}

}  // namespace

void add_bodies(CodeModel& code, const SymbolicRobot& robot, bool regrouped,
                ParameterMeaning meaning) {
  CodeBodies& bodies = code.bodies;
  bodies = {};
  bodies.why_absent.clear();
  if (meaning == ParameterMeaning::kBase) {
    bodies.why_absent =
        "the numbers of the robot file are base parameters, sums over several bodies";
  } else if (!regrouped) {
    for (const CodeLink& link : code.links) {
      BodyValues body;
      std::copy_n(link.chi.begin(), kInertialCount, body.begin());
      bodies.links.push_back(std::move(body));
    }
  } else if (code.options.parameters == ParameterMode::kRuntime) {
    bodies.why_absent =
        fmt::format("chi holds base parameters, sums over several bodies; {}", kKeepStandard);
  } else {
    bodies.why_absent = numbers_of_bodies(code, robot, bodies.links);
    if (bodies.why_absent.empty() && code.options.payload) {
      add_payload_to(bodies.links.back(), code);
    }
  }
  if (bodies.why_absent.empty()) bodies.why_absent = why_no_masses(bodies.links);
  if (!bodies.why_absent.empty()) bodies.links.clear();
}

}  // namespace dyngen

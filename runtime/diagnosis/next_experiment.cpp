// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/next_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace dyngen::runtime {
namespace {

/// A motion and the families that it tells from all others.
struct Archetype {
  const char* motion;
  std::set<std::string> families;
};

/// The first that knows one of the names is asked for: those that split most come first.
const std::array<Archetype, 6>& archetypes() {
  static const std::array<Archetype, 6> kArchetypes = {{
      {"reversals within reversals, at three speeds: what lives on distance looks the same at all",
       {"presliding", "backlash"}},
      {"constant slow speeds both ways, far from reversals", {"stribeck", "nonlinear_viscous"}},
      {"the same postures with two payloads, both ways",
       {"load_friction", "torque_saturation", "torque_gain", "position_friction"}},
      {"the same motion cold and warm", {"thermal_drift", "gain_drift", "sensor_drift"}},
      {"small and fast, up to half of the lowest resonance",
       {"time_delay", "actuator_lag", "joint_elasticity", "link_flexibility"}},
      {"one joint at a time, slowly over its whole range, both ways",
       {"torque_ripple", "kinematic_ripple", "cable", "gravity_spring", "joint_coupling"}},
  }};
  return kArchetypes;
}

}  // namespace

NextExperiment next_experiment(const std::vector<Finding>& findings) {
  NextExperiment next;
  const auto open = std::find_if(findings.begin(), findings.end(),
                                 [](const Finding& finding) { return finding.aliases.size() > 1; });
  if (open == findings.end()) return next;
  next.joint = open->effect.joint;
  next.families = open->aliases;
  for (const Archetype& archetype : archetypes()) {
    const auto knows = [&](const std::string& family) {
      return archetype.families.contains(family);
    };
    if (!std::any_of(next.families.begin(), next.families.end(), knows)) continue;
    next.archetype = archetype.motion;
    break;
  }
  if (next.archetype.empty()) next.archetype = archetypes().back().motion;
  const std::vector<std::string> others(next.families.begin() + 1, next.families.end());
  next.purpose = fmt::format(
      "separate {} from {}{}: {}", next.families.front(), fmt::join(others, " and "),
      next.joint >= 0 ? fmt::format(" on joint {}", next.joint + 1) : "", next.archetype);
  return next;
}

}  // namespace dyngen::runtime

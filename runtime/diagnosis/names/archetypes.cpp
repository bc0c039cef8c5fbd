// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/archetypes.h"

#include <algorithm>

namespace dyngen::runtime {

const std::vector<ArchetypeWords>& archetypes() {
  static const std::vector<ArchetypeWords> kArchetypes = {
      {Archetype::kNestedReversals,
       "reversals within reversals, at three speeds: what lives on distance looks the same at all",
       "",
       {"presliding", "backlash"}},
      {Archetype::kSlowBothWays,
       "constant slow speeds both ways, far from reversals",
       "",
       {"stribeck", "nonlinear_viscous"}},
      {Archetype::kTwoLoads,
       "the same way in two postures and with two payloads, both ways",
       "Run it twice if you can, without and with a payload: the load changes and the position "
       "does not.",
       {"load_friction", "torque_saturation", "torque_gain", "position_friction"}},
      {Archetype::kColdAndWarm,
       "slowly, then fast for long, then slowly again: the same motion cold and warm",
       "Run it twice, first cold and again after a quarter of an hour of work: what drifts has "
       "changed by then.",
       {"thermal_drift", "gain_drift", "sensor_drift"}},
      {Archetype::kSmallAndFast,
       "small and fast, up to half of the lowest resonance",
       "",
       {"time_delay", "actuator_lag", "joint_elasticity", "link_flexibility"}},
      {Archetype::kTwoSpeeds,
       "the same postures slowly and fast",
       "",
       {"quadratic_drag", "asymmetric_viscous", "rotor_inertia", "geometry_error", "base_tilt",
        "encoder_offset"}},
      {Archetype::kSlowSweep,
       "one joint at a time, slowly over its whole range, both ways",
       "",
       {"torque_ripple", "kinematic_ripple", "cable", "gravity_spring", "joint_coupling"}},
      {Archetype::kAllJoints, "all joints at once, as an exciting trajectory", "", {}},
  };
  return kArchetypes;
}

const ArchetypeWords& words_of(Archetype archetype) {
  return archetypes()[static_cast<std::size_t>(archetype)];
}

const ArchetypeWords& archetype_for(const std::vector<std::string>& families) {
  for (const ArchetypeWords& words : archetypes()) {
    const auto knows = [&](const std::string& family) { return words.families.contains(family); };
    if (std::any_of(families.begin(), families.end(), knows)) return words;
  }
  return words_of(Archetype::kSlowSweep);
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/undecidable.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace dyngen::runtime {
namespace {

/// Below this part of its chi-square only rounding and interpolation are left of an effect.
constexpr double kNothingLeft = 1e-6;
/// Columns that are made of the model's torque are its equations, but made at all samples: less
/// than 5e-4 was left of them on simulated recordings.
constexpr double kTorqueLeft = 1e-3;

std::string reason(const EffectLaw& law) {
  const std::string& family = law.family;
  if (family == "torque_offset" || family == "coulomb_asymmetry") {
    return "a constant torque and friction that differs by direction are the offset of the joint: "
           "identical columns on any data; a reading with the motors off would tell";
  }
  if (family == "gravity_spring") {
    return "torque that goes with the sine of the joint's position is a first moment of the link: "
           "identical columns on any data; another orientation of the base would tell";
  }
  if (family == "payload") {
    return "a load that is there all the time is part of the last link: identical columns on any "
           "data; recordings before the change (--reference) would tell";
  }
  if (family == "torque_gain") {
    return "a factor on all torques scales all parameters: identical columns on any data; a known "
           "load would tell";
  }
  if (family == "rotor_inertia") {
    return "rotor inertia is in the model already, or in the inertia of the link it moves: "
           "identical columns on any data";
  }
  return law.name + ": the model has the same columns, on any data";
}

}  // namespace

std::vector<Undecidable> undecidable_effects(const std::vector<Hypothesis>& hypotheses,
                                             const Screening& screening, const LinearModel& model) {
  std::map<std::pair<int, std::string>, std::vector<std::string>> groups;
  for (const NamedResult& named : screening.named) {
    const EffectInstance& effect = hypotheses[named.hypothesis].effect;
    const auto& aliases = effect.law.aliases;
    const bool theorem = std::find(aliases.begin(), aliases.end(), "base") != aliases.end();
    const double most = effect.law.reads("torque") ? kTorqueLeft : kNothingLeft;
    if (!theorem || !(named.part_left < most)) continue;
    if (effect.joint >= model.joints()) continue;
    std::vector<std::string>& families = groups[{effect.joint, reason(effect.law)}];
    if (std::find(families.begin(), families.end(), effect.law.family) == families.end()) {
      families.push_back(effect.law.family);
    }
  }
  std::vector<Undecidable> result;
  for (auto& [key, families] : groups) {
    std::sort(families.begin(), families.end(), std::greater<>());
    result.push_back({families, key.first, key.second});
  }
  return result;
}

}  // namespace dyngen::runtime

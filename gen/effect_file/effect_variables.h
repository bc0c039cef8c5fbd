// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace dyngen {

/// Where a variable of an effect's equations is known.
enum class VariableSource {
  kMotion,   ///< of the joint (or its partner): in a controller too
  kModel,    ///< friction and rotor parameters of the joint in the robot file
  kTime,     ///< recordings alone: t, temp, and rates of torques
  kTangent,  ///< the rigid model at the joint: its torque, its other components of force and moment
  kEveryJoint  ///< derivatives of every joint's torque by something of the rigid model
};

/// A name that equations may use.
struct EffectVariable {
  std::string_view name;
  std::string_view unit;  ///< as in a parameter's unit=
  VariableSource source = VariableSource::kMotion;
  bool of_partner = false;  ///< needs an effect of scope pair
  std::string_view meaning;
};

/// All of them, in the order of the documentation. The one definition.
std::span<const EffectVariable> effect_variables();
/// @return null if there is none of this name
const EffectVariable* find_effect_variable(std::string_view name);

}  // namespace dyngen

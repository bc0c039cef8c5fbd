// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gen/effect_code/bound_effect.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

struct CodeModel;

/// An effect as the algorithms see it: a number, a named number or an entry of chi for each
/// parameter.
struct CodeEffect {
  std::string name;  ///< "stribeck_2": begins the names of its parameters, states and statements
  std::shared_ptr<const EffectFile> file;
  int joint = 0;                      ///< link that the joint moves, from 1
  int other = 0;                      ///< of scope pair
  std::vector<GiNaC::ex> parameters;  ///< in the order of the file
};

/// One state of one effect.
struct CodeState {
  std::string name;     ///< "dahl_2_z"
  GiNaC::ex value = 0;  ///< input
  GiNaC::ex start = 0;  ///< exact: 0, or the nearest number within its limits
};

/// A variable of which effects need the value of the call before.
struct RememberedVariable {
  std::string variable;  ///< "q", "qd", "qdd" or "tau_load"
  int link = 0;
  GiNaC::ex value = 0;  ///< input
};

/// What the emitted functions keep between two calls, the struct <prefix>_state.
struct EffectMemory {
  std::vector<CodeState> states;
  std::vector<RememberedVariable> last;
  GiNaC::ex step = 0;  ///< input, s: 0 at the first call, then dt
  GiNaC::ex dt = 0;    ///< input, s: time between two calls

  [[nodiscard]] bool empty() const { return states.empty(); }
};

/// The argument that points to it, and its members as arrays of a program.
inline constexpr std::string_view kStateArgument = "s";
inline constexpr std::string_view kStateArray = "s->z";
inline constexpr std::string_view kLastArray = "s->last";
inline constexpr std::string_view kStepArray = "s->step";  ///< one number
inline constexpr std::string_view kPeriodArray = "s->dt";  ///< one number

/// Gives a model the effects that run in a controller, in the order of the robot file; others are
/// left out.
/// @param robot  where rotor inertias are looked up that the code has grouped into others
/// @throws ModelError  if an effect reads a rotor inertia that is unknown and grouped
void add_effects(CodeModel& code, const std::vector<BoundEffect>& effects,
                 const SymbolicRobot& robot);

/// Why an effect cannot run in a controller; empty if it can.
std::string why_not_in_controller(const EffectFile& effect);

/// True if an effect of the model reads one of the variables ("tau_load" and "tau_load_other" are
/// both "tau_load").
bool effects_read(const CodeModel& code, const std::vector<std::string_view>& variables);

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "gen/effect_file/effect_checks.h"
#include "gen/effect_file/effect_reader.h"
#include "gen/effect_file/effect_variables.h"

namespace dyngen {

bool EffectFile::acts_on_all() const {
  return scope == EffectScope::kRobot ||
         std::any_of(variables.begin(), variables.end(), [](const std::string& read) {
           return find_effect_variable(read)->source == VariableSource::kEveryJoint;
         });
}

bool EffectFile::acts_inward() const {
  bool inward = false;
  for (const std::string& read : variables) {
    if (find_effect_variable(read)->source != VariableSource::kEveryJoint) continue;
    if (!read.starts_with("contact_")) return false;
    inward = true;
  }
  return inward;
}

bool EffectFile::runs_in_controller() const {
  if (kind != EffectKind::kAlgebraic && kind != EffectKind::kStateful) return false;
  return std::all_of(variables.begin(), variables.end(), [](const std::string& read) {
    const VariableSource known = find_effect_variable(read)->source;
    return known == VariableSource::kMotion || known == VariableSource::kModel;
  });
}

const std::vector<std::string_view>& effect_families() {
  static const std::vector<std::string_view> kFamilies = {
      "torque_offset",  "coulomb_asymmetry", "asymmetric_viscous",
      "stribeck",       "nonlinear_viscous", "quadratic_drag",
      "load_friction",  "position_friction", "thermal_drift",
      "joint_coupling", "rotor_inertia",     "presliding",
      "backlash",       "joint_elasticity",  "link_flexibility",
      "torque_ripple",  "kinematic_ripple",  "gravity_spring",
      "cable",          "base_tilt",         "encoder_offset",
      "geometry_error", "payload",           "payload_change",
      "contact",        "torque_gain",       "torque_saturation",
      "gain_drift",     "actuator_lag",      "time_delay",
      "sensor_drift",   "torque_crosstalk"};
  return kFamilies;
}

const std::vector<EffectScale>& effect_scales() {
  static const std::vector<EffectScale> kScales = {
      {"Fc", "torque", "Coulomb friction of the joint"},
      {"Fv", "torque/rate", "viscous friction of the joint"},
      {"Ia", "torque/acceleration", "rotor inertia of the joint"},
      {"v_max", "rate", "largest speed of the joint in the recording"},
      {"v90", "rate", "speed below which 90 % of the samples are"},
      {"q_range", "position", "distance between the extreme positions of the joint"},
      {"tau_max", "torque", "largest torque of the joint"},
      {"duration", "s", "duration of the recording"},
      {"position_step", "position", "encoder step, as recorded"},
      {"temp_range", "K", "range of the recorded temperature"}};
  return kScales;
}

const std::vector<std::pair<std::string_view, std::string_view>>& effect_tests() {
  static const std::vector<std::pair<std::string_view, std::string_view>> kTests = {
      {"distance_collapse",
       "after velocity reversals the residual is one function of distance, at every speed"},
      {"time_collapse", "after events the residual is one function of the time since the event"},
      {"slow_steady", "it appears in slow steady motion, away from velocity reversals"},
      {"speed_independent", "its size does not depend on the speed"},
      {"speed_scaling", "its size grows with the square of the speed"},
      {"order_match",
       "its order is an integer multiple of a gear ratio, of a number of teeth or of poles"},
      {"load_scaling", "its size is proportional to the load"},
      {"two_loads", "the same parameters hold for two payloads or postures"},
      {"both_directions", "the same parameters hold in both directions of motion"},
      {"load_reversal", "it acts where the load changes its sign, not where the velocity does"},
      {"partner_alone", "it appears while the other joint moves alone"},
      {"transposed", "the other joint of the pair shows the transposed coupling"},
      {"all_joints", "one value explains every joint"},
      {"distal_silence", "joints beyond the link carry no torque of it"},
      {"high_load_only", "it acts at large torque only"},
      {"monotone", "it changes in one direction over the recording"},
      {"rest_resets", "a pause resets it"},
      {"nested_loops", "small loops within larger loops close"},
      {"onset", "it begins within one period of the motion"}};
  return kTests;
}

EffectFile parse_effect_file(const std::string& text, std::string file_name) {
  Diagnostics diagnostics(file_name, text);
  EffectFile effect = read_effect_rows(text, diagnostics);
  effect.file_name = std::move(file_name);
  if (!diagnostics.has_errors()) check_effect(effect, diagnostics);
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
  return effect;
}

EffectFile read_effect_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw ModelError(path + ": error: it cannot be read: " + std::strerror(errno) + "\n");
  }
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) throw ModelError(path + ": error: it cannot be read\n");
  return parse_effect_file(text, path);
}

}  // namespace dyngen

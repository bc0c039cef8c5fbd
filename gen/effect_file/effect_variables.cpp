// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_variables.h"

#include <algorithm>
#include <iterator>

namespace dyngen {

namespace {

using enum VariableSource;

constexpr EffectVariable kVariables[] = {
    {"q", "position", kMotion, false, "position of the joint"},
    {"qd", "rate", kMotion, false, "its velocity"},
    {"qdd", "acceleration", kMotion, false, "its acceleration"},
    {"tau_load", "torque", kMotion, false,
     "torque of the rigid links on the joint, without rotor inertia and friction"},
    {"sign_qd", "1", kMotion, false, "sign of qd; what sign(qd) means"},
    {"q_other", "position", kMotion, true, "position of the joint 'other'"},
    {"qd_other", "rate", kMotion, true, "its velocity"},
    {"qdd_other", "acceleration", kMotion, true, "its acceleration"},
    {"tau_load_other", "torque", kMotion, true, "torque of the rigid links on it"},
    {"Fc", "torque", kModel, false, "Coulomb friction of the joint, the row Fs of the robot file"},
    {"Fv", "torque/rate", kModel, false, "viscous friction, the row Fv"},
    {"Ia", "torque/acceleration", kModel, false, "rotor inertia, the row IA"},
    {"t", "s", kTime, false, "time from the recording's start"},
    {"temp", "K", kTime, false, "temperature of the joint, as recorded"},
    {"tau_load_rate", "torque/s", kTime, false, "d tau_load / dt"},
    {"tau_load_acc", "torque/s^2", kTime, false, "d2 tau_load / dt2"},
    {"torque", "torque", kTangent, false, "torque of the joint in the model without effects"},
    {"torque_rate", "torque/s", kTangent, false, "its rate"},
    {"torque_acc", "torque/s^2", kTangent, false, "the rate of that"},
    {"wrench_fx", "N", kTangent, false, "force of the links on the joint, in its link's frame"},
    {"wrench_fy", "N", kTangent, false, ""},
    {"wrench_fz", "N", kTangent, false, ""},
    {"wrench_nx", "N.m", kTangent, false, "moment about the origin of that frame"},
    {"wrench_ny", "N.m", kTangent, false, ""},
    {"wrench_nz", "N.m", kTangent, false, ""},
    {"d_q", "torque/position", kEveryJoint, false,
     "derivative of every joint's rigid torque by q of the joint"},
    {"d_qd", "torque/rate", kEveryJoint, false, "by qd"},
    {"d_qdd", "torque/acceleration", kEveryJoint, false, "by qdd"},
    {"d_gx", "torque.s^2/m", kEveryJoint, false, "by gx of the robot file"},
    {"d_gy", "torque.s^2/m", kEveryJoint, false, "by gy"},
    {"d_gz", "torque.s^2/m", kEveryJoint, false, "by gz"},
    {"hidden_gx", "1", kEveryJoint, false,
     "by gx, of a first moment of the first link that the file's gravity does not show"},
    {"hidden_gy", "1", kEveryJoint, false, "by gy"},
    {"d_alpha", "torque/rad", kEveryJoint, false, "by al of the joint's row of the DH table"},
    {"d_d", "torque/m", kEveryJoint, false, "by d"},
    {"d_theta", "torque/rad", kEveryJoint, false, "by th"},
    {"d_r", "torque/m", kEveryJoint, false, "by r"},
    {"payload_XX", "torque/kg/m^2", kEveryJoint, false,
     "by the parameters of a body on the last link, in its frame"},
    {"payload_XY", "torque/kg/m^2", kEveryJoint, false, ""},
    {"payload_XZ", "torque/kg/m^2", kEveryJoint, false, ""},
    {"payload_YY", "torque/kg/m^2", kEveryJoint, false, ""},
    {"payload_YZ", "torque/kg/m^2", kEveryJoint, false, ""},
    {"payload_ZZ", "torque/kg/m^2", kEveryJoint, false, ""},
    {"payload_MX", "torque/kg/m", kEveryJoint, false, ""},
    {"payload_MY", "torque/kg/m", kEveryJoint, false, ""},
    {"payload_MZ", "torque/kg/m", kEveryJoint, false, ""},
    {"payload_M", "torque/kg", kEveryJoint, false, ""},
    {"contact_fx", "torque/N", kEveryJoint, false,
     "by a force that the link puts on its surroundings at its frame's origin, axes of frame 0"},
    {"contact_fy", "torque/N", kEveryJoint, false, ""},
    {"contact_fz", "torque/N", kEveryJoint, false, ""},
    {"contact_nx", "torque/N/m", kEveryJoint, false, "by a moment"},
    {"contact_ny", "torque/N/m", kEveryJoint, false, ""},
    {"contact_nz", "torque/N/m", kEveryJoint, false, ""},
};

}  // namespace

std::span<const EffectVariable> effect_variables() { return kVariables; }

const EffectVariable* find_effect_variable(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kVariables), std::end(kVariables),
                   [&](const EffectVariable& variable) { return variable.name == name; });
  return found == std::end(kVariables) ? nullptr : &*found;
}

}  // namespace dyngen

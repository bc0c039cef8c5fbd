// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/model/linear_model.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// Derivatives of every joint's rigid torque, by the names that effects have for them: d_q d_qd
/// d_qdd of the coordinate that the link's joint is; d_alpha d_d d_theta d_r of the link's row of
/// the DH table; d_gx d_gy d_gz; hidden_gx hidden_gy, the same of a first moment of the first
/// moving link where no base parameter has it; payload_XX .. payload_M of a body on the link, on the
/// last one for link 0; contact_fx .. contact_nz of
/// a force or moment that the link puts on its surroundings. wrench_fx .. wrench_nz: column j is of
/// joint j's own wrench. (N x n) each. Link 0 has those of gravity, of the payload and of the
/// wrenches.
///
/// All that one program gives come together. Programs are written when they are first asked for.
/// Base parameters do not say all of the bodies: where the file has numbers for all of them, those
/// nearest to the file's are taken, otherwise those of the file that dynid writes. Derivatives by
/// q, dq and ddq do not depend on that choice, others may.
///
/// @throws std::invalid_argument  (the function) if there is no such name, or the link has no joint
TangentFunction robot_tangents(const DescribedRobot& robot);

/// What effects ask of a robot: its tangents, and rotor inertias of the file that base parameters
/// have joined with the links'.
EffectRobot effect_robot(const DescribedRobot& robot);

/// Links on which a load shows: those that a joint moves; the last one is any load at the tip.
std::vector<LoadPlace> load_places(const DescribedRobot& robot);

}  // namespace dyngen::runtime

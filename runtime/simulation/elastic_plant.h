// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/simulation/joint_spring.h"
#include "runtime/simulation/plant_model.h"

namespace dyngen::runtime {

/// A joint whose gear twists.
struct ElasticJoint {
  int joint = 0;       ///< coordinate of the rigid robot
  double rotor = 0;    ///< IA: what turns with the drive, kg m^2 or kg
  double inertia = 0;  ///< of the links about the joint, rotor left out: what damping refers to
  JointSpring spring;
};

/// Damping of a gear: its share of the critical damping of the link on its spring, the drive held.
inline constexpr double kGearDamping = 0.01;

/// A robot some of whose joints have a spring between drive and link.
///
/// Coordinates 0 .. n-1 are the drives, which encoders see, and for rigid joints the links too;
/// behind them stand the links of elastic joints, in the order of `joints`:
///
///     IA ddq_m + friction(dq_m) + T = tau                      the drive of an elastic joint
///     rigid(q_l, dq_l, ddq_l) without its IA = T               its link
///     T = load(q_m - q_l) + d (dq_m - dq_l)
///
/// with d of kGearDamping at the spring's stiffness under the present load. Rigid joints keep their
/// equation. Effects act on the drives and read there; tau_load of an elastic joint is T.
/// @param rigid   of n joints, all of them with drives; its effects' surroundings already hold the
///                n + joints.size() coordinates, with 0 for the links
/// @param joints  each at most once
/// @throws std::invalid_argument  if a joint does not exist or stands twice, or a rotor or an
///         inertia is not positive
PlantModel elastic_plant(PlantModel rigid, std::vector<ElasticJoint> joints);

}  // namespace dyngen::runtime

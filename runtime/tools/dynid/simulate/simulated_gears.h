// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"
#include "gen/robot_file/robot_file.h"
#include "runtime/effects/effect_law.h"
#include "runtime/simulation/elastic_plant.h"

namespace dyngen::runtime {

/// A gear is never stiffer than so many times what it is without load: a gap has flanks that give.
inline constexpr double kStiffestGear = 1000;
/// Nor stiffer than one in which the drive swings against its link so fast: such a gear is rigid.
inline constexpr double kFastestGear = 5000;  ///< Hz

/// The elastic joints of a robot: several effects on one joint are springs in a row. Without a
/// twist under any load (c = 0) a joint is rigid.
/// @param effects      those that twist joints (twists_joint()), of the file's rows
/// @param rows         the place among file.effects of each
/// @param rotor        (n) IA
/// @param mass_matrix  of the rigid robot; links' inertia is taken at the zero position
/// @param remarks      sentences are added about gears that are too stiff to swing
/// @throws ModelError  positioned: the drive or its links have no inertia, or a gear that twists
///         under load does not without
std::vector<ElasticJoint> elastic_joints(
    const RobotFile& file, const std::vector<EffectInstance>& effects,
    const std::vector<std::size_t>& rows, const Eigen::VectorXd& rotor,
    const std::function<void(const double* q, double* M)>& mass_matrix,
    std::vector<std::string>& remarks);

}  // namespace dyngen::runtime

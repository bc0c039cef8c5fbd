// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/effects/effect_fit.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What a fit found about the rows `effect` of a robot file.
struct EffectReport {
  EffectFit fit;
  std::vector<std::vector<std::string>> units;  ///< [effect][parameter], of the joint's kind
  Eigen::VectorXd heldout_rms;                  ///< (n) with the effects; empty: nothing held out
  Eigen::VectorXd heldout_rms_without;          ///< (n) of the model without them, fitted alike
};

/// Units of the parameters of effects as people write them.
std::vector<std::vector<std::string>> effect_units(const std::vector<EffectInstance>& effects,
                                                   const EffectCatalogue& catalogue,
                                                   const LinearModel& model);

/// The number of a joint in the robot file, from 1, fixed ones counted; 0: none.
int file_joint(const RobotModel& model, int coordinate);
/// The same of the joint where an effect is; 0: it is of the whole robot.
int file_joint(const EffectInstance& effect, const RobotModel& model);

/// "joint 2", "joint 2 (shoulder)", "joint 5, other 6", "": where an effect is, as the robot file
/// counts and names.
std::string place_of(const EffectInstance& effect, const RobotModel& model);

/// "effect stribeck joint=2 Fs=2.1 vs=0.05 delta=2": the row of a robot file.
std::string effect_row(const EffectInstance& effect, const RobotModel& model);

/// "held", "at its bound", "not seen": why a parameter has no deviation; empty: it has.
std::string state_of(const EffectParameterFit& parameter);

/// The part of the table about effects.
std::string effect_rows(const EffectReport& report, const DescribedRobot& robot);

/// Rows `effect` of the identified robot file, in the order of the original, and what is known of
/// their numbers, a line each.
std::vector<std::string> effect_file_rows(const EffectReport& report, const DescribedRobot& robot);
std::vector<std::string> effect_comment(const EffectReport& report);

}  // namespace dyngen::runtime

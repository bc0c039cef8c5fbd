// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What a reader should know of the file's numbers: which are held; or, if none is, that the file
/// looks as if they were meant to be: some links have numbers, and a link or a load is unknown.
std::vector<std::string> notes_of_numbers(const DescribedRobot& robot, bool open_payload);

/// Whether a payload is to be found among them.
bool has_open_payload(const std::vector<EffectInstance>& effects);

/// Rotor inertia and friction that came out below 0, where physics ends, while 0 is in their
/// interval or numbers are held beside them. @param interval  in standard deviations; of parameters
/// without any nothing is said
std::vector<std::string> notes_of_negatives(const LinearModel& model, const Eigen::VectorXd& beta,
                                            const Eigen::VectorXd& stddev, double interval);

}  // namespace dyngen::runtime

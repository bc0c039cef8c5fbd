// SPDX-License-Identifier: MIT
#pragma once

#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"

namespace dyngen::test {

/// The largest difference between the poses and Jacobians of all links (`fk`, `fk_1` ...,
/// `jacobian`, `jacobian_1` ...) and the judge's transforms and their derivatives, over the largest
/// element and 1 (m, or none).
/// @param values  the model with every quantity known
double frame_error(const RobotModel& model, const RobotModel& values, GeneratorOptions options,
                   int samples);

}  // namespace dyngen::test

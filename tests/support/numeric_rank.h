// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/numeric_robot.h"

namespace dyngen::test {

/// Rank of a column-scaled regressor, and how clear the decision was.
struct NumericRank {
  int rank = 0;
  double last_kept = 0;      ///< smallest singular value counted, over the largest
  double first_dropped = 0;  ///< largest one not counted, over the largest; 0 if none was dropped
};

/// Numbers of base parameters of a robot, from its kinematics, gravity and joint types alone: its
/// inertial numbers play no part.
struct BaseParameterRanks {
  NumericRank inertial;            ///< of the ten per link
  NumericRank inertial_and_rotor;  ///< of the ten and IA
  NumericRank gravity;             ///< of the ten, the arm at rest
};

/// Counts by singular values of a regressor stacked over `states` random states, its columns got by
/// giving one parameter after another the value 1 and asking id_rigid(), in long double.
///
/// A singular value counts if it is above 1e-10 of the largest: rounding leaves some 1e-17, and
/// what is really there is far above in robots of ordinary dimensions. Look at the gap when in
/// doubt.
/// @throws std::invalid_argument as id_rigid() does
BaseParameterRanks base_parameter_ranks(const NumericRobot& robot, int states = 40,
                                        unsigned seed = 1);

}  // namespace dyngen::test

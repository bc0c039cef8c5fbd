// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/rules/decision_rule.h"

namespace dyngen::runtime {

/// What two encoders on a joint say of its gear.
struct WindUpRules {
  DecisionRule chance{0.01, "wind_up.chance", "1",
                      "Probability of a term of the wind-up, if it is not there, below which it is "
                      "kept; times the number of its forms that were tried.",
                      "one false term in a hundred joints"};
  DecisionRule slow_degree{
      3, "wind_up.slow_degree", "1",
      "Degree of the polynomial of the position that is always taken for gear error.",
      "sensitivity: eccentric wheels, a ratio that is apart, and half a turn of them"};
  DecisionRule line_neighbours{10, "wind_up.line_neighbours", "1",
                               "Orders of the angle that an order is compared with.",
                               "F with 2 and 20 degrees"};
  DecisionRule line_cycles{2.5, "wind_up.line_cycles", "1",
                           "Periods in the travel from which an order is sought.",
                           "1.5 are slow gear error, and one more is a resolution"};
  DecisionRule most_lines{4, "wind_up.most_lines", "1", "Orders that are sought at most.",
                          "sensitivity"};
  DecisionRule load_reversals{0.02, "wind_up.load_reversals", "1",
                              "Part of the samples on either flank from which backlash is judged.",
                              "sensitivity"};
  DecisionRule least_own{1e-3, "wind_up.least_own", "1",
                         "Rms of the load that speed, position and acceleration do not explain, "
                         "over that of the load, below which no stiffness is given.",
                         "rounding of the joint state"};
  DecisionRule least_steps{2, "wind_up.least_steps", "encoder steps",
                           "Hysteresis and backlash that are smaller cannot be resolved.",
                           "as the effects backlash and dahl have it"};
  DecisionRule least_rows{60, "wind_up.least_rows", "1",
                          "Independent rows from which a joint is judged.", "6 degrees of freedom"};
};

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/rules/decision_rule.h"

namespace dyngen::runtime {

/// What is a ripple of the torque over a joint's angle.
struct RippleRules {
  DecisionRule chance{
      2.5e-4, "ripple.chance", "1",
      "Probability that noise shows any order of a joint as strong, below which an order is kept.",
      "1 - 0.95^(1/200): 200 joints without ripple show none 19 times in 20"};
  DecisionRule beside{0.01, "ripple.beside", "1",
                      "Probability of what is left of an order beside a rival explanation, below "
                      "which the rival does not explain it.",
                      "a single test"};
  DecisionRule least_share{
      0.3, "ripple.least_share", "1",
      "Part of an order's power that a rival must leave for the order to stand.",
      "a line that is 30 % apart in its frequency leaves more"};
  DecisionRule least_order{5, "ripple.least_order", "1/turn",
                           "Periods per turn from which orders are sought.",
                           "slower ones are in the band of the equations"};
  DecisionRule most_order{2000, "ripple.most_order", "1/turn",
                          "Periods per turn up to which orders are sought.",
                          "ten times the ratio of usual gears"};
  DecisionRule most_per_sample{
      0.45, "ripple.most_per_sample", "1",
      "Periods per sample up to which a sample counts for an order.",
      "Nyquist's 0.5 less a tenth, where low-passes before sampling begin"};
  DecisionRule slowest{
      0.05, "ripple.slowest", "1",
      "Part of the speed that 90 % of the samples are below: slower samples are left out.",
      "stiction is there; a twentieth of the travel is lost"};
  DecisionRule least_samples{0.1, "ripple.least_samples", "1",
                             "Part of the samples that must count for an order.", "sensitivity"};
  DecisionRule neighbours{16, "ripple.neighbours", "1",
                          "Orders on each side that an order is compared with.",
                          "F with 2 and 128 degrees where the joint moves both ways"};
  DecisionRule nearest{1.5, "ripple.nearest", "resolutions",
                       "Distance from which orders are neighbours.", "half of the main lobe is 1"};
  DecisionRule part_of_line{3, "ripple.part_of_line", "resolutions",
                            "Distance below which an order is a part of a stronger one.",
                            "side lobes, and an amplitude that changes over the travel"};
  DecisionRule most_lines{12, "ripple.most_lines", "1",
                          "Orders of a joint that are sought at most.", "sensitivity"};
  DecisionRule least_moving{1000, "ripple.least_moving", "1",
                            "Samples in motion from which a joint is judged.",
                            "60 periods of 16 samples"};
  DecisionRule most_coefficients{12, "ripple.most_coefficients", "1",
                                 "Coefficients of the noise's autoregression at most.",
                                 "one resonance takes two"};
};

}  // namespace dyngen::runtime

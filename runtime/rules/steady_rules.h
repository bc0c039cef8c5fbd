// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/rules/decision_rule.h"

namespace dyngen::runtime {

/// What is a run of constant speed, what a held pose, and which form of friction they speak for.
struct SteadyRules {
  DecisionRule window{0.25, "steady.window", "s", "Time over which a speed is measured.",
                      "half a period of 2 Hz: slower swings are not constant speed"};
  DecisionRule spread{0.03, "steady.spread", "1",
                      "Part of its speed by which a run may depart from it, besides noise.",
                      "friction changes by less than this part of its viscous torque"};
  DecisionRule noise_factor{4, "steady.noise_factor", "1",
                            "Standard deviations of a measured speed that are noise.",
                            "normal distribution: 1 of 16 000"};
  DecisionRule settling{0.15, "steady.settling", "s",
                        "Time at both ends of a run that is left out.", "sensitivity"};
  DecisionRule least_run{0.4, "steady.least_run", "s", "Shortest run whose mean is used.",
                         "1.6 windows"};
  DecisionRule least_hold{0.5, "steady.least_hold", "s", "Shortest time in a pose.", "2 windows"};
  DecisionRule pose_settling{0.3, "steady.pose_settling", "s",
                             "Time at the beginning of a pose that is left out.",
                             "three time constants of a loop of 1.6 Hz"};
  DecisionRule standing{0.01, "steady.standing", "rad or m",
                        "Range of the other joints' positions within which they stand.",
                        "1 % of their gravity"};
  DecisionRule same_posture{0.02, "steady.same_posture", "rad or m",
                            "Distance of postures that count as one.",
                            "2 % of gravity at most, which pairs of directions cancel"};
  DecisionRule reach{0.002, "steady.reach", "rad or m",
                     "Way of a joint to a pose from which its side is known.",
                     "presliding reaches of gears are some 1e-4 to 2e-3 rad"};
  DecisionRule band{3, "steady.band", "Hz", "Noise below this frequency is modelled.",
                    "above, a mean over a run of 0.4 s takes it away"};
  DecisionRule slowest{4, "steady.slowest", "1",
                       "Longest memory of the noise, over the longest run.",
                       "slower noise is the same in the runs of both directions"};
  DecisionRule chance{0.001, "steady.chance", "1",
                      "Probability of a term of friction, if it is not there, below which it is "
                      "named; times the number of its shapes that were tried.",
                      "one false term in a thousand joints"};
  DecisionRule rival{6.6, "steady.rival", "1",
                     "Chi-square by which another form must be worse to be ruled out.",
                     "chi-square with one degree: 1 %"};
};

}  // namespace dyngen::runtime

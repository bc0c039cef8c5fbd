// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/rules/decision_rule.h"

namespace dyngen::runtime {

/// What changed between a reference and later sessions.
struct ChangeRules {
  DecisionRule slab{100, "changes.slab", "1",
                    "Prior variance of a change over its own variance; a larger change raises it.",
                    "a change is some ten deviations large; Liang, Paulo, Molina, Clyde and Berger "
                    "2008, 2.4"};
  DecisionRule further_friction{
      0.1, "changes.further_friction", "1",
      "Prior odds of friction of a further joint, once that of one has changed.",
      "oil and heat are common to joints"};
  DecisionRule inertia_odds{
      0.05, "changes.inertia_odds", "1",
      "Prior odds of inertial parameters of a link that change in another way than by a load.",
      "that takes a rebuilt link"};
  DecisionRule most_changes{10, "changes.most_changes", "1", "Changes of one set at most.",
                            "some more than the joints of an arm"};
  DecisionRule replaces{0.05, "changes.replaces", "1",
                        "Weight of a set over that of the best one, from which its change is named "
                        "beside the best.",
                        "what has less is excluded with 95 %"};
  DecisionRule coulomb_allowance{
      0.07, "changes.coulomb_allowance", "1",
      "Standard deviation of Coulomb friction between sessions, over Coulomb friction.",
      "stated: friction moves with temperature, grease and standstill"};
  DecisionRule viscous_allowance{
      0.1, "changes.viscous_allowance", "1",
      "Standard deviation of viscous friction between sessions, over viscous friction.",
      "stated, as for Coulomb friction"};
  DecisionRule offset_allowance{
      0.05, "changes.offset_allowance", "1",
      "Standard deviation of an offset between sessions, over Coulomb friction.",
      "an offset is half of the difference between the friction of both directions"};
  DecisionRule least_friction{
      0.02, "changes.least_friction", "1",
      "Coulomb friction over the rms torque, that a joint is taken to have at least.",
      "gears of arms have some hundredths"};
  DecisionRule allowance_worth{
      4, "changes.allowance_worth", "sessions",
      "Sessions that the allowance counts as, where the scatter is estimated beside it.",
      "it is a guess: a factor of 2 either way is likely"};
  DecisionRule same_temperature{
      2, "changes.same_temperature", "K",
      "Mean temperatures of a joint that differ by less say nothing of its friction.",
      "a guess: 2 K change friction by less than sessions scatter"};
};

}  // namespace dyngen::runtime

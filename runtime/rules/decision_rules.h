// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/rules/change_rules.h"
#include "runtime/rules/decision_rule.h"
#include "runtime/rules/ripple_rules.h"
#include "runtime/rules/steady_rules.h"
#include "runtime/rules/wind_up_rules.h"

namespace dyngen::runtime {

/// How the noise of the equations is modelled.
struct NoiseRules {
  DecisionRule least_independent{
      25, "noise.least_independent", "1",
      "Independent samples by which a joint's noise must be known: from differences between "
      "periods, else from the residual, and with fewer no verdict is clean.",
      "F with 2 and 25 degrees: 1e-3 at 9.2 beside 6.9 with noise that is known"};
  DecisionRule line_transmission{
      0.5, "noise.line_transmission", "1",
      "A spectral line is used where the difference between periods passes at least this part of "
      "the noise's density.",
      "half power"};
  DecisionRule slow_part_price{
      2, "noise.slow_part_price", "1",
      "Twice the log likelihood by which each slow part of the noise must pay for itself.",
      "Akaike 1974"};
  DecisionRule course_runs{
      3, "noise.course_runs", "1",
      "Runs from which a drift common to all of them can be told from their noise.",
      "two runs cannot outvote one another"};
  DecisionRule course_chi_square{
      25, "noise.course_chi_square", "1",
      "Chi-square of the common drift (4 degrees) beside noise without it, above which it is no "
      "noise.",
      "p = 5e-5 of chi-square with 4 degrees"};
};

/// Which equations a diagnosis makes of recordings, and whether they suffice.
struct EquationRules {
  DecisionRule longest_reversal{
      0.1, "equations.longest_reversal", "s",
      "A joint that stays below its standstill speed for longer stands; a quicker passage is a "
      "reversal.",
      "sensitivity"};
  DecisionRule fewest_periods{
      3, "equations.fewest_periods", "1",
      "Periods from which the motion of the other periods serves as an instrument.",
      "the mean of one other period is as noisy as the period itself"};
  DecisionRule period_mismatch{
      0.1, "equations.period_mismatch", "samples",
      "By how much the last period may be off whole samples, for periods to be averaged; and the "
      "samples of two recordings of one motion off each other.",
      "sensitivity"};
  DecisionRule heldout_motion{
      0.5, "equations.heldout_motion", "1",
      "Part of the usual moving time that every joint must have in the held-out fifth.",
      "sensitivity"};
  DecisionRule repeated_rounding{
      0.5, "equations.repeated_rounding", "1",
      "Scatter between periods over that of rounding, below which the same digits come back.",
      "sensitivity"};
  DecisionRule least_equations{
      30, "equations.least_equations", "1",
      "Equations of a joint, beyond twice the number of parameters that they determine, with which "
      "it is judged; held-out ones at visited positions, with which those elsewhere are left out.",
      "sensitivity"};
  DecisionRule most_predicted{
      0.4, "equations.most_predicted", "1",
      "Variance of predicted held-out torque over that of the residual, above which recordings "
      "without findings are insufficient.",
      "sensitivity"};
  DecisionRule jolt_bandwidth{
      80, "equations.jolt_bandwidth", "Hz",
      "Cut-off of the joint state from which it follows the jolts that stiction makes.",
      "sensitivity"};
};

/// What a scan over time, frequencies or windows takes for structure.
struct ScanRules {
  DecisionRule longest_push{
      0.3, "scans.longest_push", "1",
      "Part of a recording that a passing event may last: what lasts longer is no event.",
      "sensitivity"};
  DecisionRule window_deviations{
      2, "scans.window_deviations", "standard deviations",
      "Mean chi-square per degree in other windows that white noise explains.",
      "two-sided 95 % of the normal distribution"};
  DecisionRule jolt_equations{3, "scans.jolt_equations", "1",
                              "An effect that has the larger part of its gain from so few "
                              "equations is a jolt and no event.",
                              "sensitivity"};
  DecisionRule line_periods{
      1.5, "scans.line_periods", "1",
      "Periods that a spectral line must have in the longest run: with fewer it is a drift.",
      "sensitivity"};
  DecisionRule line_nearest{
      2, "scans.line_nearest", "1",
      "Distance from which spectral lines are neighbours that a line is compared with, in the "
      "frequencies that the longest run resolves.",
      "half the width of the main lobe of a run without a window is 1"};
  DecisionRule line_farthest{10, "scans.line_farthest", "1",
                             "Distance up to which they are neighbours.", "sensitivity"};
};

/// What is thought of an effect before the recordings are looked at.
struct PriorRules {
  DecisionRule unusual_value{
      7.8, "priors.unusual_value", "1",
      "Chi-square that an effect pays for each usual range of its file that its values are beyond.",
      "2 ln 50: a usual range holds 49 of 50 machines that have the effect"};
};

/// What is said of the result.
struct AnswerRules {
  DecisionRule unexplained_part{
      0.2, "answer.unexplained_part", "1",
      "Part of a joint's structure without a name, above which the verdict says so.",
      "sensitivity"};
  DecisionRule probable{
      0.5, "answer.probable", "1",
      "Probability of a name from which it explains; also the most that a name with an objection "
      "can have.",
      "more likely than not"};
  DecisionRule stability{0.8, "answer.stability", "1",
                         "Part of random halves of the recordings in which a name must win.",
                         "Meinshausen and Buehlmann 2010: 0.6 to 0.9"};
  DecisionRule heldout_excess{
      1.3, "answer.heldout_excess", "1",
      "Rms of held-out equations over the expected one: smaller ratios are differences of motions.",
      "sensitivity"};
  DecisionRule heldout_far{
      3, "answer.heldout_far", "1",
      "The same of held-out torque at full rate: smaller ratios can be faster than the equations.",
      "sensitivity: up to 2.5 where nothing is left out"};
  DecisionRule heldout_chance{
      1e-3, "answer.heldout_chance", "1",
      "Probability of a joint's held-out ratio, or of its worsening, if nothing is left out.",
      "F and Student's distribution"};
  DecisionRule open_parameters{
      0.1, "answer.open_parameters", "1",
      "Predicted variance over the residual's, above which held-out motion goes beyond the fitted "
      "one.",
      "sensitivity"};
  DecisionRule printed_part{
      0.02, "answer.printed_part", "1",
      "Ratios that differ from 1 by less are equal: a held-out rms that is worse, equations at "
      "visited positions.",
      "rounding of the two digits that are printed"};
};

/// Every number that accepts, rejects or ranks in a diagnosis, outside of the competition of
/// effects and of their names.
struct DecisionRules {
  NoiseRules noise;
  EquationRules equations;
  ScanRules scans;
  PriorRules priors;
  AnswerRules answer;
  ChangeRules changes;
  SteadyRules steady;
  RippleRules ripple;
  WindUpRules wind_up;
};

/// All of them, in the order of their stages. They are those of `rules`, which outlives them.
std::vector<const DecisionRule*> all_rules(const DecisionRules& rules);
std::vector<const DecisionRule*> all_rules(const DecisionRules&& rules) = delete;

/// Sets a rule by its name. @return false: there is none of that name
bool set_rule(DecisionRules& rules, std::string_view name, double value);

}  // namespace dyngen::runtime

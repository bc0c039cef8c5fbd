// SPDX-License-Identifier: MIT
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {
namespace {

/// @param visit  called with each rule
template <class Rules, class Visit>
void each(Rules& rules, const Visit& visit) {
  auto& noise = rules.noise;
  for (auto* rule : {&noise.least_independent, &noise.line_transmission, &noise.slow_part_price,
                     &noise.course_runs, &noise.course_chi_square}) {
    visit(*rule);
  }
  auto& equations = rules.equations;
  for (auto* rule :
       {&equations.longest_reversal, &equations.fewest_periods, &equations.period_mismatch,
        &equations.heldout_motion, &equations.repeated_rounding, &equations.least_equations,
        &equations.most_predicted, &equations.jolt_bandwidth}) {
    visit(*rule);
  }
  auto& scans = rules.scans;
  for (auto* rule : {&scans.longest_push, &scans.window_deviations, &scans.jolt_equations,
                     &scans.line_periods, &scans.line_nearest, &scans.line_farthest}) {
    visit(*rule);
  }
  visit(rules.priors.unusual_value);
  auto& answer = rules.answer;
  for (auto* rule : {&answer.unexplained_part, &answer.probable, &answer.stability,
                     &answer.heldout_excess, &answer.heldout_far, &answer.heldout_chance,
                     &answer.open_parameters, &answer.printed_part}) {
    visit(*rule);
  }
  auto& changes = rules.changes;
  for (auto* rule : {&changes.slab, &changes.further_friction, &changes.inertia_odds,
                     &changes.most_changes, &changes.replaces, &changes.coulomb_allowance,
                     &changes.viscous_allowance, &changes.offset_allowance, &changes.least_friction,
                     &changes.allowance_worth, &changes.same_temperature}) {
    visit(*rule);
  }
  auto& steady = rules.steady;
  for (auto* rule :
       {&steady.window, &steady.spread, &steady.noise_factor, &steady.settling, &steady.least_run,
        &steady.least_hold, &steady.pose_settling, &steady.standing, &steady.same_posture,
        &steady.reach, &steady.band, &steady.slowest, &steady.chance, &steady.rival}) {
    visit(*rule);
  }
  auto& ripple = rules.ripple;
  for (auto* rule :
       {&ripple.chance, &ripple.beside, &ripple.least_share, &ripple.least_order,
        &ripple.most_order, &ripple.most_per_sample, &ripple.slowest, &ripple.least_samples,
        &ripple.neighbours, &ripple.nearest, &ripple.part_of_line, &ripple.most_lines,
        &ripple.least_moving, &ripple.most_coefficients}) {
    visit(*rule);
  }
  auto& wind_up = rules.wind_up;
  for (auto* rule : {&wind_up.chance, &wind_up.slow_degree, &wind_up.line_neighbours,
                     &wind_up.line_cycles, &wind_up.most_lines, &wind_up.load_reversals,
                     &wind_up.least_own, &wind_up.least_steps, &wind_up.least_rows}) {
    visit(*rule);
  }
}

}  // namespace

std::vector<const DecisionRule*> all_rules(const DecisionRules& rules) {
  std::vector<const DecisionRule*> all;
  each(rules, [&](const DecisionRule& rule) { all.push_back(&rule); });
  return all;
}

bool set_rule(DecisionRules& rules, std::string_view name, double value) {
  bool found = false;
  each(rules, [&](DecisionRule& rule) {
    if (rule.name != name) return;
    rule.value = value;
    found = true;
  });
  return found;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/steady/friction_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSurePoint = 0.95;
constexpr double kSameSpeed = 0.05;  // runs whose speeds differ by less are of one speed

/// The constant torque of each posture: of the chosen form; else of the middle of both directions.
VectorXd constants_of(const SteadyLevels& levels, const FrictionForms& forms) {
  if (forms.judged) return forms.form().linear.head(levels.postures);
  VectorXd constants = VectorXd::Zero(levels.postures);
  for (int p = 0; p < levels.postures; ++p) {
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (const SteadyLevel& own : levels.levels) {
      if (own.posture != p) continue;
      const int way = own.run.speed > 0 ? 1 : 0;
      sum[way] += own.torque;
      count[way] += 1;
    }
    double mean = 0, ways = 0;
    for (const int way : {0, 1}) {
      if (count[way] == 0) continue;
      mean += sum[way] / count[way];
      ways += 1;
    }
    if (ways > 0) constants[p] = mean / ways;
  }
  return constants;
}

std::vector<FrictionPoint> points_of(const SteadyLevels& levels, const FrictionForms& forms) {
  const VectorXd constants = constants_of(levels, forms);
  std::vector<std::size_t> order(levels.levels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return levels.levels[a].run.speed < levels.levels[b].run.speed;
  });
  const double t = student_interval(kSurePoint, std::max(1, levels.degrees));
  std::vector<FrictionPoint> points;
  for (std::size_t begin = 0; begin < order.size();) {
    const double first = levels.levels[order[begin]].run.speed;
    std::size_t end = begin;
    FrictionPoint point;
    VectorXd weights = VectorXd::Zero(static_cast<Index>(order.size()));
    for (; end < order.size(); ++end) {
      const SteadyLevel& own = levels.levels[order[end]];
      if (own.run.speed * first < 0) break;
      if (std::abs(own.run.speed - first) > kSameSpeed * std::abs(first)) break;
      const double seconds = own.run.stretch.seconds();
      weights[static_cast<Index>(order[end])] = seconds;
      point.seconds += seconds;
      point.speed += seconds * own.run.speed;
      point.torque += seconds * (own.torque - constants[own.posture]);
      ++point.runs;
    }
    point.speed /= point.seconds;
    point.torque /= point.seconds;
    weights /= point.seconds;
    const double half = t * std::sqrt(std::max(0.0, weights.dot(levels.covariance * weights)));
    point.low = point.torque - half;
    point.high = point.torque + half;
    points.push_back(point);
    begin = end;
  }
  return points;
}

void add_remarks(SteadyResult& result, const SteadyRules& rules) {
  if (result.left_out > 0 && result.runs > 0) {
    result.remarks.push_back(
        fmt::format("{} runs are left out: other joints move in them.", result.left_out));
  }
  if (!result.forms.judged) return;
  const FrictionForm& form = result.forms.form();
  const int degrees = result.runs - form.parameters;
  const double chance = chi_square_tail(form.chi_square, degrees);
  if (chance < rules.chance) {
    result.remarks.push_back(fmt::format(
        "The levels scatter by {:.2g} times what slow noise explains (chi-square {:.4g} with {} "
        "degrees): ripple over the position, load or heat between the runs, or a form that is none "
        "of these. Intervals of the parameters are wider by it.",
        std::sqrt(result.forms.scatter), form.chi_square, degrees));
  }
  for (const FrictionTerms rival : result.forms.rivals) {
    result.remarks.push_back(fmt::format("Not ruled out: {}.", words_of(rival)));
  }
  for (const double delta : result.forms.other_exponents) {
    result.remarks.push_back(
        fmt::format("Not ruled out: exponent {:.2g} of the Stribeck curve.", delta));
  }
}

}  // namespace

SteadyResult analyse_steady(const SteadyInput& input, const SteadyRules& rules) {
  SteadyResult result;
  result.joint = static_cast<int>(input.joint);
  result.revolute = input.revolute;
  const SteadyLevels levels = steady_levels(input, rules);
  result.runs = static_cast<int>(levels.levels.size());
  result.postures = levels.postures;
  result.left_out = levels.left_out;
  result.seconds = levels.seconds;
  if (result.runs > 0) {
    result.forms = compete_forms(levels, input.revolute, rules);
    result.points = points_of(levels, result.forms);
  }
  result.poses = held_pairs(input.recordings, input.joint, rules);
  add_remarks(result, rules);
  return result;
}

std::string friction_sentence(const SteadyResult& result) {
  if (!result.forms.judged) return result.forms.why_not;
  std::string text = fmt::format("Friction is {}", words_of(result.forms.chosen));
  std::string separator = ": ";
  for (const FrictionNumber& own : result.forms.numbers) {
    text += separator + fmt::format("{} {:.4g}", own.name, own.value);
    if (own.high > own.low) text += fmt::format(" ({:.4g} .. {:.4g})", own.low, own.high);
    if (own.unit != "1") text += " " + own.unit;
    separator = ", ";
  }
  return text + ".";
}

}  // namespace dyngen::runtime

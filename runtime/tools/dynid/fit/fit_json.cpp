// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_json.h"
#include "runtime/tools/dynid/fit/fit_report.h"
#include "runtime/tools/dynid/ripple/joint_ripple_json.h"
#include "runtime/tools/dynid/robot/json_numbers.h"
#include "runtime/tools/dynid/robot/left_out_json.h"
#include "runtime/tools/dynid/steady/steady_json.h"
#include "runtime/tools/dynid/two_encoders/two_encoders_json.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Json names(const FitReport& report, const std::vector<int>& parameters) {
  Json array = Json::array();
  for (const int i : parameters) {
    array.push_back(report.robot.linear.parameters[static_cast<std::size_t>(i)].name);
  }
  return array;
}

Json recordings(const FitReport& report) {
  Json array = Json::array();
  for (const RecordingLine& line : report.recordings) {
    Json repairs = Json::array();
    for (const Notice& notice : line.condition.repairs) repairs.push_back(notice.text());
    array.push_back({{"file", line.name},
                     {"heldout", line.heldout},
                     {"seconds", line.seconds},
                     {"sample_time", line.condition.sample_time},
                     {"jitter", line.condition.jitter},
                     {"resampled", line.condition.resampled},
                     {"cutoff_hz", line.cutoff},
                     {"decimation", line.decimation},
                     {"position_step", line.condition.position_step},
                     {"torque_clipped", line.condition.torque_clipped},
                     {"torque_dead", line.condition.torque_dead},
                     {"equations", numbers(line.equations)},
                     {"periods", line.condition.periods},
                     {"period", line.condition.period},
                     {"repairs", repairs},
                     {"messages", line.condition.messages}});
  }
  return array;
}

Json parameters(const FitReport& report) {
  Json array = Json::array();
  const MethodFit& fit = report.main();
  const LinearModel& model = report.robot.linear;
  for (int i = 0; i < model.size(); ++i) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(i)];
    Json entry = {{"name", parameter.name},
                  {"value", number(fit.estimate.beta[i])},
                  {"std", fit.estimate.covariance.size() != 0
                              ? number(std::sqrt(fit.estimate.covariance(i, i)))
                              : Json(nullptr)},
                  {"unit", parameter.unit},
                  {"seen", seen_name(seen(report, i))},
                  {"formula", parameter.formula},
                  {"before", parameter.value ? Json(*parameter.value) : Json(nullptr)}};
    if (report.consistent) {
      entry["consistent"] = number(report.consistent->beta[i]);
      entry["pull"] = number(report.consistent->pull[i]);
    }
    array.push_back(std::move(entry));
  }
  return array;
}

Json held(const DescribedRobot& robot) {
  Json array = Json::array();
  std::size_t name = 0;
  for (std::size_t i = 0; i < robot.held.places.size(); ++i) {
    if (!robot.held.places[i]) continue;
    const auto place = static_cast<Index>(i);
    const bool exact = robot.held.deviations.size() == 0;
    array.push_back({{"name", robot.held.names[name++]},
                     {"value", number(robot.held_values[place])},
                     {"std", exact ? 0.0 : robot.held.deviations[place]}});
  }
  return array;
}

Json joints(const FitReport& report) {
  Json array = Json::array();
  const MethodFit& fit = report.main();
  const LinearModel& model = report.robot.linear;
  for (int j = 0; j < model.joints(); ++j) {
    const bool heldout = fit.heldout_rms.size() != 0;
    array.push_back(
        {{"joint", j + 1},
         {"name", model.joint_names[static_cast<std::size_t>(j)]},
         {"unit", model.revolute[static_cast<std::size_t>(j)] ? "N m" : "N"},
         {"rms", number(fit.estimate.residual_rms[j])},
         {"percent", number(fit.percent[j])},
         {"heldout_rms", heldout ? number(fit.heldout_rms[j]) : Json(nullptr)},
         {"heldout_percent", heldout ? number(fit.heldout_percent[j]) : Json(nullptr)}});
  }
  return array;
}

Json methods(const FitReport& report) {
  Json array = Json::array();
  for (const MethodFit& fit : report.fits) {
    Json entry = {
        {"method", fit_method_names()[static_cast<std::size_t>(fit.method)]},
        {"beta", numbers(fit.estimate.beta)},
        {"std", fit.estimate.covariance.size() != 0 ? numbers(fit.stddev()) : Json(nullptr)},
        {"textbook_std", fit.textbook.size() != 0 ? numbers(fit.textbook) : Json(nullptr)},
        {"percent", numbers(fit.percent)},
        {"heldout_percent", numbers(fit.heldout_percent)},
        {"condition", number(fit.estimate.condition)},
        {"messages", fit.messages}};
    if (!fit.l_curve.empty()) {
      entry["lambda"] = fit.lambda;
      Json curve = Json::array();
      for (const LCurvePoint& point : fit.l_curve) {
        curve.push_back({point.lambda, point.residual, point.deviation});
      }
      entry["l_curve"] = std::move(curve);
    }
    if (fit.instrumental) {
      entry["hausman"] = {{"chi_square", fit.instrumental->hausman},
                          {"degrees", fit.instrumental->degrees},
                          {"p", fit.instrumental->p_value},
                          {"largest_move", number(fit.instrumental->largest_move)},
                          {"relevance", fit.instrumental->relevance}};
    }
    array.push_back(std::move(entry));
  }
  return array;
}

Json conditioning(const FitReport& report) {
  const Conditioning& c = report.conditioning;
  const auto analysis = [&](const Significance& s) {
    return Json{{"before", number(s.condition_before)},
                {"after", number(s.condition_after)},
                {"removed", names(report, s.removed)}};
  };
  return {{"raw", number(c.raw)},
          {"unit_norm", number(c.unit_norm)},
          {"sensitivity", number(c.sensitivity)},
          {"low_sensitivity", analysis(c.insensitive)},
          {"near_dependencies", analysis(c.dependent)},
          {"weakest_directions", analysis(c.weakest)},
          {"essential",
           {{"after", number(c.essential.condition_after)},
            {"kept", names(report, c.essential.kept)}}}};
}

Json trust(const FitReport& report) {
  const Trust& t = report.trust;
  return {{"regressor_noise", number(t.regressor_noise)},
          {"torque_noise", number(t.torque_noise)},
          {"perturbation_bound", number(t.perturbation_bound)},
          {"attenuation", numbers(t.attenuation)},
          {"worst_bias", numbers(t.worst_bias)},
          {"time_constant", number(t.time_constant)},
          {"singular_value_change", number(t.singular_value_change)},
          {"smallest_singular_value", number(t.smallest_singular_value)},
          {"bias_susceptibility", number(t.bias_susceptibility)}};
}

Json unseen(const FitReport& report) {
  Json array = Json::array();
  for (const UnseenCombination& combination : report.unseen) {
    array.push_back({{"combination", combination.text}, {"advice", combination.advice}});
  }
  return array;
}

Json together(const FitReport& report) {
  Json array = Json::array();
  for (const SeenCombination& combination : report.together) {
    array.push_back({{"combination", combination.text},
                     {"value", number(combination.value)},
                     {"std", number(combination.stddev)},
                     {"unit", combination.unit}});
  }
  return array;
}

Json hierarchy(const FitReport& report) {
  const HierarchyFit& fit = *report.hierarchy;
  Json robots = Json::array();
  for (const HierarchyFit::Robot& robot : fit.robots) {
    robots.push_back({{"name", robot.name},
                      {"own", numbers(robot.own_beta)},
                      {"own_std", numbers(robot.own_stddev)},
                      {"percent", numbers(robot.percent)}});
  }
  return {{"shared_names", names(report, fit.shared)},
          {"shared", numbers(fit.shared_beta)},
          {"shared_std", numbers(fit.shared_stddev)},
          {"own_names", names(report, fit.own)},
          {"robots", robots}};
}

}  // namespace

std::string fit_json(const FitReport& report) {
  Json json = {{"schema", "dynid.fit/1"},
               {"robot", report.robot.linear.name},
               {"joints", report.robot.linear.joints()},
               {"method", fit_method_names()[static_cast<std::size_t>(report.main().method)]},
               {"recordings", recordings(report)},
               {"equations", report.data.summary.equations.samples()},
               {"interval", report.main().interval},
               {"parameters", parameters(report)},
               {"residual", joints(report)},
               {"condition", conditioning(report)},
               {"trust", trust(report)},
               {"unseen", unseen(report)},
               {"seen_together", together(report)},
               {"methods", methods(report)},
               {"notes", report.notes}};
  if (report.robot.held.any()) json["held"] = held(report.robot);
  if (report.consistent) {
    json["consistent"] = {{"converged", report.consistent->converged},
                          {"cost_free", report.consistent->cost_free},
                          {"cost", report.consistent->cost},
                          {"standard", numbers(report.consistent->standard)},
                          {"percent", numbers(report.consistent->percent)},
                          {"heldout_percent", numbers(report.consistent->heldout_percent)},
                          {"message", report.consistent->message}};
  }
  if (report.effects) json["effects"] = effect_json(*report.effects, report.robot);
  if (report.two_encoders.any()) json["two_encoders"] = two_encoders_json(report.two_encoders);
  if (report.ripples.any()) json["ripple"] = ripple_json(report.ripples);
  if (report.steady.any()) json["steady"] = steady_json(report.steady);
  if (report.hierarchy) json["hierarchy"] = hierarchy(report);
  if (report.written_back) json["written_back"] = written_back_json(*report.written_back);
  return json.dump(2) + "\n";
}

}  // namespace dyngen::runtime

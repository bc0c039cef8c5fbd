// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/steady/steady_json.h"

namespace dyngen::runtime {
namespace {

Json torque_json(const MeanTorque& own) {
  return {{"value", number(own.value)}, {"low", number(own.low)}, {"high", number(own.high)}};
}

Json terms_json(FrictionTerms terms) {
  Json json = Json::array();
  for (const FrictionTerm term :
       {FrictionTerm::kStribeck, FrictionTerm::kPower, FrictionTerm::kAsymmetry}) {
    if (terms.has(term)) json.push_back(term_name(term));
  }
  return json;
}

Json points_json(const SteadyResult& result) {
  Json points = Json::array();
  for (const FrictionPoint& own : result.points) {
    points.push_back({{"speed", own.speed},
                      {"torque", number(own.torque)},
                      {"low", number(own.low)},
                      {"high", number(own.high)},
                      {"runs", own.runs},
                      {"seconds", own.seconds}});
  }
  return points;
}

Json form_json(const FrictionForms& forms) {
  if (!forms.judged) return nullptr;
  Json parameters = Json::object(), tests = Json::array(), rivals = Json::array();
  for (const FrictionNumber& own : forms.numbers) {
    parameters[own.name] = {{"value", number(own.value)},
                            {"low", number(own.low)},
                            {"high", number(own.high)},
                            {"unit", own.unit}};
  }
  for (const TermTest& own : forms.tests) {
    tests.push_back({{"term", term_name(own.term)},
                     {"f", number(own.ratio)},
                     {"degrees", number(own.below)},
                     {"shapes", own.tried},
                     {"p", number(own.chance)},
                     {"kept", own.kept}});
  }
  for (const FrictionTerms own : forms.rivals) rivals.push_back(terms_json(own));
  return {{"terms", terms_json(forms.chosen)},
          {"words", words_of(forms.chosen)},
          {"parameters", std::move(parameters)},
          {"tests", std::move(tests)},
          {"rivals", std::move(rivals)},
          {"chi_square", number(forms.form().chi_square)},
          {"fitted", forms.form().parameters},
          {"scatter", number(forms.scatter)},
          {"degrees", forms.degrees}};
}

Json poses_json(const HeldPairs& poses) {
  Json array = Json::array();
  for (const HeldPair& own : poses.pairs) {
    array.push_back({{"q", numbers(own.q)},
                     {"from_below", torque_json(own.below)},
                     {"from_above", torque_json(own.above)},
                     {"gravity", torque_json(own.gravity)},
                     {"held_back", torque_json(own.friction)}});
  }
  return array;
}

}  // namespace

Json steady_json(const SteadyJoints& steady) {
  Json array = Json::array();
  for (const SteadyResult& result : steady.joints) {
    array.push_back({{"joint", result.joint + 1},
                     {"unit", result.revolute ? "N m" : "N"},
                     {"runs", result.runs},
                     {"left_out", result.left_out},
                     {"seconds", result.seconds},
                     {"points", points_json(result)},
                     {"form", form_json(result.forms)},
                     {"poses", poses_json(result.poses)},
                     {"one_sided_poses", result.poses.one_sided},
                     {"remarks", result.remarks}});
  }
  return array;
}

}  // namespace dyngen::runtime

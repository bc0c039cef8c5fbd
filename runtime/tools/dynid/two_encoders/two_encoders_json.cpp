// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/two_encoders/two_encoders_json.h"

namespace dyngen::runtime {
namespace {

Json number_json(const WindUpNumber& own, const std::string& unit) {
  return {{"value", number(own.value)},
          {"low", number(own.low)},
          {"high", number(own.high)},
          {"p", number(own.chance)},
          {"seen", own.seen},
          {"below", number(own.below)},
          {"unit", unit}};
}

Json joint_json(const WindUpResult& result) {
  const bool revolute = result.revolute;
  const std::string position = revolute ? "rad" : "m";
  Json json = {{"joint", result.joint + 1}, {"judged", result.judged}};
  if (!result.judged) {
    json["remarks"] = Json::array({result.why_not});
    return json;
  }
  json["delay"] = number_json(result.delay, "s");
  json["stiffness"] = number_json(result.stiffness, revolute ? "N m/rad" : "N/m");
  json["compliance"] = number_json(result.compliance, revolute ? "rad/(N m)" : "m/N");
  json["hardening"] = number_json(result.hardening, revolute ? "rad/(N m)^3" : "m/N^3");
  json["hysteresis"] = number_json(result.hysteresis, position);
  json["hysteresis"]["driver"] = result.hysteresis_driver;
  json["hysteresis"]["reach"] = number(result.hysteresis_reach);
  json["backlash"] =
      result.backlash_decided ? number_json(result.backlash, position) : Json(nullptr);
  json["slow_gear_error"] = number_json(result.slow_error, position);
  json["rotor_inertia"] = result.rotor_estimated
                              ? number_json(result.rotor, revolute ? "kg m^2" : "kg")
                              : Json(nullptr);
  Json lines = Json::array();
  for (const GearErrorLine& line : result.lines) {
    lines.push_back({{"order", line.order},
                     {"of_motor", line.of_motor > 0 ? Json(line.of_motor) : Json(nullptr)},
                     {"amplitude", number_json(line.amplitude, position)},
                     {"phase", line.phase},
                     {"p", line.chance}});
  }
  json["gear_error"] = {{"lines", std::move(lines)},
                        {"below", number(result.lines_below)},
                        {"least_order", result.least_order},
                        {"most_order", result.most_order}};
  json["load"] = {{"explained", number(result.load_explained)},
                  {"own_rms", number(result.load_own)},
                  {"attenuation", number(result.attenuation)},
                  {"model_share", number(result.model_share)}};
  json["residual"] = number(result.residual);
  json["degrees"] = result.degrees;
  json["remarks"] = result.remarks;
  return json;
}

}  // namespace

Json two_encoders_json(const TwoEncoders& encoders) {
  Json array = Json::array();
  for (const WindUpResult& result : encoders.joints) array.push_back(joint_json(result));
  return array;
}

}  // namespace dyngen::runtime

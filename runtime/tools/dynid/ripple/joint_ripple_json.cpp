// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/ripple/joint_ripple_json.h"

namespace dyngen::runtime {
namespace {

Json interval_json(const RippleNumber& own, const char* unit) {
  return {{"value", number(own.value)},
          {"low", number(own.low)},
          {"high", number(own.high)},
          {"unit", unit}};
}

/// Null where the joint does not move in that direction.
Json wave_json(const RippleWave& wave) {
  if (!wave.known) return nullptr;
  return {{"amplitude", interval_json(wave.amplitude, "N m")},
          {"phase", interval_json(wave.phase, "rad")}};
}

Json line_json(const RippleLine& line, const std::string& found_as) {
  return {{"kind", line.kind == RippleKind::kPosition ? "position_error" : "torque"},
          {"order", interval_json(line.order, "1")},
          {"stated", line.stated > 0 ? Json(line.stated) : Json(nullptr)},
          {"of_motor", line.of_motor > 0 ? Json(line.of_motor) : Json(nullptr)},
          {"both", wave_json(line.both)},
          {"forward", wave_json(line.forward)},
          {"backward", wave_json(line.backward)},
          {"directions_differ", line.differs},
          {"position_error_open", line.open},
          {"changes_with_speed", line.by_speed},
          {"p", number(line.chance)},
          {"lambda", number(line.lambda)},
          {"from_hz", number(line.least_hz)},
          {"to_hz", number(line.most_hz)},
          {"found_as", found_as}};
}

Json ruled_out_json(const RippleLine& line) {
  const bool image = line.kind == RippleKind::kImage;
  return {{"order", number(line.order.value)},
          {"reason", image ? "image" : "fixed_frequency"},
          {"hz", image ? Json(nullptr) : Json(number(line.rival))},
          {"other_order", image ? Json(number(line.rival)) : Json(nullptr)}};
}

Json joint_json(const JointRipple& own) {
  const RippleResult& result = own.result;
  Json json = {{"joint", result.joint + 1}, {"judged", result.judged}};
  if (!result.judged) {
    json["remarks"] = Json::array({result.why_not});
    return json;
  }
  Json lines = Json::array(), ruled_out = Json::array();
  for (std::size_t i = 0; i < result.lines.size(); ++i) {
    lines.push_back(line_json(result.lines[i], own.found_as[i]));
  }
  for (const RippleLine& line : result.ruled_out) ruled_out.push_back(ruled_out_json(line));
  json["lines"] = std::move(lines);
  json["ruled_out"] = std::move(ruled_out);
  json["cut_off"] = result.cut_off;
  json["below"] = number(result.below);
  json["least_order"] = number(result.least_order);
  json["most_order"] = number(result.most_order);
  json["resolution"] = number(result.resolution);
  json["remarks"] = own.remarks;
  return json;
}

}  // namespace

Json ripple_json(const JointRipples& ripples) {
  Json array = Json::array();
  for (const JointRipple& own : ripples.joints) array.push_back(joint_json(own));
  return array;
}

}  // namespace dyngen::runtime

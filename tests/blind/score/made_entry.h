// SPDX-License-Identifier: MIT
// An entry of a manifest for tests of the score; each changes what it is about.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace blind {

/// An effect of the planar arm.
inline nlohmann::json made_effect(const std::string& family, int joint, double lambda) {
  return {{"family", family}, {"joint", joint}, {"other_joint", 0}, {"lambda", lambda},
          {"absorbed", 0.5},  {"form", "f"},    {"own_form", true}};
}

inline nlohmann::json made_entry(const std::string& kind, const nlohmann::json& truths) {
  return {{"case", "c"},
          {"kind", kind},
          {"excess", 0.001},
          {"filtered", 30.0},
          {"wanted_lambda", 80},
          {"arm", "planar2"},
          {"loop", "PD"},
          {"imitated", nlohmann::json::object()},
          {"heldout_oracle", {1.0, 2.0}},
          {"truths", truths}};
}

}  // namespace blind

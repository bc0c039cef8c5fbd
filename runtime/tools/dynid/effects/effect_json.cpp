// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_json.h"

namespace dyngen::runtime {
namespace {

const char* kind_name(EffectRemark::Kind kind) {
  switch (kind) {
    case EffectRemark::Kind::kAtBound:
      return "at_bound";
    case EffectRemark::Kind::kFalsified:
      return "falsified";
    case EffectRemark::Kind::kUnusual:
      return "unusual";
    default:
      return "not_seen";
  }
}

}  // namespace

Json effect_json(const EffectReport& report, const DescribedRobot& robot) {
  Json effects = Json::array();
  for (std::size_t k = 0; k < report.fit.parameters.size(); ++k) {
    const EffectInstance& effect = report.fit.point.effects[k];
    Json parameters = Json::array();
    for (std::size_t p = 0; p < report.fit.parameters[k].size(); ++p) {
      const EffectParameterFit& parameter = report.fit.parameters[k][p];
      const bool known = !parameter.held && parameter.seen && parameter.stddev > 0;
      parameters.push_back({{"name", effect.law.parameters[p].name},
                            {"value", number(parameter.value)},
                            {"std", known ? number(parameter.stddev) : Json(nullptr)},
                            {"unit", report.units[k][p]},
                            {"held", parameter.held},
                            {"seen", parameter.seen},
                            {"at_bound", parameter.at_bound},
                            {"meaning", effect.law.parameters[p].meaning}});
    }
    Json remarks = Json::array();
    for (const EffectRemark& remark : report.fit.remarks) {
      if (remark.effect != static_cast<int>(k)) continue;
      remarks.push_back({{"kind", kind_name(remark.kind)}, {"text", remark.text}});
    }
    const int other = file_joint(robot.model, effect.other);
    effects.push_back({{"name", effect.law.name},
                       {"family", effect.law.family},
                       {"joint", file_joint(effect, robot.model)},
                       {"other_joint", other > 0 ? Json(other) : Json(nullptr)},
                       {"parameters", std::move(parameters)},
                       {"remarks", std::move(remarks)}});
  }
  Json remarks = Json::array();
  for (const EffectRemark& remark : report.fit.remarks) {
    if (remark.effect < 0) {
      remarks.push_back({{"kind", kind_name(remark.kind)}, {"text", remark.text}});
    }
  }
  const bool heldout = report.heldout_rms.size() != 0;
  return {{"list", std::move(effects)},
          {"remarks", std::move(remarks)},
          {"converged", report.fit.converged},
          {"rms_without", numbers(report.fit.rms_without)},
          {"rms", numbers(report.fit.rms)},
          {"heldout_rms_without", heldout ? numbers(report.heldout_rms_without) : Json(nullptr)},
          {"heldout_rms", heldout ? numbers(report.heldout_rms) : Json(nullptr)}};
}

}  // namespace dyngen::runtime

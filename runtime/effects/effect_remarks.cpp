// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_remarks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kUnseenPart = 1e-4;  // of a direction of unit length

/// Names of unknowns, for sentences.
std::vector<std::string> names_of(const EffectRecordings& data, const EffectPoint& point,
                                  const EffectUnknowns& unknowns) {
  std::vector<std::string> names(static_cast<std::size_t>(unknowns.size));
  for (int i = 0; i < unknowns.base; ++i) {
    names[static_cast<std::size_t>(i)] = data.model.parameters[static_cast<std::size_t>(i)].name;
  }
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    for (std::size_t p = 0; p < unknowns.parameters[k].size(); ++p) {
      const int place = unknowns.parameters[k][p];
      if (place < 0) continue;
      names[static_cast<std::size_t>(place)] =
          fmt::format("{} of {}", effect.law.parameters[p].name, name_of(effect));
    }
    for (std::size_t r = 0; r < unknowns.initial.size(); ++r) {
      for (std::size_t s = 0; unknowns.initial[r][k] >= 0 && s < effect.law.states.size(); ++s) {
        names[static_cast<std::size_t>(unknowns.initial[r][k]) + s] = fmt::format(
            "the first {} of {} in run {}", effect.law.states[s], name_of(effect), r + 1);
      }
    }
  }
  return names;
}

std::vector<EffectRemark> remarks_on_unseen(const EffectRecordings& data, const EffectPoint& point,
                                            const EffectUnknowns& unknowns, const Estimate& all) {
  const std::vector<std::string> names = names_of(data, point, unknowns);
  std::vector<EffectRemark> remarks;
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    for (const int place : unknowns.parameters[k]) {
      if (!is_unseen(all, place)) continue;
      // the direction in which this one cannot be told from others
      const VectorXd direction = all.unseen * all.unseen.row(place).transpose();
      std::string with;
      for (int i = 0; i < unknowns.size; ++i) {
        if (i == place || std::abs(direction[i]) < 1e-2 * std::abs(direction[place])) continue;
        with += (with.empty() ? "" : ", ") + names[static_cast<std::size_t>(i)];
      }
      const std::string& name = names[static_cast<std::size_t>(place)];
      remarks.push_back({EffectRemark::Kind::kNotSeen, static_cast<int>(k),
                         with.empty()
                             ? fmt::format("{} changes nothing in these recordings", name)
                             : fmt::format("these recordings cannot tell {} from {}", name, with)});
    }
  }
  return remarks;
}

/// Whether a scale that stands at its bound would gain nothing if that were twice as far: a
/// warm-up that lasts longer than the recordings.
bool flat_beyond(const EffectPoint& point, const ConstraintName& name, double multiplier) {
  constexpr double kNothing = 1;  // of chi-square
  if (name.kind != ConstraintName::Kind::kBound || name.effect < 0) return false;
  const EffectLaw& law = point.effects[static_cast<std::size_t>(name.effect)].law;
  return by_logarithm(law.parameters[static_cast<std::size_t>(name.parameter)]) &&
         2 * multiplier * std::numbers::ln2 < kNothing;
}

/// What is wrong where a requirement holds the estimate, after a colon; nothing of a bound.
std::string reason_of(const EffectPoint& point, const ConstraintName& name) {
  if (name.kind != ConstraintName::Kind::kRequirement) return "";
  const EffectLaw& law = point.effects[static_cast<std::size_t>(name.effect)].law;
  std::string reason;
  for (const EffectCondition& condition : law.requirements) {
    if (condition.spelling == name.text && !condition.text.empty()) reason += ": " + condition.text;
  }
  return reason;
}

std::vector<EffectRemark> remarks_on_held(const EffectPoint& point,
                                          const EffectSearch::Held& held) {
  std::vector<EffectRemark> remarks;
  for (std::size_t i = 0; i < held.constraints.names.size(); ++i) {
    const ConstraintName& name = held.constraints.names[i];
    const double multiplier = held.multipliers[static_cast<Index>(i)];
    if (!(multiplier > 0) || name.kind == ConstraintName::Kind::kInitial) continue;
    if (flat_beyond(point, name, multiplier)) continue;
    const std::string whose = name.effect >= 0
                                  ? name_of(point.effects[static_cast<std::size_t>(name.effect)])
                                  : fmt::format("the friction of joint {}", name.joint + 1);
    remarks.push_back({EffectRemark::Kind::kAtBound, name.effect,
                       fmt::format("{}: the estimate is held at {}{}", whose, name.text,
                                   reason_of(point, name))});
  }
  return remarks;
}

std::vector<EffectRemark> remarks_on_falsified(const EffectPoint& point,
                                               const ScaleTable& scales_of_joints) {
  std::vector<EffectRemark> remarks;
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    const EffectScales scales = scales_of_joints.of(point.beta, effect);
    for (const EffectCondition& condition : effect.law.falsifiers) {
      if (condition.slack(effect.parameters, scales) >= 0) continue;
      remarks.push_back(
          {EffectRemark::Kind::kFalsified, static_cast<int>(k),
           fmt::format("{}: {} does not hold{}{}", name_of(effect), condition.spelling,
                       condition.text.empty() ? "" : ": ", condition.text)});
    }
  }
  return remarks;
}

std::vector<EffectRemark> remarks_on_unusual(const EffectPoint& point, const ScaleTable& scales) {
  std::vector<EffectRemark> remarks;
  for (std::size_t k = 0; k < point.effects.size(); ++k) {
    const EffectInstance& effect = point.effects[k];
    for (const std::string& value : unusual_values(effect, scales.of(point.beta, effect))) {
      remarks.push_back({EffectRemark::Kind::kUnusual, static_cast<int>(k),
                         fmt::format("{}: {}", name_of(effect), value)});
    }
  }
  return remarks;
}

}  // namespace

std::vector<std::string> unusual_values(const EffectInstance& effect, const EffectScales& scales) {
  std::vector<std::string> texts;
  for (const EffectCondition* condition : effect.law.unusual(effect.parameters, scales)) {
    std::vector<std::string> values;
    for (const int p : condition->parameters) {
      const EffectParameter& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
      const bool plain = parameter.unit.empty() || parameter.unit == "1";
      values.push_back(fmt::format("{} = {:.3g}{}", parameter.name, effect.parameters[p],
                                   plain ? "" : " " + parameter.unit));
    }
    texts.push_back(fmt::format(
        "{}{}unusual, {}", fmt::join(values, ", "), values.empty() ? "" : ": ",
        condition->text.empty() ? condition->spelling + " does not hold" : condition->text));
  }
  return texts;
}

std::string name_of(const EffectInstance& effect) {
  const int joint = effect.link > 0 ? effect.link : effect.joint + 1;
  if (joint == 0) return effect.law.name;
  std::string text = fmt::format("{} of joint {}", effect.law.name, joint);
  if (effect.law.scope == EffectScope::kPair) text += fmt::format(" and {}", effect.other + 1);
  return text;
}

bool is_unseen(const Estimate& all, int place) {
  return place >= 0 && all.unseen.cols() > 0 && all.unseen.row(place).norm() >= kUnseenPart;
}

std::vector<bool> unseen_among(const Estimate& all, const EffectUnknowns& unknowns) {
  std::vector<bool> unseen(static_cast<std::size_t>(unknowns.size), false);
  for (const std::vector<int>& places : unknowns.parameters) {
    for (const int place : places) {
      if (is_unseen(all, place)) unseen[static_cast<std::size_t>(place)] = true;
    }
  }
  return unseen;
}

std::vector<EffectRemark> effect_remarks(const EffectRecordings& data, const ScaleTable& scales,
                                         const EffectPoint& point, const EffectUnknowns& unknowns,
                                         const Estimate& all, const EffectSearch::Held& held) {
  std::vector<EffectRemark> remarks = remarks_on_unseen(data, point, unknowns, all);
  for (const auto& more : {remarks_on_held(point, held), remarks_on_falsified(point, scales),
                           remarks_on_unusual(point, scales)}) {
    remarks.insert(remarks.end(), more.begin(), more.end());
  }
  return remarks;
}

}  // namespace dyngen::runtime

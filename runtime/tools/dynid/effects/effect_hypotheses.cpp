// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_hypotheses.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "runtime/effects/absorption.h"
#include "runtime/tools/dynid/effects/effect_laws.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

bool has_temperature(const MotionSource& recording) {
  bool has = true;
  recording.pieces(
      [&](const StreamPiece& piece) { has = has && piece.motion.temperature.size() != 0; });
  return has;
}

/// Whether the typical number of a given parameter is one of this machine too.
bool is_believed(const ::dyngen::EffectParameter& parameter, bool of_user) {
  if (!names_in(parameter.typical).empty()) return false;
  return of_user || parameter.unit != "m";
}

bool is_of_user(const EffectFile& effect) {
  static const EffectCatalogue kOwn;
  const auto own = kOwn.find(effect.name);
  return own == nullptr || own->file_name != effect.file_name;
}

/// NaN where they are looked for; nothing where a given one has no number.
std::optional<VectorXd> known_parameters(const EffectLaw& law, const EffectCatalogue& catalogue) {
  const EffectFile& file = *catalogue.find(law.name);
  const bool of_user = is_of_user(file);
  const VectorXd typical = law.sizes({}).typical;
  VectorXd known = VectorXd::Constant(law.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t p = 0; p < law.parameters.size(); ++p) {
    if (law.parameters[p].role != EffectRole::kGiven) continue;
    if (!is_believed(file.parameters[p], of_user)) return std::nullopt;
    known[static_cast<Index>(p)] = typical[static_cast<Index>(p)];
  }
  return known;
}

}  // namespace

std::vector<EffectInstance> possible_effects(const DescribedRobot& robot,
                                             const EffectCatalogue& catalogue) {
  std::vector<std::pair<int, int>> pairs;
  for (const EffectInstance& row : effect_instances(robot.model, catalogue)) {
    if (row.other >= 0 && row.joint >= 0) pairs.emplace_back(row.joint, row.other);
  }
  std::vector<EffectInstance> effects = atlas_effects(robot.linear, effect_laws(catalogue), pairs);
  for (EffectInstance& effect : effects) {
    for (int j = 1; j <= robot.model.size(); ++j) {
      if (effect.joint >= 0 && robot.model.joint(j).coordinate == effect.joint) effect.link = j;
    }
  }
  return effects;
}

std::vector<EffectInstance> competing_effects(const DescribedRobot& robot,
                                              const EffectCatalogue& catalogue,
                                              const std::vector<MotionSource>& recordings) {
  const bool temperature = std::all_of(recordings.begin(), recordings.end(), has_temperature);
  std::vector<EffectInstance> competing;
  for (EffectInstance& effect : possible_effects(robot, catalogue)) {
    if (!temperature && effect.law.reads("temp")) continue;
    if (std::optional<VectorXd> known = known_parameters(effect.law, catalogue)) {
      effect.parameters = std::move(*known);
      competing.push_back(std::move(effect));
    }
  }
  return competing;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_law.h"

#include <algorithm>

namespace dyngen::runtime {

bool EffectLaw::reads(std::string_view variable) const {
  return std::find(variables.begin(), variables.end(), variable) != variables.end();
}

std::vector<const EffectCondition*> EffectLaw::unusual(const Eigen::VectorXd& values,
                                                       const EffectScales& scales) const {
  std::vector<const EffectCondition*> broken;
  for (const EffectCondition& condition : usual) {
    if (condition.slack(values, scales) < 0) broken.push_back(&condition);
  }
  return broken;
}

int slower_than_recording(const EffectLaw& law, const EffectScales& scales) {
  constexpr double kEndless = 1e12;  // s
  EffectScales longer = scales;
  longer.duration = kEndless;
  const EffectSizes here = law.sizes(scales), there = law.sizes(longer);
  for (int p = 0; p < law.size(); ++p) {
    const EffectRole role = law.parameters[static_cast<std::size_t>(p)].role;
    if (role != EffectRole::kShape && role != EffectRole::kScanned) continue;
    if (here.min[p] > here.max[p] && there.min[p] <= there.max[p]) return p;
  }
  return -1;
}

Eigen::VectorXd first_states(const EffectLaw& law, const Eigen::MatrixXd& variables) {
  if (!law.start || variables.rows() == 0) {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(law.states.size()));
  }
  return law.start(variables.row(0));
}

}  // namespace dyngen::runtime

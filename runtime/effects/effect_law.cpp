// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_law.h"

#include <algorithm>

namespace dyngen::runtime {

bool EffectLaw::reads(std::string_view variable) const {
  return std::find(variables.begin(), variables.end(), variable) != variables.end();
}

Eigen::VectorXd first_states(const EffectLaw& law, const Eigen::MatrixXd& variables) {
  if (!law.start || variables.rows() == 0) {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(law.states.size()));
  }
  return law.start(variables.row(0));
}

}  // namespace dyngen::runtime

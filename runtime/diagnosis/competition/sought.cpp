// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/sought.h"

#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

std::vector<int> Sought::joints(std::size_t hypothesis) const {
  return joints_of(hypotheses[hypothesis].effect, scales.model().joints());
}

std::size_t Sought::parameters(std::size_t hypothesis) const {
  return hypotheses[hypothesis].linear.size() + hypotheses[hypothesis].shapes.size();
}

double Sought::net(const NamedResult& named, const TorqueNoiseModel& noise) const {
  return net_of(hypotheses[named.hypothesis], named.best, noise);
}

Standing Sought::standing(const NamedResult& named, const TorqueNoiseModel& noise) const {
  return {net(named, noise), parameters(named.hypothesis)};
}

Sought sought_in(const EffectRecordings& evidence, const std::vector<Hypothesis>& hypotheses) {
  return {hypotheses, structures_of(evidence), ScaleTable(evidence)};
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/loop_disturbance.h"

#include <algorithm>
#include <cmath>

#include "runtime/evidence/motion_innovations.h"

namespace dyngen::runtime {

LoopDisturbance::LoopDisturbance(const EffectRecordings& data, const TorqueNoiseModel& noise,
                                 double false_alarm)
    : columns_(noise.from_periods ? std::vector<JointColumns>() : motion_innovations(data, noise)),
      surprise_(std::log(std::max<double>(1, static_cast<double>(columns_.size())) / false_alarm)) {
}

std::vector<int> LoopDisturbance::joints_beside(const EvidenceSystem& system) const {
  std::vector<int> joints;
  for (const JointColumns& own : columns_) {
    const int joint = own.joints.front();
    const Score score = score_of(system.products(system.whitened(own), false), false);
    const double surprise = surprise_of(score.delta_chi2, score.degrees, system.worth(joint));
    if (surprise > surprise_) joints.push_back(joint);
  }
  return joints;
}

std::optional<Score> LoopDisturbance::beside_it(const EvidenceSystem& system,
                                                const JointColumns& white,
                                                const JointColumns& more) const {
  if (columns_.empty()) return std::nullopt;
  EvidenceSystem beside_effect = system;
  beside_effect.add(more);
  const std::vector<int> seen = joints_beside(beside_effect);
  if (seen.empty()) return std::nullopt;
  EvidenceSystem beside = system;
  for (const JointColumns& own : columns_) {
    if (std::find(seen.begin(), seen.end(), own.joints.front()) == seen.end()) continue;
    beside.add(beside.whitened(own));
  }
  return score_of(beside.products(white, false), false);
}

}  // namespace dyngen::runtime

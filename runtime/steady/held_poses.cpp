// SPDX-License-Identifier: MIT
#include "runtime/steady/held_poses.h"

#include <cmath>

#include "runtime/estimation/distributions.h"
#include "runtime/steady/mean_noise.h"
#include "runtime/steady/steady_runs.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSurePose = 0.95;

/// Poses of all recordings with the mean torque of one joint in each.
struct HeldTorques {
  std::vector<HeldPose> poses;
  VectorXd torque;      ///< (P)
  MatrixXd covariance;  ///< (P x P)
  int degrees = 1;
};

HeldTorques held_torques(const std::vector<std::shared_ptr<const Recording>>& recordings,
                         Index joint, const SteadyRules& rules) {
  HeldTorques held;
  std::vector<double> means;
  std::vector<CosinePowers> powers;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (HeldPose& pose : find_held_poses(*recordings[i], rules)) {
      if (pose.from[joint] == 0) continue;
      pose.stretch.recording = static_cast<int>(i);
      const VectorXd tau =
          recordings[i]->tau.col(joint).segment(pose.stretch.first, pose.stretch.count);
      means.push_back(tau.mean());
      stretches.push_back(pose.stretch);
      powers.push_back(cosine_powers(pose.stretch, tau.array() - tau.mean(), rules));
      held.poses.push_back(std::move(pose));
    }
  }
  if (held.poses.empty()) return held;
  held.torque = Eigen::Map<const VectorXd>(means.data(), static_cast<Index>(means.size()));
  const MeanNoise noise = fit_mean_noise(powers, rules);
  held.covariance = covariance_of_means(noise, stretches);
  held.degrees = noise.degrees;
  return held;
}

MeanTorque weighted(const HeldTorques& held, const VectorXd& weights) {
  const double value = weights.dot(held.torque);
  const double half = student_interval(kSurePose, held.degrees) *
                      std::sqrt(std::max(0.0, weights.dot(held.covariance * weights)));
  return {value, value - half, value + half};
}

}  // namespace

HeldPairs held_pairs(const std::vector<std::shared_ptr<const Recording>>& recordings, Index joint,
                     const SteadyRules& rules) {
  HeldPairs result;
  const HeldTorques held = held_torques(recordings, joint, rules);
  const auto count = static_cast<Index>(held.poses.size());
  std::vector<bool> used(held.poses.size(), false);
  for (Index i = 0; i < count; ++i) {
    if (used[static_cast<std::size_t>(i)]) continue;
    HeldPair pair;
    pair.q = held.poses[static_cast<std::size_t>(i)].q;
    VectorXd below = VectorXd::Zero(count), above = VectorXd::Zero(count);
    for (Index k = i; k < count; ++k) {
      const HeldPose& other = held.poses[static_cast<std::size_t>(k)];
      if ((other.q - pair.q).cwiseAbs().maxCoeff() > rules.same_posture) continue;
      used[static_cast<std::size_t>(k)] = true;
      (other.from[joint] < 0 ? below : above)[k] = 1;
    }
    pair.from_below = static_cast<int>(below.sum());
    pair.from_above = static_cast<int>(above.sum());
    if (pair.from_below == 0 || pair.from_above == 0) {
      ++result.one_sided;
      continue;
    }
    below /= below.sum();
    above /= above.sum();
    pair.below = weighted(held, below);
    pair.above = weighted(held, above);
    pair.gravity = weighted(held, 0.5 * (below + above));
    pair.friction = weighted(held, 0.5 * (below - above));
    result.pairs.push_back(std::move(pair));
  }
  return result;
}

}  // namespace dyngen::runtime

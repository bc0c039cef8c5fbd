// SPDX-License-Identifier: MIT
#include "runtime/plausibility/sign_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/plausibility/readings.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kFitsAsWell = 1.1;  // of what is left of torque: the turned sign fits as well
constexpr double kCertain = 5;       // standard deviations below zero

/// Whether friction of a joint drives it: both of its parameters are negative, and one certainly
/// is.
bool friction_drives(const LinearModel& model, const TrialFit& fit, Index joint) {
  const VectorXd deviation = deviations_of(fit);
  bool certain = false;
  for (const int c : model.columns[static_cast<std::size_t>(joint)]) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(c)];
    const bool friction =
        parameter.kind == ParameterKind::kViscous || parameter.kind == ParameterKind::kCoulomb;
    if (friction) certain = certain || fit.estimate.beta[c] < -kCertain * deviation[c];
  }
  return certain && fit.power[joint] < 0;
}

}  // namespace

void add_sign_remarks(const LinearModel& model, const TrialSamples& samples, const TrialFit& plain,
                      std::vector<Remark>& remarks) {
  Reading turned = Reading::plain(model.joints());
  std::vector<Index> suspects;
  for (Index j = 0; j < model.joints(); ++j) {
    if (plain.inertia[j] >= 0 && !friction_drives(model, plain, j)) continue;
    turned.torque_factor[j] = -1;
    suspects.push_back(j);
  }
  if (suspects.empty()) return;
  const TrialFit other = samples.fit(model, turned);
  for (const Index j : suspects) {
    const bool mends = other.left[j] <= kFitsAsWell * plain.left[j] && other.inertia[j] > 0 &&
                       other.power[j] > plain.power[j];
    if (!mends) continue;
    remarks.push_back(
        {"torque_sign", true, static_cast<int>(j) + 1, "",
         fmt::format("{} of joint {} comes out negative: is the sign of tau{}, or of q{}, turned? "
                     "With the other sign it comes out positive, and the torque is explained as "
                     "well: {:.2g} % of it is left",
                     plain.inertia[j] < 0 ? "inertia" : "friction", j + 1, j + 1, j + 1,
                     100 * other.left[j])});
  }
}

}  // namespace dyngen::runtime

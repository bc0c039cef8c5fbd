// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/sufficiency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/effects/effect_fit.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

VectorXd predicted_variance(const EffectRecordings& train, const EffectRecordings& heldout) {
  const EffectFit fit = fit_effects(train, {});
  const Index nb = train.model.size();
  VectorXd sums = VectorXd::Zero(train.joints()), counts = sums;
  for (const EffectRun& run : heldout.runs) {
    for (Index j = 0; j < sums.size(); ++j) {
      const MatrixXd Y = run.rows.Y.middleCols(j * nb, nb);
      sums[j] += (Y * fit.base.covariance).cwiseProduct(Y).sum();
      counts[j] += run.rows.counted.col(j).sum();
    }
  }
  const VectorXd squares = fit.rms.cwiseAbs2().cwiseMax(1e-300);
  return sums.cwiseQuotient(counts.cwiseMax(1)).cwiseQuotient(squares);
}

std::string why_too_few(const EffectRecordings& train, const EquationRules& rules) {
  for (int j = 0; j < train.joints(); ++j) {
    double rows = 0;
    for (const EffectRun& run : train.runs) rows += run.rows.counted.col(j).sum();
    const auto parameters =
        static_cast<double>(train.model.columns[static_cast<std::size_t>(j)].size());
    if (rows >= rules.least_equations + 2 * parameters) continue;
    return fmt::format(
        "The recordings hold {:.0f} equations of joint {} for {:.0f} parameters: too few to test "
        "what the model leaves.",
        rows, j + 1, parameters);
  }
  return {};
}

std::string why_too_little_motion(const EffectRecordings& train, const EffectRecordings& heldout,
                                  const EquationRules& rules) {
  Index joint = 0;
  const VectorXd predicted = predicted_variance(train, heldout);
  const double most = predicted.maxCoeff(&joint);
  if (most <= rules.most_predicted) return {};
  return fmt::format(
      "What the recordings leave open of the parameters moves the held-out torque of joint {} by "
      "{:.0f} % of what the fit leaves: too little motion to tell structure from a wrong fit.",
      joint + 1, 100 * std::sqrt(most));
}

}  // namespace dyngen::runtime

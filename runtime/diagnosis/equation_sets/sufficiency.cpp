// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/sufficiency.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/effects/effect_fit.h"
#include "runtime/effects/equation_stack.h"
#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/posture_scale.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Parameters that the counted equations of a joint determine: the rank of its regressor, columns
/// of unit norm.
double determined_parameters(const EffectRecordings& train, int joint) {
  const std::vector<int>& columns = train.model.columns[static_cast<std::size_t>(joint)];
  MatrixXd W(train.equations(), static_cast<Index>(columns.size()));
  Index start = 0;
  for (const EffectRun& run : train.runs) {
    const auto counted = run.rows.counted.col(joint);
    for (Index i = 0; i < W.cols(); ++i) {
      const Index column = Index{joint} * train.model.size() + columns[static_cast<std::size_t>(i)];
      W.col(i).segment(start, counted.size()) = run.rows.Y.col(column).cwiseProduct(counted);
    }
    start += counted.size();
  }
  if (W.size() == 0) return 0;
  W = W * unit_scale(W).asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(W.rows(), W.cols());
  qr.setThreshold(kRankTolerance);
  return static_cast<double>(qr.compute(W).rank());
}

/// Combinations of parameters that an estimate does not see. Each may be as large as those that it
/// sees are on average. @return (nb x combinations), each of that size
MatrixXd hidden_combinations(const Estimate& estimate) {
  if (estimate.unseen.cols() == 0) return MatrixXd::Zero(estimate.beta.size(), 0);
  const VectorXd scale = scale_of_postures(estimate.scale);
  const VectorXd scaled = (scale.array() > 0).select(estimate.beta.array() / scale.array(), 0.0);
  const double size = scaled.norm() / std::sqrt(std::max(1.0, static_cast<double>(estimate.rank)));
  // orthonormal in these units: what a posture hides is as large as the rest, not as its column is
  // short
  const MatrixXd hidden = estimate.scale.cwiseQuotient(scale).asDiagonal() * estimate.unseen;
  return size * (scale.asDiagonal() * orthonormal(hidden));
}

}  // namespace

double equations_of_joint(const EffectRecordings& data, int joint) {
  double rows = 0;
  for (const EffectRun& run : data.runs) rows += run.rows.counted.col(joint).sum();
  return rows;
}

VectorXd predicted_variance(const EffectRecordings& train, const EffectRecordings& heldout) {
  const EffectFit fit = fit_effects(train, {});
  const Index nb = train.model.size();
  VectorXd sums = VectorXd::Zero(train.joints()), counts = sums;
  const MatrixXd hidden = hidden_combinations(fit.base);
  for (const EffectRun& run : heldout.runs) {
    for (Index j = 0; j < sums.size(); ++j) {
      const MatrixXd Y = run.rows.Y.middleCols(j * nb, nb);
      sums[j] += (Y * fit.base.covariance).cwiseProduct(Y).sum() + (Y * hidden).squaredNorm();
      counts[j] += run.rows.counted.col(j).sum();
    }
  }
  const VectorXd squares = fit.rms.cwiseAbs2().cwiseMax(1e-300);
  return sums.cwiseQuotient(counts.cwiseMax(1)).cwiseQuotient(squares);
}

std::vector<UnjudgedJoint> unjudged_joints(const EffectRecordings& train,
                                           const EquationRules& rules) {
  std::vector<UnjudgedJoint> unjudged;
  for (int j = 0; j < train.joints(); ++j) {
    UnjudgedJoint own{j, equations_of_joint(train, j), rules.least_equations, {}};
    const double parameters = own.equations > 0 ? determined_parameters(train, j) : 0;
    own.needed += 2 * parameters;
    if (own.equations >= own.needed) continue;
    own.why = own.equations > 0
                  ? fmt::format(
                        "joint {} has {:.0f} fitted equations for {:.0f} parameters, of "
                        "{:.0f} that it needs",
                        j + 1, own.equations, parameters, own.needed)
                  : fmt::format("joint {} stands in all fitted recordings", j + 1);
    unjudged.push_back(std::move(own));
  }
  return unjudged;
}

std::string why_too_few(const std::vector<UnjudgedJoint>& unjudged, int joints) {
  if (unjudged.size() < static_cast<std::size_t>(joints)) return {};
  std::vector<std::string> reasons;
  for (const UnjudgedJoint& own : unjudged) reasons.push_back(own.why);
  return fmt::format(
      "Every joint has too few equations to test what the model leaves: {}. Record motions in "
      "which at least one joint moves longer, or through more of its range and speeds.",
      fmt::join(reasons, "; "));
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

// SPDX-License-Identifier: MIT
#include "runtime/identification/recursive_fit.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/estimation/significance.h"
#include "runtime/recursive/convergent_mode_lms.h"
#include "runtime/recursive/gain.h"
#include "runtime/recursive/lms.h"
#include "runtime/recursive/minimum_variance.h"
#include "runtime/recursive/rls.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Every sample as generated code would give it.
void for_each_sample(const RowSource& rows, Index parameters,
                     const std::function<void(const double* Y, const double* tau)>& visit) {
  RowMajorMatrix Y;
  VectorXd tau;
  rows([&](const RowBlock& block) {
    const Index joints = block.tau.cols();
    Y.resize(joints, parameters);
    for (Index k = 0; k < block.tau.rows(); ++k) {
      for (Index j = 0; j < joints; ++j) {
        Y.row(j) = block.Y.row(k).segment(j * parameters, parameters);
      }
      tau = block.tau.row(k).transpose();
      visit(Y.data(), tau.data());
    }
  });
}

/// Mean of Y'Y over the samples, joints weighted: from the factor, not from the samples.
MatrixXd correlation(const TorqueFactor& equations, const VectorXd& weights) {
  const MatrixXd W = stacked(equations, weights).W;
  return W.transpose() * W / std::max(equations.samples(), 1.0);
}

/// What the recursive methods need to know before: noise of each joint, where to start.
struct Start {
  VectorXd weights;  ///< 1/sigma of each joint
  VectorXd beta;
  Prior prior;
};

Start start_of(const FitData& data, const FitOptions& options) {
  Start start;
  const TorqueFactor& equations = data.summary.equations;
  start.weights = weighted_least_squares(equations).joint_weights;
  start.beta = options.prior.size() != 0 ? options.prior : VectorXd::Zero(equations.parameters);
  // without values the size that a parameter can have at all
  start.prior = make_prior(equations, start.weights, start.beta,
                           options.prior.size() != 0 ? options.prior_relative : 50);
  return start;
}

void run_lms(FitMethod method, const FitData& data, const FitOptions& options, const Start& start,
             MethodFit& fit) {
  const int joints = static_cast<int>(start.weights.size());
  const Index nb = start.beta.size();
  const VectorXd weights = start.weights.cwiseAbs2();
  VectorXd gain = propose_gain(correlation(data.summary.equations, start.weights), 1);
  // no sample may be too strong for it: the trace bounds the largest eigenvalue of Gamma Y'Y
  double strongest = 0;
  for_each_sample(data.rows, nb, [&](const double* Y, const double*) {
    const RegressorMap rows(Y, joints, nb);
    strongest =
        std::max(strongest, (rows.array().square().matrix() * gain).cwiseProduct(weights).sum());
  });
  if (strongest > 1) gain /= strongest;
  std::int64_t used = 0, all = 0;
  const auto passes = [&](auto& estimator) {
    for (int pass = 0; pass < options.passes; ++pass) {
      for_each_sample(data.rows, nb, [&](const double* Y, const double* tau) {
        estimator.update(Y, tau);
        ++all;
      });
    }
    fit.estimate.beta = estimator.beta();
    used = estimator.samples();
  };
  if (method == FitMethod::kLms) {
    Lms lms(joints,
            {.gain = gain, .joint_weights = weights, .start = start.beta, .normalised = true});
    passes(lms);
  } else {
    ConvergentModeLms lms(joints, {.gain = gain, .joint_weights = weights, .start = start.beta});
    passes(lms);
  }
  fit.messages.push_back(fmt::format("{} passes, {} of {} samples used; no standard deviations",
                                     options.passes, used, all));
}

}  // namespace

MethodFit recursive_fit(FitMethod method, const FitData& data, const FitOptions& options) {
  const TorqueFactor& equations = data.summary.equations;
  const Start start = start_of(data, options);
  const int joints = static_cast<int>(start.weights.size());
  MethodFit fit;
  fit.method = method;
  fit.estimate = least_squares(equations, start.weights);  // for its condition and what is unseen
  const Index nb = start.beta.size();
  if (method == FitMethod::kRls) {
    // forgetting nothing and knowing nothing: exactly least squares
    Rls rls(joints, static_cast<int>(nb),
            {.forgetting = options.forgetting,
             .noise_stddev = start.weights.cwiseInverse(),
             .prior_mean = start.beta});
    for_each_sample(data.rows, nb, [&](const double* Y, const double* tau) { rls.update(Y, tau); });
    fit.estimate.beta = rls.beta();
    if (rls.determined()) {
      fit.textbook = rls.covariance().diagonal().cwiseSqrt();
    } else {
      fit.messages.push_back(
          "the samples do not determine every parameter: those keep their start");
    }
  } else if (method == FitMethod::kKalman) {
    MinimumVariance kalman(
        {.prior_mean = start.beta,
         .prior_covariance = start.prior.stddev.cwiseAbs2().asDiagonal(),
         .measurement_covariance = start.weights.cwiseInverse().cwiseAbs2().asDiagonal()});
    for_each_sample(data.rows, nb,
                    [&](const double* Y, const double* tau) { kalman.update(Y, tau); });
    fit.estimate.beta = kalman.beta();
    fit.textbook = kalman.covariance().diagonal().cwiseSqrt();
  } else {
    run_lms(method, data, options, start, fit);
  }
  return fit;
}

}  // namespace dyngen::runtime

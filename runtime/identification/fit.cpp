// SPDX-License-Identifier: MIT
#include "runtime/identification/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/errors_in_variables.h"
#include "runtime/estimation/robust.h"
#include "runtime/estimation/significance.h"
#include "runtime/identification/recursive_fit.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string_view name_of(FitMethod method) {
  return fit_method_names()[static_cast<std::size_t>(method)];
}

/// What the test and the size of what it found say together.
std::string exogeneity_words(const InstrumentalEstimate& instrumental) {
  constexpr double kChance = 0.05, kMatters = 1;  // standard deviations of a parameter
  if (instrumental.p_value >= kChance) {
    return "no sign that least squares are biased by noise in the regressor";
  }
  return fmt::format(
      "the regressor is correlated with what is left of torque, so least squares are biased: by at "
      "most {:.2g} standard deviations of a parameter{}",
      instrumental.largest_move,
      instrumental.largest_move < kMatters ? ", which hardly matters" : "");
}

class Fitter {
 public:
  Fitter(const FitData& data, const FitOptions& options) : data_(data), options_(options) {}

  MethodFit run(FitMethod method) {
    MethodFit fit = estimate(method);
    fit.method = method;
    const TorqueFactor& equations = data_.summary.equations;
    const Residual train = residual_of(equations, fit.estimate.beta);
    fit.estimate.residual_rms = train.rms;
    fit.percent = train.percent;
    if (data_.heldout) {
      const Residual heldout = residual_of(*data_.heldout, fit.estimate.beta);
      fit.heldout_rms = heldout.rms;
      fit.heldout_percent = heldout.percent;
    }
    if (fit.textbook.size() == 0 && fit.estimate.covariance.size() != 0) {
      fit.textbook = white_covariance(equations, fit.estimate.beta, fit.estimate.joint_weights,
                                      fit.estimate.scale, fit.estimate.unseen)
                         .diagonal()
                         .cwiseSqrt();
    }
    // instruments have no part in the noise of the regressor
    if (method != FitMethod::kIv && fit.estimate.covariance.size() != 0) {
      fit.estimate.covariance +=
          errors_in_variables(equations, fit.estimate, data_.summary.regressor_noise);
    }
    return fit;
  }

 private:
  MethodFit estimate(FitMethod method) {
    const TorqueFactor& equations = data_.summary.equations;
    const Index joints = static_cast<Index>(equations.joints.size());
    LeastSquaresOptions settings;
    settings.prior = options_.prior;
    MethodFit fit;
    switch (method) {
      case FitMethod::kLs:
        fit.estimate = least_squares(equations, VectorXd::Ones(joints), settings);
        add_covariance(fit, equations, data_.rows);
        return fit;
      case FitMethod::kWls:
        fit.estimate = weighted_least_squares(equations, settings);
        add_covariance(fit, equations, data_.rows);
        return fit;
      case FitMethod::kIrls:
        return robust();
      case FitMethod::kRidge:
        return drawn_to_prior();
      case FitMethod::kSvd: {
        const VectorXd weights = weighted_least_squares(equations, settings).joint_weights;
        const Significance dropped = drop_weakest(equations, weights, options_.dropped_directions);
        fit.estimate = dropped.estimate;
        add_covariance(fit, equations, data_.rows);
        fit.messages.push_back(
            fmt::format("{} of {} directions left out: condition {:.3g} -> {:.3g}",
                        equations.parameters - fit.estimate.rank, equations.parameters,
                        dropped.condition_before, dropped.condition_after));
        return fit;
      }
      case FitMethod::kIv:
        return instrumental();
      default:
        fit = recursive_fit(method, data_, options_);
        return fit;
    }
  }

  /// @param rows  empty: the noise of the summary, taken at the fits of its recordings
  NoiseFactor noise_of(const Estimate& estimate, const TorqueFactor& equations,
                       const RowSource& rows) const {
    return rows ? noise_at(estimate, equations, rows) : data_.summary.noise;
  }

  void add_covariance(MethodFit& fit, const TorqueFactor& equations, const RowSource& rows) {
    Estimate& estimate = fit.estimate;
    const NoiseFactor noise = noise_of(estimate, equations, rows);
    estimate.covariance = correlated_covariance(equations, noise, estimate.joint_weights,
                                                estimate.scale, estimate.unseen);
    fit.interval = interval_of(equations, noise);
  }

  MethodFit robust() {
    const TorqueFactor& equations = data_.summary.equations;
    const RobustEstimate robust =
        iteratively_reweighted(data_.rows, equations.columns, equations.parameters);
    MethodFit fit;
    fit.estimate = robust.estimate;
    add_covariance(fit, robust.factor, robust.rows);
    fit.textbook = white_covariance(robust.factor, fit.estimate.beta, fit.estimate.joint_weights,
                                    fit.estimate.scale, fit.estimate.unseen)
                       .diagonal()
                       .cwiseSqrt();
    fit.messages.push_back(fmt::format("{} rounds; {:.1f} % of the equations counted less",
                                       robust.rounds, 100 * robust.downweighted.mean()));
    return fit;
  }

  MethodFit drawn_to_prior() {
    const TorqueFactor& equations = data_.summary.equations;
    const VectorXd weights = weighted_least_squares(equations).joint_weights;
    const VectorXd values =
        options_.prior.size() != 0 ? options_.prior : VectorXd::Zero(equations.parameters);
    const Prior prior = make_prior(equations, weights, values, options_.prior_relative);
    MethodFit fit;
    fit.l_curve = l_curve(equations, weights, prior);
    fit.lambda = options_.lambda >= 0 ? options_.lambda : corner(fit.l_curve);
    fit.estimate = ridge(equations, weights, prior, fit.lambda);
    const NoiseFactor noise = noise_of(fit.estimate, equations, data_.rows);
    fit.estimate.covariance = ridge_covariance(equations, noise, weights, prior, fit.lambda);
    fit.interval = interval_of(equations, noise);
    fit.messages.push_back(fmt::format(
        "lambda {:.3g}{}; prior: {}", fit.lambda,
        options_.lambda >= 0 ? "" : " at the corner of the L-curve",
        options_.prior.size() != 0
            ? fmt::format("the file's values, known to {:.0f} %", 100 * options_.prior_relative)
            : std::string("zero, since the file has no values")));
    return fit;
  }

  MethodFit instrumental() {
    if (!data_.instruments) {
      throw std::invalid_argument("method iv: there are no instruments");
    }
    const TorqueFactor& equations = data_.summary.equations;
    const VectorXd weights = weighted_least_squares(equations).joint_weights;
    MethodFit fit;
    fit.instrumental =
        instrumental_variables(data_.instruments, equations.columns, equations.parameters, weights);
    fit.estimate = fit.instrumental->estimate;
    fit.messages.push_back(fmt::format(
        "Durbin-Wu-Hausman: chi-square {:.1f} with {} degrees of freedom, p = {:.3g}: {}",
        fit.instrumental->hausman, fit.instrumental->degrees, fit.instrumental->p_value,
        exogeneity_words(*fit.instrumental)));
    return fit;
  }

  const FitData& data_;
  const FitOptions& options_;
};

}  // namespace

bool needs_samples(FitMethod method) {
  switch (method) {
    case FitMethod::kIrls:
    case FitMethod::kLms:
    case FitMethod::kLmsMode:
    case FitMethod::kRls:
    case FitMethod::kKalman:
    case FitMethod::kIv:
      return true;
    default:
      return false;
  }
}

const std::vector<std::string_view>& fit_method_names() {
  static const std::vector<std::string_view> names = {"ls",  "wls",      "irls", "ridge",  "svd",
                                                      "lms", "lms-mode", "rls",  "kalman", "iv"};
  return names;
}

std::optional<FitMethod> parse_fit_method(std::string_view name) {
  const auto& names = fit_method_names();
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) return std::nullopt;
  return static_cast<FitMethod>(place - names.begin());
}

std::vector<MethodFit> fit_methods(const LinearModel& model, const FitData& data,
                                   const FitOptions& options, const FitProgress& progress) {
  if (data.summary.equations.parameters != model.size()) {
    throw std::invalid_argument(fmt::format("fit_methods(): data of {} parameters, {} has {}",
                                            data.summary.equations.parameters, model.name,
                                            model.size()));
  }
  for (const FitMethod method : options.methods) {
    if (needs_samples(method) && !data.rows) {
      throw std::invalid_argument(fmt::format(
          "method {} looks at single samples: it needs recordings, not summaries of them",
          name_of(method)));
    }
  }
  Fitter fitter(data, options);
  std::vector<MethodFit> fits;
  for (const FitMethod method : options.methods) {
    if (progress) {
      progress(fmt::format("fitting: {}", name_of(method)),
               static_cast<double>(fits.size()) / static_cast<double>(options.methods.size()));
    }
    fits.push_back(fitter.run(method));
  }
  return fits;
}

Residual residual_of(const TorqueFactor& equations, const VectorXd& beta) {
  Residual result{residual_squares(equations, beta), torque_squares(equations)};
  for (Index j = 0; j < result.rms.size(); ++j) {
    const double squares = result.rms[j], torque = result.percent[j];
    const double rows = equations.joints[static_cast<std::size_t>(j)].rows;
    const double none = std::numeric_limits<double>::quiet_NaN();
    result.rms[j] = rows > 0 ? std::sqrt(squares / rows) : none;
    result.percent[j] = torque > 0 ? 100 * std::sqrt(squares / torque) : none;
  }
  return result;
}

}  // namespace dyngen::runtime

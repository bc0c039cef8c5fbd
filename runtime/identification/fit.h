// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/estimation/instruments.h"
#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/ridge.h"
#include "runtime/identification/summary.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// How parameters are estimated.
enum class FitMethod {
  kLs,       ///< ordinary least squares by QR
  kWls,      ///< joints weighted by their residual
  kIrls,     ///< that, and Huber's weights for single samples
  kRidge,    ///< that of kWls, drawn to the file's values
  kSvd,      ///< that of kWls without the weakest directions
  kLms,      ///< least mean squares, sample by sample
  kLmsMode,  ///< least mean squares along the convergent mode
  kRls,      ///< recursive least squares
  kKalman,   ///< the minimum variance estimator
  kIv,       ///< instrumental variables with a simulated regressor
};

/// "ls", "wls", ... in the order of FitMethod.
const std::vector<std::string_view>& fit_method_names();
/// @return empty if there is no such method
std::optional<FitMethod> parse_fit_method(std::string_view name);
/// Whether it looks at single samples, so that a summary is not enough for it.
bool needs_samples(FitMethod method);

/// What there is to fit.
struct FitData {
  RecordingSummary summary;             ///< of all training recordings
  RowSource rows;                       ///< their equations; empty if there are summaries alone
  InstrumentSource instruments;         ///< empty if there are none
  std::optional<TorqueFactor> heldout;  ///< equations of held-out recordings
};

struct FitOptions {
  std::vector<FitMethod> methods = {FitMethod::kWls};
  int dropped_directions = -1;  ///< of kSvd; negative: those that are not significant
  double prior_relative = 0.3;  ///< of kRidge and the recursive methods: how well values are known
  double lambda = -1;           ///< of kRidge; negative: the corner of the L-curve
  double forgetting = 1;        ///< of kRls
  int passes = 5;               ///< of kLms, kLmsMode: times over the data
  Eigen::VectorXd prior;        ///< (nb) values known before; empty: none, zeros stand for them
};

/// What one method found.
struct MethodFit {
  FitMethod method = FitMethod::kWls;
  Estimate estimate;            ///< covariance: for correlated noise where the method has one
  Eigen::VectorXd textbook;     ///< (nb) standard deviations as if noise were white
  Eigen::VectorXd percent;      ///< (n) residual norm over torque norm, of the fit
  Eigen::VectorXd heldout_rms;  ///< (n) N m or N; empty without held-out recordings
  Eigen::VectorXd heldout_percent;
  double interval = 1.96;            ///< a 95 % interval is beta +- interval * stddev
  std::vector<LCurvePoint> l_curve;  ///< of kRidge
  double lambda = 0;
  std::optional<InstrumentalEstimate> instrumental;  ///< of kIv
  std::vector<std::string> messages;

  [[nodiscard]] Eigen::VectorXd stddev() const { return estimate.stddev(); }
};

/// Told how far the work is: a name and a fraction.
using FitProgress = std::function<void(const std::string& what, double done)>;

/// All methods that are asked for, on the same data.
/// @throws std::invalid_argument  if a method needs samples (or instruments) and there are none
std::vector<MethodFit> fit_methods(const LinearModel& model, const FitData& data,
                                   const FitOptions& options, const FitProgress& progress = {});

/// Residual of given parameters against equations: rms and percent of torque, (n) each; NaN of a
/// joint without equations, or without torque.
struct Residual {
  Eigen::VectorXd rms, percent;
};
Residual residual_of(const TorqueFactor& equations, const Eigen::VectorXd& beta);

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/diagnosis/diagnosis.h"

namespace dyngen::runtime {

/// Samples of a joint that move one way, in bins of a variable. (bins) each; NaN where there are
/// too few samples.
struct DirectionView {
  int direction = 0;  ///< 1 forward, -1 backward, 0 both
  /// What the model alone leaves, N m or N: mean, and the quantiles 0.25 and 0.75.
  Eigen::VectorXd left, left_low, left_high;
  /// What the findings explain of it.
  Eigen::VectorXd explained;
  /// What is left without this effect and with all others, fitted.
  Eigen::VectorXd effect, effect_low, effect_high;
  /// The effect, and its band of 95 % by the covariance of its parameters; empty where it has none.
  Eigen::VectorXd model, model_low, model_high;
};

/// What is left of a joint's torque over one variable.
struct CoordinateView {
  std::string variable;  ///< "qd2", "distance2", "t"; "phase2": a turn of a ripple, rad
  Eigen::VectorXd x;     ///< (bins) ascending
  std::vector<DirectionView> directions;
  Eigen::VectorXd cloud_x;  ///< of the samples that are drawn
};

/// Training samples of one joint as charts of a finding need them.
struct ResidualView {
  int joint = 0;                     ///< coordinate, from 0
  std::vector<CoordinateView> over;  ///< the variable in which it collapses first
  std::size_t plot = 0;              ///< place of the variable that its effect is drawn over
  Eigen::VectorXd left, effect;      ///< of the samples that are drawn, as in DirectionView
  Eigen::VectorXi direction;         ///< of them
  double size = 0, peak = 0;         ///< rms and largest value of the effect, N m or N
  double torque = 0;                 ///< rms of the recorded torque
};

/// Torque of a recording that was not fitted, thinned to its least and largest values.
struct HeldoutView {
  std::string recording;
  Eigen::VectorXd time;  ///< (N) s from the recording's first sample
  /// (N x n) N m or N: recorded torque, model with findings, and what both models leave
  Eigen::MatrixXd torque, model, before, after;
};

/// All that charts show of a diagnosis.
struct DiagnosisViews {
  std::vector<ResidualView> findings;     ///< in their order; of a change since a reference none
  std::vector<ResidualView> unexplained;  ///< in their order; `effect` and `model` are empty
  std::vector<HeldoutView> heldout;       ///< a view for each run
};

/// How much is drawn.
struct ViewBudget {
  Eigen::Index bins = 72;
  Eigen::Index points = 8000;    ///< of all clouds together
  Eigen::Index values = 240000;  ///< of all held-out signals together
};
/// Slices into which held-out signals are thinned. @param share  of a run in all samples
Eigen::Index heldout_slices(const ViewBudget& budget, Eigen::Index joints, double share);

/// @param plots  of each finding, the variable that its effect is drawn over as effect files say
///               it: "qd", "tau_load", "distance"; empty: none
/// Costs 2 + 2 np passes over the training samples for each finding of np parameters.
DiagnosisViews views_for_report(const DiagnosedRecordings& recordings,
                                const std::vector<std::string>& plots,
                                const ViewBudget& budget = {});

}  // namespace dyngen::runtime

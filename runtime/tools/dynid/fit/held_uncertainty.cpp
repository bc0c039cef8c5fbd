// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/held_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/effects/effect_signals.h"
#include "runtime/estimation/decompositions.h"
#include "runtime/signals/decimation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Held numbers that have a standard deviation: their places and the torque of one unit of each.
class UncertainNumbers {
 public:
  explicit UncertainNumbers(const DescribedRobot& robot) : alone_(robot.held_alone) {
    const VectorXd& all = robot.held.deviations;
    for (Index i = 0; i < all.size(); ++i) {
      if (all[i] > 0) places_.push_back(i);
    }
    deviations_ = all(places_);
  }

  [[nodiscard]] Index size() const { return deviations_.size(); }
  [[nodiscard]] const VectorXd& deviations() const { return deviations_; }

  /// (N x n * size()), joint by joint as LinearModel::regressor
  [[nodiscard]] MatrixXd torques(const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq) const {
    const LinearModel& model = alone_->linear;
    const MatrixXd units = alone_->grouping(Eigen::all, places_);
    MatrixXd Y;
    model.regressor(q, dq, ddq, Y);
    MatrixXd result(q.rows(), model.joints() * size());
    for (Index j = 0; j < model.joints(); ++j) {
      result.middleCols(j * size(), size()) = Y.middleCols(j * model.size(), model.size()) * units;
    }
    return result;
  }

 private:
  std::shared_ptr<const DescribedRobot> alone_;
  std::vector<Index> places_;
  VectorXd deviations_;
};

/// Columns of each joint side by side: (N x n * (a + b)).
MatrixXd side_by_side(const MatrixXd& A, const MatrixXd& B, Index joints) {
  const Index a = A.cols() / joints, b = B.cols() / joints;
  MatrixXd both(A.rows(), A.cols() + B.cols());
  for (Index j = 0; j < joints; ++j) {
    both.middleCols(j * (a + b), a) = A.middleCols(j * a, a);
    both.middleCols(j * (a + b) + a, b) = B.middleCols(j * b, b);
  }
  return both;
}

std::vector<std::vector<int>> with_more_columns(std::vector<std::vector<int>> columns, int from,
                                                Index more) {
  for (std::vector<int>& of_joint : columns) {
    for (Index i = 0; i < more; ++i) of_joint.push_back(from + static_cast<int>(i));
  }
  return columns;
}

/// What the deviations of the last columns' factors are worth in the first ones: a matrix whose
/// columns are the moves by one standard deviation each.
MatrixXd moves_of(const TorqueFactor& factor, Index own, const VectorXd& joint_weights,
                  const VectorXd& deviations) {
  constexpr double kTolerance = 1e-9;  // of directions that the recordings do not see
  const MatrixXd W = stacked(factor, joint_weights).W;
  MatrixXd A = W.leftCols(own);
  const VectorXd scale = unit_scale(A);
  A = A * scale.asDiagonal();
  const MatrixXd B = W.rightCols(deviations.size()) * deviations.asDiagonal();
  return -(scale.asDiagonal() * least_norm_solution(A, B, kTolerance));
}

/// The model with a column for each uncertain number.
LinearModel with_uncertain(const LinearModel& model, const UncertainNumbers& numbers) {
  LinearModel both = model;
  both.columns = with_more_columns(model.columns, model.size(), numbers.size());
  both.parameters.resize(both.parameters.size() + static_cast<std::size_t>(numbers.size()));
  both.regressor = [own = model.regressor, numbers, joints = model.joints()](
                       const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq, MatrixXd& Y) {
    MatrixXd first;
    own(q, dq, ddq, first);
    Y = side_by_side(first, numbers.torques(q, dq, ddq), joints);
  };
  return both;
}

/// Places of what the fit has found: all but what is held or stands at a bound.
EffectUnknowns found_unknowns(const EffectFit& fit) {
  EffectUnknowns unknowns = base_unknowns(fit.point);
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    for (std::size_t p = 0; p < fit.parameters[k].size(); ++p) {
      const EffectParameterFit& own = fit.parameters[k][p];
      if (!own.held && !own.at_bound) unknowns.parameters[k][p] = unknowns.size++;
    }
  }
  return unknowns;
}

/// rms of the recorded torque over the equations that count, (n).
VectorXd recorded_rms(const LinearModel& model, const std::vector<MotionSource>& sources,
                      const ToolOptions& options) {
  LinearModel nothing = model;
  nothing.parameters.clear();
  nothing.columns.assign(model.columns.size(), {});
  nothing.held = nullptr;
  nothing.regressor = [](const MatrixXd& q, const MatrixXd&, const MatrixXd&, MatrixXd& Y) {
    Y.resize(q.rows(), 0);
  };
  const TorqueFactor factor =
      factor_of(joined(rows_of_all(nothing, sources, options)), nothing.columns, 0);
  VectorXd squares = torque_squares(factor);
  for (Index j = 0; j < squares.size(); ++j) {
    squares[j] /= std::max(1.0, factor.joints[static_cast<std::size_t>(j)].rows);
  }
  return squares.cwiseSqrt();
}

VectorXd percentages(const VectorXd& rms, const VectorXd& of) {
  return 100 * rms.cwiseQuotient(of.cwiseMax(1e-300));
}

}  // namespace

void add_held_uncertainty(const std::vector<MotionSource>& train, const ToolOptions& options,
                          FitReport& report) {
  const UncertainNumbers numbers(report.robot);
  if (numbers.size() == 0) return;
  const LinearModel& model = report.robot.linear;
  const LinearModel both = with_uncertain(model, numbers);
  const TorqueFactor factor =
      factor_of(joined(rows_of_all(both, train, options)), both.columns, both.size());
  for (MethodFit& fit : report.fits) {
    if (fit.estimate.covariance.size() == 0) continue;
    const MatrixXd moves =
        moves_of(factor, model.size(), fit.estimate.joint_weights, numbers.deviations());
    fit.estimate.covariance += moves * moves.transpose();
  }
}

void add_held_uncertainty(const DescribedRobot& robot, const EffectRecordings& data,
                          EffectFit& fit) {
  const UncertainNumbers numbers(robot);
  if (numbers.size() == 0) return;
  EffectSignals signals(data);
  signals.set_beta(fit.point.beta);
  signals.set_tangent_beta(fit.point.beta);
  const EffectUnknowns unknowns = found_unknowns(fit);
  const EffectEquations equations = linearised(data, signals, fit.point, unknowns);
  const int size = unknowns.size + static_cast<int>(numbers.size());
  TorqueFactor factor =
      empty_factor(with_more_columns(equations.columns, unknowns.size, numbers.size()), size);
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    RowBlock block = equations.blocks[run];
    MatrixXd held =
        decimate(here.decimator, numbers.torques(here.motion.q, here.motion.dq, here.motion.ddq));
    for (Index j = 0; j < data.joints() && block.counted.size() > 0; ++j) {
      auto own = held.middleCols(j * numbers.size(), numbers.size());
      own = block.counted.col(j).asDiagonal() * own.eval();
    }
    block.Y = side_by_side(block.Y, held, data.joints());
    absorb(factor, block);
  }
  const MatrixXd moves =
      moves_of(factor, unknowns.size, fit.base.joint_weights, numbers.deviations());
  fit.base.covariance += moves.topRows(unknowns.base) * moves.topRows(unknowns.base).transpose();
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const EffectInstance& effect = fit.point.effects[k];
    MatrixXd own = MatrixXd::Zero(effect.law.size(), numbers.size());
    for (std::size_t p = 0; p < fit.parameters[k].size(); ++p) {
      const int place = unknowns.parameters[k][p];
      if (place < 0) continue;
      const auto row = static_cast<Index>(p);
      const bool logarithm = by_logarithm(effect.law.parameters[p]);
      own.row(row) = (logarithm ? std::abs(effect.parameters[row]) : 1) * moves.row(place);
    }
    fit.covariance[k] += own * own.transpose();
    for (std::size_t p = 0; p < fit.parameters[k].size(); ++p) {
      if (unknowns.parameters[k][p] < 0) continue;
      const auto row = static_cast<Index>(p);
      fit.parameters[k][p].stddev = std::sqrt(fit.covariance[k](row, row));
    }
  }
}

void take_percentages_of_recorded_torque(const std::vector<MotionSource>& train,
                                         const std::vector<MotionSource>& heldout,
                                         const ToolOptions& options, FitReport& report) {
  if (!report.robot.held.any() || train.empty()) return;
  const LinearModel& model = report.robot.linear;
  const VectorXd fitted = recorded_rms(model, train, options);
  for (MethodFit& fit : report.fits) fit.percent = percentages(fit.estimate.residual_rms, fitted);
  if (heldout.empty()) return;
  const VectorXd held = recorded_rms(model, heldout, options);
  for (MethodFit& fit : report.fits) {
    if (fit.heldout_rms.size() > 0) fit.heldout_percent = percentages(fit.heldout_rms, held);
  }
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/discrimination/separation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/effects/equation_stack.h"
#include "runtime/evidence/joint_columns.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFiner = 3;  // times as many steps between values of a shape

/// Every joint's equations that count, one joint after the other, over its noise.
class CountedRows {
 public:
  CountedRows(const EffectRecordings& data, const VectorXd& noise) : data_(data), noise_(noise) {
    const MatrixXd& counted = data.runs.front().rows.counted;
    places_.resize(static_cast<std::size_t>(data.joints()));
    for (Index j = 0; j < counted.cols(); ++j) {
      first_.push_back(rows_);
      auto& own = places_[static_cast<std::size_t>(j)];
      for (Index k = 0; k < counted.rows(); ++k) {
        if (counted(k, j) != 0) own.push_back(k);
      }
      rows_ += static_cast<Index>(own.size());
    }
  }

  [[nodiscard]] Index rows() const { return rows_; }

  [[nodiscard]] MatrixXd regressor() const {
    const MatrixXd& Y = data_.runs.front().rows.Y;
    const Index nb = data_.model.size();
    MatrixXd W(rows_, nb);
    for (std::size_t j = 0; j < places_.size(); ++j) {
      const auto joint = static_cast<Index>(j);
      W.middleRows(first_[j], static_cast<Index>(places_[j].size())) =
          Y.middleCols(joint * nb, nb)(places_[j], Eigen::all) / noise_[joint];
    }
    return W;
  }

  [[nodiscard]] MatrixXd stacked(const JointColumns& columns) const {
    MatrixXd all = MatrixXd::Zero(rows_, columns.columns());
    for (std::size_t i = 0; i < columns.joints.size(); ++i) {
      const auto j = static_cast<std::size_t>(columns.joints[i]);
      all.middleRows(first_[j], static_cast<Index>(places_[j].size())) =
          columns.parts[i](places_[j], Eigen::all) / noise_[columns.joints[i]];
    }
    return all;
  }

 private:
  const EffectRecordings& data_;
  const VectorXd& noise_;
  std::vector<std::vector<Index>> places_;
  std::vector<Index> first_;
  Index rows_ = 0;
};

std::vector<int> wanted_columns(const Hypothesis& hypothesis) {
  std::vector<int> wanted;
  for (const int p : hypothesis.linear) wanted.push_back(1 + p);
  return wanted;
}

/// The chi-square of a vector that no combination of the columns and the model explains.
/// @param vector  what the model leaves of it
double missed(const VectorXd& vector, const MatrixXd& columns, const Projection& model) {
  constexpr double kAllAbsorbed = 1e-9;  // what rounding leaves of a column of the model
  MatrixXd left = model.rest(columns);
  for (Index c = 0; c < left.cols(); ++c) {
    if (left.col(c).norm() <= kAllAbsorbed * columns.col(c).norm()) left.col(c).setZero();
  }
  if (left.isZero(0)) return vector.squaredNorm();
  return Projection(left).rest(vector).squaredNorm();
}

std::vector<EffectInstance> trials_of(const Hypothesis& hypothesis, const EffectScales& scales,
                                      int values, int most) {
  const std::vector<VectorXd> grid = shape_grid(hypothesis, scales, values);
  const std::size_t count = std::min(grid.size(), static_cast<std::size_t>(most));
  std::vector<EffectInstance> trials;
  for (std::size_t i = 0; i < count; ++i) {
    // evenly over the grid where it has too many
    trials.push_back(with_shapes(hypothesis, grid[i * grid.size() / count]));
  }
  return trials;
}

}  // namespace

void SeparationProblem::validate() const {
  const Index n = model.joints();
  if (beta.size() != model.size() || noise.size() != n || still_speed.size() != n) {
    throw std::invalid_argument(fmt::format(
        "separation: {} parameters, noise of {} joints, still speeds of {}; expected {}, {}, {}",
        beta.size(), noise.size(), still_speed.size(), model.size(), n, n));
  }
  for (const double sigma : noise) {
    if (sigma > 0 && std::isfinite(sigma)) continue;
    throw std::invalid_argument(
        fmt::format("separation: noise of {}, expected positive standard deviations", sigma));
  }
  for (const double rate_in : {rate, looked_at}) {
    if (rate_in > 0 && std::isfinite(rate_in)) continue;
    throw std::invalid_argument(
        fmt::format("separation: a rate of {} Hz, expected more than 0", rate_in));
  }
  if (shape_values < 1 || most_shapes < 1) {
    throw std::invalid_argument(
        fmt::format("separation: {} values of a shape, {} shapes; expected at least 1",
                    shape_values, most_shapes));
  }
  if (rivals.empty()) throw std::invalid_argument("separation: no rivals, expected at least one");
  std::vector<const EffectInstance*> all = {&finding};
  for (const EffectInstance& rival : rivals) all.push_back(&rival);
  for (const EffectInstance* effect : all) {
    if (effect->joint < n && effect->other < n && effect->parameters.size() == effect->law.size()) {
      continue;
    }
    throw std::invalid_argument(fmt::format(
        "separation: {} on joint {} with {} parameters, expected joint 1 to {} and {} parameters",
        effect->law.name, effect->joint + 1, effect->parameters.size(), n, effect->law.size()));
  }
  if (!finding.parameters.allFinite()) {
    throw std::invalid_argument(
        fmt::format("separation: {} lacks a number, expected all of them", finding.law.name));
  }
}

SeparationCriterion::SeparationCriterion(SeparationProblem problem, const PlannedMotion& usual)
    : problem_(std::move(problem)) {
  problem_.validate();
  const EffectRecordings data = recording(usual);
  EffectSignals signals(data);
  signals.set_beta(problem_.beta);
  signals.set_tangent_beta(problem_.beta);
  effect_columns(data, signals, problem_.finding, {0});
  for (const EffectInstance& effect : problem_.rivals) {
    const EffectScales scales = scales_of(data, problem_.beta, effect.joint);
    Rival rival;
    rival.hypothesis = hypothesis_of(effect, scales);
    try {
      effect_columns(data, signals, rival.hypothesis.effect, wanted_columns(rival.hypothesis),
                     rival.hypothesis.held);
    } catch (const MissingSignalError& error) {
      left_out_.push_back(fmt::format("{}: {}", short_name(effect), error.what()));
      continue;
    }
    rival.trials = trials_of(rival.hypothesis, scales, problem_.shape_values, problem_.most_shapes);
    rival.fine_trials =
        trials_of(rival.hypothesis, scales, kFiner * (problem_.shape_values - 1) + 1,
                  kFiner * problem_.most_shapes);
    rivals_.push_back(std::move(rival));
  }
  if (rivals_.empty()) {
    throw std::invalid_argument(
        fmt::format("separation: no rival can be worked out: {}", fmt::join(left_out_, "; ")));
  }
}

EffectRecordings SeparationCriterion::recording(const PlannedMotion& motion) const {
  const double rate = std::min(problem_.rate, problem_.looked_at);
  const auto samples = std::max<Index>(10, std::lround(motion.duration * rate));
  return planned_recording(problem_.model, problem_.robot, problem_.beta, motion, samples,
                           problem_.still_speed);
}

Separation SeparationCriterion::of(const PlannedMotion& motion, bool fine) const {
  const EffectRecordings data = recording(motion);
  EffectSignals signals(data);
  signals.set_beta(problem_.beta);
  signals.set_tangent_beta(problem_.beta);
  Separation result;
  const CountedRows rows(data, problem_.noise);
  if (rows.rows() <= data.model.size()) {
    for (const Rival& rival : rivals_) result.rivals.push_back({rival.hypothesis.effect, 0});
    return result;
  }
  // as many samples as the recording will have
  const double worth =
      motion.duration * problem_.rate / static_cast<double>(data.runs.front().motion.samples());
  const Projection projection(rows.regressor());
  const VectorXd left =
      projection.rest(rows.stacked(effect_columns(data, signals, problem_.finding, {0})));
  if (!left.allFinite()) {
    throw std::invalid_argument(
        fmt::format("separation: the torque of {} is not finite", short_name(problem_.finding)));
  }
  result.visible = worth * left.squaredNorm();
  result.least = result.visible;
  for (const Rival& rival : rivals_) {
    RivalSeparation nearest{rival.hypothesis.effect, result.visible};
    for (const EffectInstance& trial : fine ? rival.fine_trials : rival.trials) {
      const MatrixXd columns = rows.stacked(effect_columns(
          data, signals, trial, wanted_columns(rival.hypothesis), rival.hypothesis.held));
      if (!columns.allFinite()) continue;
      const double lambda = worth * missed(left, columns, projection);
      if (lambda < nearest.lambda) nearest = {trial, lambda};
    }
    result.least = std::min(result.least, nearest.lambda);
    result.rivals.push_back(std::move(nearest));
  }
  return result;
}

Separation SeparationCriterion::at(const PlannedMotion& motion) const { return of(motion, false); }

Separation SeparationCriterion::finely_at(const PlannedMotion& motion) const {
  return of(motion, true);
}

}  // namespace dyngen::runtime

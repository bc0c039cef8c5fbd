// SPDX-License-Identifier: MIT
#include "runtime/plausibility/trial_fit.h"

#include <algorithm>
#include <cmath>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/rows.h"
#include "runtime/identification/motion_rows.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kTrialSamples = 500;  // of all recordings

Index samples_in(const std::vector<Motion>& runs) {
  Index count = 0;
  for (const Motion& run : runs) count += run.samples();
  return count;
}

/// The runs of a source, pieces of one run put together.
void append_runs(const MotionSource& source, std::vector<Motion>& runs) {
  source.pieces([&](const StreamPiece& piece) {
    // a run that comes in pieces is too long to be put together: its pieces serve as runs
    runs.push_back(piece.motion);
  });
}

}  // namespace

TrialSamples::TrialSamples(const std::vector<MotionSource>& sources, double most_lag) {
  for (const MotionSource& source : sources) {
    append_runs(source, runs_);
    const VectorXd still = plan_rows(source, {}).still_speed;
    const VectorXd finite = still.unaryExpr([](double v) { return std::isfinite(v) ? v : 0.0; });
    still_ = still_.size() == 0 ? finite : still_.cwiseMax(finite).eval();
    sample_time_ = std::max(sample_time_, source.sample_time);
    const std::vector<bool>& dead = source.condition.torque_dead;
    dead_.resize(static_cast<std::size_t>(source.joints()), false);
    for (std::size_t j = 0; j < dead.size(); ++j) dead_[j] = dead_[j] || dead[j];
  }
  if (runs_.empty() || !(sample_time_ > 0)) return;
  most_lag_ = static_cast<Index>(std::floor(most_lag / sample_time_));
  const Index step = std::max<Index>(1, samples_in(runs_) / kTrialSamples);
  Index place = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    for (Index k = 0; k < runs_[r].samples(); ++k, ++place) {
      if (place % step != 0 || k < most_lag_ || k + most_lag_ >= runs_[r].samples()) continue;
      places_.push_back({r, k});
    }
  }
}

TrialSamples::ReadSamples TrialSamples::read(const Reading& reading) const {
  const Index n = still_.size(), count = static_cast<Index>(places_.size());
  ReadSamples read;
  read.q.resize(count, n);
  read.dq = read.ddq = read.tau = read.q;
  read.counted = MatrixXd::Ones(count, n);
  const double per_time = 1 / reading.time_factor;
  for (Index i = 0; i < count; ++i) {
    const Place& place = places_[static_cast<std::size_t>(i)];
    const Motion& run = runs_[place.run];
    for (Index j = 0; j < n; ++j) {
      const auto own = static_cast<std::size_t>(j);
      const Index from = reading.position_from[own];
      const Index row = place.row + reading.position_lag[own];
      const double factor = reading.position_factor[j];
      read.q(i, j) = factor * run.q(row, from);
      read.dq(i, j) = factor * per_time * run.dq(row, from);
      read.ddq(i, j) = factor * per_time * per_time * run.ddq(row, from);
      const Index torque_from = reading.torque_from[own];
      const bool counts = std::abs(run.dq(row, from)) >= still_[from] &&
                          !dead_[static_cast<std::size_t>(torque_from)];
      read.tau(i, j) =
          counts ? reading.torque_factor[j] * run.tau(place.row + reading.torque_lag, torque_from)
                 : 0;
      if (!counts) read.counted(i, j) = 0;
    }
  }
  return read;
}

TrialFit TrialSamples::fit(const LinearModel& model, const Reading& reading) const {
  const ReadSamples read = this->read(reading);
  const Index n = model.joints(), count = read.q.rows(), nb = model.size();
  RowBlock block;
  block.tau = read.tau;
  block.counted = read.counted;
  model.regressor(read.q, read.dq, read.ddq, block.Y);
  clear_rounding(block.Y, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < count; ++i) {
      if (block.counted(i, j) == 0) block.Y.row(i).segment(j * nb, nb).setZero();
    }
  }
  TrialFit fit;
  fit.equations = empty_factor(model.columns, model.size());
  absorb(fit.equations, block);
  fit.estimate = weighted_least_squares(fit.equations);
  const VectorXd squares = residual_squares(fit.equations, fit.estimate.beta);
  const VectorXd torque = torque_squares(fit.equations);
  fit.left = VectorXd::Zero(n);
  fit.inertia = fit.power = VectorXd::Zero(n);
  // the same samples at unit accelerations, for the mass matrix; a tenth of them will do
  const auto some = Eigen::seq(Index{0}, count - 1, Index{10});
  const MatrixXd postures = read.q(some, Eigen::all);
  const MatrixXd zero = MatrixXd::Zero(postures.rows(), n);
  MatrixXd standing, accelerated;
  model.regressor(postures, zero, zero, standing);
  for (Index j = 0; j < n; ++j) {
    if (torque[j] > 0) fit.left[j] = std::sqrt(squares[j] / torque[j]);
    MatrixXd unit = zero;
    unit.col(j).setOnes();
    model.regressor(postures, zero, unit, accelerated);
    const MatrixXd inertia = (accelerated - standing).middleCols(j * nb, nb);
    // at postures in which the joint moves: what others' hide of it is not determined
    const VectorXd moves = block.counted(some, j);
    fit.inertia[j] = (inertia * fit.estimate.beta).dot(moves) / std::max(1.0, moves.sum());
    for (const int c : model.columns[static_cast<std::size_t>(j)]) {
      const ParameterKind kind = model.parameters[static_cast<std::size_t>(c)].kind;
      if (kind != ParameterKind::kViscous && kind != ParameterKind::kCoulomb) continue;
      const VectorXd column = block.Y.col(j * nb + c);
      fit.power[j] +=
          fit.estimate.beta[c] * column.dot(read.dq.col(j)) / static_cast<double>(count);
    }
  }
  return fit;
}

std::vector<bool> TrialSamples::moving_with(int joint) const {
  constexpr double kLeast = 0.1;
  VectorXd together = VectorXd::Zero(still_.size());
  for (const Place& place : places_) {
    const auto speed = runs_[place.run].dq.row(place.row).transpose().cwiseAbs().array();
    if (speed[joint] < still_[joint]) continue;
    together += (speed >= still_.array()).cast<double>().matrix();
  }
  std::vector<bool> moving;
  for (const double samples : together) {
    moving.push_back(samples > 0 && samples >= kLeast * together[joint]);
  }
  return moving;
}

VectorXd deviations_of(const TrialFit& fit) {
  const Estimate& estimate = fit.estimate;
  return white_covariance(fit.equations, estimate.beta, estimate.joint_weights, estimate.scale,
                          estimate.unseen)
      .diagonal()
      .cwiseMax(0)
      .cwiseSqrt();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/heldout.h"

#include <Eigen/QR>
#include <cmath>

#include "runtime/effects/effect_residual.h"
#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kGain = 2;          // by which squares must fall
constexpr double kDeviations = 2.3;  // from what an effect would have done: 1 % of those there are
constexpr double kInformative = 4;   // squares of the change: with less they say nothing for it
constexpr double kJolt = 4;          // standard deviations that noise hardly has
constexpr double kRefit = 10;        // by which squares may rise as the model's estimate changes

/// Columns of one joint in a run, in units of the noise, which is white there.
void whiten(Eigen::Ref<MatrixXd> columns, const TorqueNoiseModel& noise, Index joint,
            const Eigen::Ref<const VectorXd>& counted) {
  Whitener(noise.joints[static_cast<std::size_t>(joint)], counted).apply(columns);
}

/// The model's rows of one joint.
MatrixXd rows_of(const RowBlock& block, Index joint) {
  const Index size = block.Y.cols() / block.tau.cols();
  return block.Y.middleCols(joint * size, size);
}

/// What held-out recordings have of the model's errors: sums over samples that are noise.
struct Prediction {
  MatrixXd information;           // W'W
  VectorXd first, second;         // W' r of two residuals r
  double squares = 0, other = 0;  // r'r
  double change = 0;              // of their difference

  /// r'(I + W L^-1 W')^-1 r, which is r'r - r'W (L + W'W)^-1 W'r (Woodbury 1950).
  [[nodiscard]] double beside(double whole, const VectorXd& part, const MatrixXd& known) const {
    if (known.size() == 0) return whole;
    const MatrixXd sum = information + known;
    VectorXd scale = sum.diagonal().cwiseSqrt();
    for (double& s : scale) s = s > 0 ? 1 / s : 0;
    const MatrixXd scaled = scale.asDiagonal() * sum * scale.asDiagonal();
    const VectorXd own = scale.cwiseProduct(part);
    return whole - own.dot(scaled.completeOrthogonalDecomposition().solve(own));
  }
};

}  // namespace

RunResiduals residuals_of(const EffectRecordings& data, const EffectPoint& point) {
  RunResiduals residuals;
  for (const RowBlock& block : without_effects(data, point)) {
    residuals.push_back(residual(block, point.beta).cwiseProduct(block.counted));
  }
  return residuals;
}

VectorXd whitened_squares(const EffectRecordings& data, const RunResiduals& residuals,
                          const TorqueNoiseModel& noise) {
  VectorXd squares = VectorXd::Zero(data.joints());
  for (Index j = 0; j < squares.size(); ++j) {
    for (std::size_t run = 0; run < residuals.size(); ++run) {
      MatrixXd rest = residuals[run].col(j);
      whiten(rest, noise, j, data.runs[run].rows.counted.col(j));
      squares[j] += rest.squaredNorm();
    }
  }
  return squares;
}

MatrixXd model_information(const EffectRecordings& data, const TorqueNoiseModel& noise) {
  const Index size = data.model.size();
  MatrixXd information = MatrixXd::Zero(size, size);
  for (const EffectRun& run : data.runs) {
    for (Index j = 0; j < data.joints(); ++j) {
      MatrixXd rows = run.rows.counted.col(j).asDiagonal() * rows_of(run.rows, j);
      whiten(rows, noise, j, run.rows.counted.col(j));
      information.noalias() += rows.transpose() * rows;
    }
  }
  return information;
}

VectorXd heldout_squares(const EffectRecordings& heldout, EffectPoint point,
                         const TorqueNoiseModel& noise) {
  point.initial.clear();
  return whitened_squares(heldout, residuals_of(heldout, point), noise);
}

bool HeldoutProof::helps() const { return before - after >= kGain; }

bool HeldoutProof::informs() const { return change >= kInformative; }

bool HeldoutProof::agrees() const {
  const double ratio = fitted > 0 ? change / fitted : 0;
  const double expected = change - 2 * parameters * ratio;
  return informs() &&
         before - after >= expected - kDeviations * 2 * std::sqrt(change * (1 + ratio));
}

bool HeldoutProof::harms() const { return after - before >= kRefit; }

HeldoutProof heldout_proof(const EffectRecordings& heldout, EffectPoint before, EffectPoint after,
                           const TorqueNoiseModel& noise, const MatrixXd& known) {
  before.initial.clear();
  after.initial.clear();
  const std::vector<RowBlock> first = without_effects(heldout, before);
  const std::vector<RowBlock> second = without_effects(heldout, after);
  const Index size = heldout.model.size();
  Prediction prediction{MatrixXd::Zero(size, size), VectorXd::Zero(size), VectorXd::Zero(size)};
  HeldoutProof proof;
  for (std::size_t run = 0; run < first.size(); ++run) {
    const MatrixXd counted = first[run].counted.cwiseProduct(second[run].counted);
    const MatrixXd one = residual(first[run], before.beta).cwiseProduct(counted);
    const MatrixXd other = residual(second[run], after.beta).cwiseProduct(counted);
    for (Index j = 0; j < heldout.joints(); ++j) {
      MatrixXd columns(counted.rows(), 2 + size);
      columns << one.col(j), other.col(j),
          counted.col(j).asDiagonal() * rows_of(heldout.runs[run].rows, j);
      whiten(columns, noise, j, counted.col(j));
      const VectorXd noise_like =
          (columns.col(0).cwiseAbs().cwiseMin(columns.col(1).cwiseAbs()).array() < kJolt)
              .template cast<double>();
      columns = noise_like.asDiagonal() * columns;
      const auto W = columns.rightCols(size);
      prediction.information.noalias() += W.transpose() * W;
      prediction.first += W.transpose() * columns.col(0);
      prediction.second += W.transpose() * columns.col(1);
      prediction.squares += columns.col(0).squaredNorm();
      prediction.other += columns.col(1).squaredNorm();
      prediction.change += (columns.col(0) - columns.col(1)).squaredNorm();
    }
  }
  proof.before = prediction.beside(prediction.squares, prediction.first, known);
  proof.after = prediction.beside(prediction.other, prediction.second, known);
  proof.change = prediction.beside(prediction.change, prediction.first - prediction.second, known);
  return proof;
}

}  // namespace dyngen::runtime

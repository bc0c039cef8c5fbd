// SPDX-License-Identifier: MIT
#include "runtime/identification/motion_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "runtime/signals/decimation.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;
constexpr Index kBlockSamples = 1024;  // samples whose regressor is in memory at once

/// Highest frequency that is left in the equations.
double band_of(const MotionSource& source, Index decimation) {
  const double nyquist = 0.5 / (source.sample_time * static_cast<double>(decimation));
  return source.cutoff.hz > 0 ? std::min(source.cutoff.hz, nyquist) : nyquist;
}

/// Rows of a run before the parallel filter, and what of them is still needed.
class RowBuffer {
 public:
  RowBuffer(const LinearModel& model, const Decimator& decimator, VectorXd still)
      : model_(model), decimator_(decimator), still_(std::move(still)) {
    for (int j = 0; j < model.joints(); ++j) {
      for (const int c : model.columns[static_cast<std::size_t>(j)]) {
        active_.push_back(Index{j} * model.size() + c);
      }
    }
  }

  /// A piece in, its rows out.
  void push(const StreamPiece& piece, const std::function<void(const RowBlock&)>& visit) {
    if (!piece.continues_run) {
      kept_.resize(0, 0);
      started_ = false;
    }
    for (Index start = 0; start < piece.motion.samples(); start += kBlockSamples) {
      append(piece.motion, start, std::min(kBlockSamples, piece.motion.samples() - start));
      emit(visit);
    }
  }

 private:
  [[nodiscard]] Index joints() const { return model_.joints(); }

  /// Columns: the active elements of Y, tau, dq.
  void append(const Motion& motion, Index start, Index count) {
    model_.regressor(motion.q.middleRows(start, count), motion.dq.middleRows(start, count),
                     motion.ddq.middleRows(start, count), Y_);
    clear_rounding(Y_, joints());
    const Index active = static_cast<Index>(active_.size());
    MatrixXd rows(kept_.rows() + count, active + 2 * joints());
    if (kept_.rows() > 0) rows.topRows(kept_.rows()) = kept_;
    for (Index i = 0; i < active; ++i) {
      rows.col(i).tail(count) = Y_.col(active_[static_cast<std::size_t>(i)]);
    }
    auto tau = rows.middleCols(active, joints()).bottomRows(count);
    tau = motion.tau.middleRows(start, count);
    if (model_.held) {
      tau -=
          model_.held->torque(motion.q.middleRows(start, count), motion.dq.middleRows(start, count),
                              motion.ddq.middleRows(start, count), false);
    }
    rows.rightCols(joints()).bottomRows(count) = motion.dq.middleRows(start, count);
    kept_ = std::move(rows);
  }

  void emit(const std::function<void(const RowBlock&)>& visit) {
    const Index count = decimated_samples(decimator_, kept_.rows());
    if (count == 0) return;
    const Index active = static_cast<Index>(active_.size());
    const MatrixXd filtered = decimate(decimator_, kept_.leftCols(active + joints()));
    RowBlock block;
    block.Y = MatrixXd::Zero(count, joints() * model_.size());
    for (Index i = 0; i < active; ++i) {
      block.Y.col(active_[static_cast<std::size_t>(i)]) = filtered.col(i);
    }
    block.tau = filtered.rightCols(joints());
    block.continues_run = started_;
    leave_out_still(count, block);
    started_ = true;
    // the next output's first tap, at a whole multiple of the factor
    const Index next = count * decimator_.factor;
    kept_ = kept_.bottomRows(kept_.rows() - next).eval();
    visit(block);
  }

  void leave_out_still(Index count, RowBlock& block) {
    const Index first = first_sample(decimator_);
    block.counted = MatrixXd::Ones(count, joints());
    bool all = true;
    for (Index j = 0; j < joints(); ++j) {
      const auto speed = kept_.col(kept_.cols() - joints() + j);
      for (Index k = 0; k < count; ++k) {
        if (std::abs(speed[first + k * decimator_.factor]) >= still_[j]) continue;
        block.counted(k, j) = 0;
        block.tau(k, j) = 0;
        block.Y.row(k).segment(j * model_.size(), model_.size()).setZero();
        all = false;
      }
    }
    if (all) block.counted.resize(0, 0);
  }

  const LinearModel& model_;
  Decimator decimator_;
  VectorXd still_;
  std::vector<Index> active_;  ///< columns of Y that are not always zero
  MatrixXd kept_, Y_;
  bool started_ = false;
};

void check_joints(const LinearModel& model, const MotionSource& source) {
  if (model.joints() == source.joints()) return;
  throw std::invalid_argument(
      fmt::format("{}: {} joints, but {} has {} that move: expected the "
                  "columns of all, or '--base' and '--tip' for an arm of "
                  "a larger robot",
                  source.name, source.joints(), model.name, model.joints()));
}

}  // namespace

RowPlan plan_rows(const MotionSource& source, const RowOptions& options) {
  RowPlan plan;
  plan.decimation = options.decimation;
  plan.filter = options.filter;
  if (plan.decimation <= 0) {
    const double wanted =
        source.cutoff.hz > 0 ? 0.5 / (options.band * source.cutoff.hz * source.sample_time) : 1;
    const auto least = static_cast<Index>(std::lround(options.row_time / source.sample_time));
    plan.decimation = std::max<Index>({1, static_cast<Index>(std::floor(wanted)), least});
    if (plan.decimation > options.multiple) {
      plan.decimation -= plan.decimation % options.multiple;
      if (plan.decimation < least) plan.decimation += options.multiple;
    }
  }
  plan.row_time = source.sample_time * static_cast<double>(plan.decimation);
  // white position noise has the density 2 sigma^2 T up to the Nyquist frequency
  const double band = band_of(source, plan.decimation);
  const VectorXd density = 2 * source.sample_time * source.position_noise.cwiseAbs2();
  plan.acceleration_noise = (density * (std::pow(2 * kPi, 4) * std::pow(band, 5) / 5)).cwiseSqrt();
  const VectorXd velocity_noise =
      (density * (std::pow(2 * kPi, 2) * std::pow(band, 3) / 3)).cwiseSqrt();
  // the least number that is not 0: a joint that never moves stands, whatever its noise
  plan.still_speed = options.still_speed >= 0
                         ? VectorXd::Constant(source.joints(), options.still_speed).eval()
                         : (3 * velocity_noise)
                               .cwiseMax(kStandstillPart * source.fastest)
                               .cwiseMax(std::numeric_limits<double>::min())
                               .eval();
  const std::vector<bool>& dead = source.condition.torque_dead;
  for (std::size_t j = 0; j < dead.size(); ++j) {
    if (dead[j]) {
      plan.still_speed[static_cast<Index>(j)] = std::numeric_limits<double>::infinity();
    }
  }
  return plan;
}

RowSource rows_of(const LinearModel& model, const MotionSource& source, const RowOptions& options) {
  check_joints(model, source);
  return planned_rows(model, source, plan_rows(source, options));
}

RowSource planned_rows(const LinearModel& model, const MotionSource& source, const RowPlan& plan) {
  check_joints(model, source);
  const Decimator decimator = design_decimator(plan.decimation, plan.filter);
  return [&model, pieces = source.pieces, decimator,
          still = plan.still_speed](const std::function<void(const RowBlock&)>& visit) {
    RowBuffer buffer(model, decimator, still);
    pieces([&](const StreamPiece& piece) { buffer.push(piece, visit); });
  };
}

RowSource joined(std::vector<RowSource> sources) {
  return [sources = std::move(sources)](const std::function<void(const RowBlock&)>& visit) {
    for (const RowSource& source : sources) source(visit);
  };
}

TorqueFactor regressor_noise(const LinearModel& model, const MatrixXd& postures,
                             const RowPlan& plan, double equations) {
  TorqueFactor factor = empty_factor(model.columns, model.size());
  if (postures.rows() == 0) return factor;
  const int n = model.joints();
  const MatrixXd zero = MatrixXd::Zero(postures.rows(), n);
  MatrixXd standing, accelerated;
  model.regressor(postures, zero, zero, standing);
  for (int i = 0; i < n; ++i) {
    MatrixXd ddq = zero;
    ddq.col(i).setOnes();
    model.regressor(postures, zero, ddq, accelerated);
    accelerated = (accelerated - standing) * plan.acceleration_noise[i];
    absorb(factor, accelerated, zero);
  }
  const double up = std::sqrt(equations / static_cast<double>(postures.rows()));
  for (JointFactor& joint : factor.joints) {
    joint.R *= up;
    joint.rows = equations;
  }
  return factor;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/identification/simulated_motion.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <memory>
#include <stdexcept>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTwoPi = 6.28318530717958647692;

/// Mass matrix and the torque of everything else, from the regressor alone.
class Dynamics {
 public:
  Dynamics(const LinearModel& model, const VectorXd& beta)
      : model_(model), beta_(beta), n_(model.joints()) {}

  /// Row 0: at the state without acceleration. Rows 1 + j: at rest with a unit acceleration of
  /// joint j; the last row: at rest.
  void evaluate(const VectorXd& q, const VectorXd& dq) {
    const Index samples = n_ + 2;
    const MatrixXd at = q.transpose().replicate(samples, 1);
    MatrixXd speed = MatrixXd::Zero(samples, n_), acceleration = speed;
    speed.row(0) = dq.transpose();
    for (Index j = 0; j < n_; ++j) acceleration(1 + j, j) = 1;
    model_.regressor(at, speed, acceleration, Y_);
    MatrixXd tau(samples, n_);
    for (Index j = 0; j < n_; ++j) {
      tau.col(j) = Y_.middleCols(j * beta_.size(), beta_.size()) * beta_;
    }
    bias = tau.row(0).transpose();
    M.resize(n_, n_);
    for (Index j = 0; j < n_; ++j) M.col(j) = (tau.row(1 + j) - tau.row(n_ + 1)).transpose();
  }

  VectorXd acceleration(const VectorXd& q, const VectorXd& dq, const VectorXd& tau) {
    evaluate(q, dq);
    const Eigen::LLT<MatrixXd> factor(M);
    if (factor.info() != Eigen::Success) {
      throw std::runtime_error(fmt::format(
          "{}: the estimated mass matrix is not positive definite: it cannot be simulated",
          model_.name));
    }
    return factor.solve(tau - bias);
  }

  MatrixXd M;
  VectorXd bias;

 private:
  const LinearModel& model_;
  const VectorXd& beta_;
  Index n_;
  MatrixXd Y_;
};

Motion shape_of(const Motion& reference) {
  Motion motion = reference;
  motion.tau.setZero(reference.samples(), reference.joints());
  return motion;
}

/// Regressors of the simulated motion, block by block as rows_of() gives them.
std::vector<MatrixXd> simulated_regressors(const LinearModel& model, const MotionSource& recorded,
                                           const MotionSource& commanded, const RowOptions& options,
                                           const VectorXd& beta, const TrackingLoop& loop) {
  auto runs = std::make_shared<std::vector<StreamPiece>>();
  commanded.pieces([&](const StreamPiece& piece) {
    runs->push_back({simulate_tracking(model, beta, piece.motion, loop), piece.continues_run});
  });
  const auto pieces = [runs](const std::function<void(const StreamPiece&)>& visit) {
    for (const StreamPiece& piece : *runs) visit(piece);
  };
  const MotionSource simulated = with_pieces(recorded, pieces);
  RowOptions same = options;
  same.decimation = plan_rows(recorded, options).decimation;
  same.still_speed = 0;
  std::vector<MatrixXd> blocks;
  rows_of(model, simulated, same)([&](const RowBlock& block) { blocks.push_back(block.Y); });
  return blocks;
}

}  // namespace

Motion simulate_tracking(const LinearModel& model, const VectorXd& beta, const Motion& reference,
                         const TrackingLoop& loop) {
  const double T = reference.sample_time;
  const double omega = kTwoPi * loop.frequency;
  if (!(loop.frequency > 0) || omega * T > 1) {
    throw std::invalid_argument(
        fmt::format("simulate_tracking(): a loop of {} Hz at a sample time of {} s: expected a "
                    "frequency between 0 and {:.3g} Hz",
                    loop.frequency, T, 1 / (kTwoPi * T)));
  }
  const MatrixXd feedforward = model.torque(reference.q, reference.dq, reference.ddq, beta);
  Dynamics dynamics(model, beta);
  Motion motion = shape_of(reference);
  VectorXd q = reference.q.row(0).transpose(), dq = reference.dq.row(0).transpose();
  for (Index k = 0; k < reference.samples(); ++k) {
    dynamics.evaluate(q, dq);
    const VectorXd inertia = dynamics.M.diagonal();
    // held over the sample, as a controller does
    const VectorXd tau = feedforward.row(k).transpose() +
                         inertia.cwiseProduct(omega * omega * (reference.q.row(k).transpose() - q) +
                                              2 * omega * (reference.dq.row(k).transpose() - dq));
    const VectorXd a1 = dynamics.acceleration(q, dq, tau);
    motion.q.row(k) = q.transpose();
    motion.dq.row(k) = dq.transpose();
    motion.ddq.row(k) = a1.transpose();
    motion.tau.row(k) = tau.transpose();
    const VectorXd v2 = dq + 0.5 * T * a1;
    const VectorXd a2 = dynamics.acceleration(q + 0.5 * T * dq, v2, tau);
    const VectorXd v3 = dq + 0.5 * T * a2;
    const VectorXd a3 = dynamics.acceleration(q + 0.5 * T * v2, v3, tau);
    const VectorXd v4 = dq + T * a3;
    const VectorXd a4 = dynamics.acceleration(q + T * v3, v4, tau);
    q += T / 6 * (dq + 2 * v2 + 2 * v3 + v4);
    dq += T / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (!q.allFinite() || !dq.allFinite()) {
      throw std::runtime_error(fmt::format("{}: the simulated motion left all bounds", model.name));
    }
  }
  return motion;
}

InstrumentSource simulated_instruments(const LinearModel& model, const MotionSource& recorded,
                                       const MotionSource& commanded, const RowOptions& options,
                                       const VectorXd& beta, const TrackingLoop& loop) {
  const auto blocks = std::make_shared<const std::vector<MatrixXd>>(
      simulated_regressors(model, recorded, commanded, options, beta, loop));
  RowSource rows = rows_of(model, recorded, options);
  std::size_t count = 0;
  bool same = true;
  rows([&](const RowBlock& block) {
    same = same && count < blocks->size() && (*blocks)[count].rows() == block.Y.rows();
    ++count;
  });
  if (!same || count != blocks->size()) {
    throw std::invalid_argument(
        fmt::format("{} and {} have different runs or numbers of samples: expected the commanded "
                    "motion of the same recording",
                    recorded.name, commanded.name));
  }
  return [rows, blocks](const std::function<void(const InstrumentBlock&)>& visit) {
    std::size_t next = 0;
    rows([&](const RowBlock& block) {
      InstrumentBlock with{block, (*blocks)[next++]};
      if (block.counted.size() != 0) {
        const Index nb = block.Y.cols() / block.counted.cols();
        for (Index j = 0; j < block.counted.cols(); ++j) {
          with.Z.middleCols(j * nb, nb).array().colwise() *= block.counted.col(j).array();
        }
      }
      visit(with);
    });
  };
}

MotionSource commanded_motion(const Trajectory& trajectory, const std::string& name,
                              const MotionSource& recorded) {
  if (trajectory.joints() != recorded.joints()) {
    throw std::invalid_argument(
        fmt::format("{}: {} joints, but {} has {}: expected the motion that "
                    "was commanded there",
                    name, trajectory.joints(), recorded.name, recorded.joints()));
  }
  const double first = trajectory.time[0], last = trajectory.time[trajectory.samples() - 1];
  recorded.pieces([&](const StreamPiece& piece) {
    const VectorXd& time = piece.motion.time;
    if (time.size() == 0) return;
    const double begin = time[0], end = time[time.size() - 1];
    if (begin >= first - recorded.sample_time && end <= last + recorded.sample_time) return;
    throw std::invalid_argument(
        fmt::format("{}: it lasts from {:.6g} to {:.6g} s, and {} has samples from {:.6g} to "
                    "{:.6g} s: expected "
                    "the motion that was commanded there, with the same zero of time",
                    name, first, last, recorded.name, begin, end));
  });
  const auto shared = std::make_shared<const Trajectory>(trajectory);
  return with_pieces(recorded, [shared, pieces = recorded.pieces](
                                   const std::function<void(const StreamPiece&)>& visit) {
    pieces([&](const StreamPiece& piece) {
      StreamPiece commanded = piece;
      Motion& motion = commanded.motion;
      const Index n = motion.q.cols();
      VectorXd q(n), dq(n), ddq(n);
      for (Index k = 0; k < motion.samples(); ++k) {
        motion_at(*shared, motion.time[k], q.data(), dq.data(), ddq.data());
        motion.q.row(k) = q.transpose();
        motion.dq.row(k) = dq.transpose();
        motion.ddq.row(k) = ddq.transpose();
      }
      visit(commanded);
    });
  });
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/excitation/held_accelerations.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

JointMotion HeldAccelerations::motion() const {
  const double T = sample_time;
  JointMotion motion{MatrixXd(u.rows(), u.cols()), MatrixXd(u.rows(), u.cols()), u};
  RowVectorXd q = start.transpose(), dq = RowVectorXd::Zero(u.cols());
  for (Index k = 0; k < u.rows(); ++k) {
    motion.q.row(k) = q;
    motion.dq.row(k) = dq;
    q += T * dq + 0.5 * T * T * u.row(k);
    dq += T * u.row(k);
  }
  return motion;
}

MatrixXd adjoint_sweep(const JointMotion& partial, double sample_time) {
  const double T = sample_time;
  MatrixXd gradient(partial.q.rows(), partial.q.cols());
  RowVectorXd by_q = RowVectorXd::Zero(partial.q.cols()), by_dq = by_q;
  for (Index k = partial.q.rows() - 1; k >= 0; --k) {
    gradient.row(k) = partial.ddq.row(k) + 0.5 * T * T * by_q + T * by_dq;
    by_dq += T * by_q + partial.dq.row(k);
    by_q += partial.q.row(k);
  }
  return gradient;
}

HeldAccelerations resampled(const HeldAccelerations& trajectory, int parts) {
  HeldAccelerations fine = trajectory;
  fine.sample_time /= parts;
  fine.u.resize(trajectory.u.rows() * parts, trajectory.u.cols());
  for (Index k = 0; k < fine.u.rows(); ++k) fine.u.row(k) = trajectory.u.row(k / parts);
  return fine;
}

std::optional<HeldAccelerations> brought_to_rest(const LinearModel& model,
                                                 const MotionLimits& limits,
                                                 const HeldAccelerations& trajectory) {
  const double T = trajectory.sample_time;
  const Index samples = trajectory.u.rows(), n = trajectory.u.cols();
  const JointMotion motion = trajectory.motion();
  const Index step = std::max<Index>(1, samples / 50);
  for (Index kept = samples; kept >= samples / 2 && kept > 0; kept -= step) {
    const RowVectorXd speed = motion.dq.row(kept - 1) + T * trajectory.u.row(kept - 1);
    for (int tenths = 1; tenths <= 30; ++tenths) {
      const Index braking = std::max<Index>(1, std::lround(0.1 * tenths / T));
      HeldAccelerations whole = trajectory;
      // one more sample stands still: the motion's last row is then at rest
      whole.u.conservativeResize(kept + braking + 1, n);
      whole.u.middleRows(kept, braking).rowwise() = -speed / (T * static_cast<double>(braking));
      whole.u.row(kept + braking).setZero();
      if (limit_shares(model, limits, whole.motion()).largest() <= 1) return whole;
    }
  }
  return std::nullopt;
}

}  // namespace dyngen::runtime

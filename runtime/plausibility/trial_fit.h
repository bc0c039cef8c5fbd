// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/least_squares.h"
#include "runtime/identification/motion_source.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// How columns of a recording might have to be read: numbers of joint j are those of the columns
/// `position_from[j]` and `torque_from[j]` times a factor, `lag` samples later.
struct Reading {
  Eigen::VectorXd position_factor, torque_factor;  ///< (n)
  std::vector<int> position_from, torque_from;     ///< (n)
  std::vector<Eigen::Index> position_lag;          ///< (n) samples
  Eigen::Index torque_lag = 0;                     ///< samples, of all joints
  double time_factor = 1;

  /// As it stands. @param joints  n
  static Reading plain(int joints);
};

/// A plain fit to some samples of all recordings.
struct TrialFit {
  TorqueFactor equations;
  Estimate estimate;
  Eigen::VectorXd left;  ///< (n) residual norm over torque norm; 0 without torque
  Eigen::VectorXd
      inertia;  ///< (n) mean of the mass matrix's diagonal where the joint moves, kg m^2 or kg
  Eigen::VectorXd power;  ///< (n) mean power that friction takes, W
};

/// (nb) Standard deviations of its parameters, as if what is left were white; 0 of what is not
/// seen.
Eigen::VectorXd deviations_of(const TrialFit& fit);

/// Some samples of recordings, which can be read in other ways.
class TrialSamples {
 public:
  /// @param most_lag  s that a reading may ask for
  TrialSamples(const std::vector<MotionSource>& sources, double most_lag);

  [[nodiscard]] bool empty() const { return places_.empty(); }
  [[nodiscard]] double sample_time() const { return sample_time_; }
  [[nodiscard]] Eigen::Index most_lag() const { return most_lag_; }
  [[nodiscard]] int joints() const { return static_cast<int>(still_.size()); }
  [[nodiscard]] TrialFit fit(const LinearModel& model, const Reading& reading) const;
  /// (n) joints that move in at least a tenth of the samples in which this one does.
  /// @param joint  from 0
  [[nodiscard]] std::vector<bool> moving_with(int joint) const;

 private:
  struct Place {
    std::size_t run;
    Eigen::Index row;
  };

  /// (N x n) each.
  struct ReadSamples {
    Eigen::MatrixXd q, dq, ddq, tau;
    Eigen::MatrixXd counted;  ///< 1, or 0 where a joint stands or has no torque: tau is 0 then
  };
  [[nodiscard]] ReadSamples read(const Reading& reading) const;

  std::vector<Motion> runs_;
  std::vector<Place> places_;
  Eigen::VectorXd still_;  ///< (n)
  std::vector<bool> dead_;
  double sample_time_ = 0;
  Eigen::Index most_lag_ = 0;  ///< samples
};

}  // namespace dyngen::runtime

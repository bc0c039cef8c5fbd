// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/model/linear_model.h"
#include "runtime/recordings/recording.h"
#include "runtime/signals/joint_state.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"
#include "runtime/wind_up/wind_up.h"

namespace dyngen::runtime {

/// Places among the parameters that make the load of a joint: bodies, not rotors or friction.
std::vector<int> load_places(const LinearModel& model, int joint);

/// Samples of all joints that have two encoders, of one recording after the other: the wind-up, the
/// motion, the load, and on some rows the load's derivatives by its parameters.
class WindUpSamples {
 public:
  /// @param model, load  outlive this
  /// @param joints       from 0: those with two encoders in one of the recordings
  /// @param stride       samples from one row of derivatives to the next
  WindUpSamples(const LinearModel& model, const LoadModel& load, std::vector<int> joints,
                Eigen::Index stride);

  /// @return false: a run has another sample time than those before; it and what follows it are
  ///         left out
  bool add(const Recording& recording, const JointStates& states);

  /// @param place  among the joints
  /// @return without the encoder's step, the gear and the rotor
  [[nodiscard]] WindUpData data(std::size_t place) const;

 private:
  struct OfJoint {
    std::vector<Eigen::Index> run_starts;
    std::vector<double> wind_up, q, dq, ddq, load;
    Eigen::MatrixXd derivatives;        ///< (M x p), the first rows of which are used
    std::vector<Eigen::Index> sampled;  ///< samples of these rows
  };

  void add_block(const Recording& recording, const Motion& run, Eigen::Index run_row,
                 Eigen::Index first, Eigen::Index count);
  [[nodiscard]] Eigen::MatrixXd load_of(const Motion& block);
  void keep_derivatives(OfJoint& samples, int joint, Eigen::Index count) const;

  const LinearModel& model_;
  const LoadModel& load_;
  std::vector<int> joints_;
  Eigen::Index stride_;
  std::vector<OfJoint> all_;
  Eigen::MatrixXd Y_;  // of a block
  double sample_time_ = 0, bandwidth_ = 0;
};

}  // namespace dyngen::runtime

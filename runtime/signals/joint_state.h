// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/recordings/recording.h"
#include "runtime/signals/butterworth.h"
#include "runtime/signals/cutoff.h"
#include "runtime/signals/motion.h"

namespace dyngen::runtime {

/// How velocity and acceleration come from positions.
enum class StateMethod {
  kLowPass,         ///< zero-phase Butterworth low-pass and central differences
  kKalmanFilter,    ///< white jerk, each sample from those before it
  kKalmanSmoother,  ///< white jerk, each sample from all
  kSpectral,        ///< in the frequency domain; every run covers whole periods
  kRecorded         ///< dq of the recording, and its ddq if it has one
};

struct JointStateOptions {
  StateMethod method = StateMethod::kLowPass;
  int order = 4;         ///< of the low-pass, 1..8
  double cutoff_hz = 0;  ///< Hz; 0: chosen from the data (choose_cutoff)
  /// s cut at each end of a run, where a filter knows one side only; negative: as long as the
  /// filter remembers a hundredth of what it saw. Spectral and recorded states lose nothing then.
  double trim = -1;
  /// rad or m, of all joints, for the Kalman methods, if rounding is all the noise there is; 0: the
  /// noise is chosen from the data, each joint its own.
  double encoder_step = 0;
  double jerk_intensity =
      0;  ///< rad^2/s^5, for the Kalman methods; 0: from the data, each joint its own

  /// @throws std::invalid_argument  naming the option and its range
  void validate() const;
};

struct JointStates {
  std::vector<Motion> runs;                ///< those that are long enough
  std::vector<Eigen::Index> first_rows{};  ///< of the recording, at which each of them begins
  bool stands = false;                     ///< no joint moves by more than the noise of positions
  Cutoff cutoff;  ///< of the low-pass and the spectral method; 0 Hz if there is none
  std::vector<std::string> messages;
};

/// Joint state of every run of a recording. Torque stays as it was measured; positions are the
/// method's own (filtered), but for kRecorded. No filter crosses from one run to the next.
///
/// A run that is too short for the method, or that trimming would leave nothing of, is left out and
/// a message says so. Where no run moves (poses that are held), every run has its mean position and
/// speeds and accelerations of exactly 0, of every method but kRecorded; nothing is trimmed. So has
/// a run of kRecorded whose dq is 0 throughout, but for the positions.
///
/// @throws std::invalid_argument  if options are not valid, matrices do not fit, a run is not
/// uniformly
///         sampled (any sample more than 1 % of a period off), or kRecorded finds no dq
JointStates joint_states(const Recording& recording, const JointStateOptions& options = {});

/// A part of a run.
struct StreamPiece {
  Motion motion;
  bool continues_run = false;  ///< its first sample follows the last one of the piece before
};

/// joint_states of kLowPass for recordings that do not fit into memory: chunks in, pieces out. What
/// it keeps does not grow with the recording. The pieces of a run, put together, are what
/// joint_states makes of the run, but for rounding: the forward pass goes on where it stopped, the
/// backward pass begins so far ahead of a piece that its beginning is forgotten.
class JointStateStream {
 public:
  /// @param sample_time  s, of all runs
  /// @throws std::invalid_argument  if options are not valid, or the method is not kLowPass, or
  ///         cutoff_hz is 0 (choose it from a first part: choose_cutoff)
  JointStateStream(const JointStateOptions& options, double sample_time);

  /// @param chunk          any number of samples; its run_starts after the first begin new runs
  /// @param continues_run  whether its first sample follows the last one of the chunk before
  /// @return               what is certain by now, often nothing
  /// @throws std::invalid_argument  if the number of joints changes or samples are not sample_time
  /// apart
  std::vector<StreamPiece> push(const Recording& chunk, bool continues_run);

  /// The end of the last run. The stream can be used again after it.
  std::vector<StreamPiece> finish();

  /// One for every run that was too short.
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  /// Samples of all columns that are still needed; the first has the number `begin` in its run.
  struct Columns {
    std::vector<std::vector<double>> columns;
    Eigen::Index begin = 0;

    [[nodiscard]] Eigen::Index end() const {
      return begin + (columns.empty() ? 0 : static_cast<Eigen::Index>(columns[0].size()));
    }
    [[nodiscard]] double at(std::size_t column, Eigen::Index sample) const {
      return columns[column][static_cast<std::size_t>(sample - begin)];
    }
    void drop_before(Eigen::Index sample);
  };

  void add(const Recording& chunk, Eigen::Index from, Eigen::Index to);
  void begin_run(std::size_t joints);
  void add_states(std::size_t joint, const double* here);
  void begin_filter();
  void filter_up_to(Eigen::Index end);
  void emit(Eigen::Index end, Eigen::Index filtered_end, std::vector<StreamPiece>& pieces);
  void emit_certain(std::vector<StreamPiece>& pieces);
  void end_run(std::vector<StreamPiece>& pieces);
  void end_short_run(std::vector<StreamPiece>& pieces);

  LowPass filter_;
  EndTreatment ends_;
  Eigen::Index trim_ = 0;  // samples
  double sample_time_ = 0;
  std::size_t joints_ = 0;
  Columns raw_;       // time, q of each joint, tau of each joint
  Columns filtered_;  // forward: q of each joint, then dq, then ddq
  std::vector<PassState> states_;
  bool filtering_ = false;
  Eigen::Index emitted_ = 0;  // samples of the run that are out, or trimmed
  bool any_emitted_ = false;
  int run_ = 0;
  std::vector<std::string> messages_;
};

}  // namespace dyngen::runtime

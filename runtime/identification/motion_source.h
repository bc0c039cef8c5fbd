// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/recording.h"
#include "runtime/signals/cutoff.h"
#include "runtime/signals/joint_state.h"

namespace dyngen::runtime {

/// Recordings that hold too little for what is asked of them: too short, or at rest. what() is a
/// sentence.
class TooLittleDataError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// What is done to a recording before a model sees it.
struct MotionOptions {
  JointStateOptions state;
  bool average_periods = true;   ///< where the motion repeats, its periods are averaged
  std::optional<double> period;  ///< s; none: looked for
  /// Bytes of text (four times the bytes of a .gz) above which a file is not read into memory but
  /// gone through piece by piece (low-pass method only; periods are not looked for then).
  std::size_t stream_above = 400'000'000;
  /// Bytes of text above which only those stretches are read into memory that say most
  /// (telling_stretches()); before stream_above.
  std::size_t stretches_above = std::numeric_limits<std::size_t>::max();
  /// The same of numbers in memory, as numbers_of_rows() counts them, where a recording is longer
  /// than `read_whole`.
  double numbers_above = std::numeric_limits<double>::infinity();
  double read_whole = 0;              ///< s
  double numbers_of_stretches = 1e6;  ///< StretchOptions::most_numbers
};

/// What is known of a recording's quality.
struct RecordingCondition {
  double sample_time = 0;             ///< s
  double jitter = 0;                  ///< of the sample time, relative
  bool resampled = false;             ///< onto a uniform grid
  std::vector<double> position_step;  ///< (n) encoder step found, rad or m; 0: none
  std::vector<bool> torque_clipped;   ///< (n)
  /// (n) torque that is one number throughout while the joint moves: it was not measured, and the
  /// joint has no equations; may be empty
  std::vector<bool> torque_dead;
  bool stands = false;             ///< no joint moves: each run is one pose
  int periods = 0;                 ///< that were found; 0: none
  double period = 0;               ///< s
  Eigen::VectorXd period_scatter;  ///< (n) rms over periods of the torque; may be empty
  std::vector<Notice> repairs;     ///< what the reader repaired
  std::vector<std::string> messages;
  /// Of a long recording: s since its start, first and last sample of each stretch that is used.
  std::vector<std::pair<double, double>> stretches;
};

/// Another joint state of a recording: behind a low-pass of the caller's, or of the samples of one
/// parity.
struct OtherState {
  int order = 0;    ///< of the low-pass; 0: that of the recording
  double hz = 0;    ///< its cut-off
  int parity = -1;  ///< 0, 1: positions of every other sample, and interpolated between
                    ///< (of_every_other()): two joint states with noise of their own; -1: of all
};

struct MotionSource;

/// Other joint states that a recording has.
struct OtherStates {
  /// Not where the cut-off was given, no low-pass gives the joint state, or the file is too large
  /// to be in memory.
  bool low_passes = false;
  /// Not where no low-pass gives the joint state, its cut-off is above a fifth of the sampling
  /// frequency, noise of the positions is less than 1e-7 of the square of all accelerations, or the
  /// file is too large to be in memory.
  bool parities = false;
  std::function<MotionSource(const OtherState& state)> make{};  ///< empty: there are none
  /// The recording behind a low-pass of another cut-off that was chosen, not told, with other joint
  /// states of its own. `trim`: s at each end of a run, negative: the filter's own. Empty where the
  /// cut-off was given or no low-pass gives the joint state.
  std::function<MotionSource(const Cutoff& cutoff, double trim)> at{};
};

/// The motion of a recording, which can be gone through again and again.
struct MotionSource {
  std::string name;
  double sample_time = 0;  ///< s
  double start = 0;        ///< s, time of the recording's first sample
  Cutoff cutoff;
  Eigen::VectorXd position_noise;  ///< (n) standard deviation of measured positions, rad or m
  Eigen::VectorXd fastest;         ///< (n) largest speed, rad/s or m/s
  RecordingCondition condition;
  /// Consecutive pieces of all runs.
  std::function<void(const std::function<void(const StreamPiece&)>&)> pieces;
  OtherStates others;
  /// As it was measured, on a uniform time base, before periods are averaged; empty of a file that
  /// is too large.
  std::shared_ptr<const Recording> recorded{};

  [[nodiscard]] int joints() const { return static_cast<int>(position_noise.size()); }
};

/// Joint state of a recording in memory, after its time base, quantisation, clipping and periods
/// were looked at.
/// @throws std::invalid_argument  if options are not valid
/// @throws TooLittleDataError          if nothing is left
MotionSource motion_of(Recording recording, const MotionOptions& options);

/// The same of a file; a large one is read again each time it is gone through, in constant memory.
/// @param repairs  what was repaired is appended, if not null; also where an error is thrown
/// @throws RecordingError; std::invalid_argument; TooLittleDataError
MotionSource motion_of_file(const std::string& path, const MotionOptions& options,
                            std::vector<Notice>* repairs = nullptr);

MotionSource motion_of_input(const RecordingInput& input, const MotionOptions& options,
                             std::vector<Notice>* repairs = nullptr);

/// The same recording, other pieces of it; with no other joint state, of which they are not.
MotionSource with_pieces(
    const MotionSource& source,
    std::function<void(const std::function<void(const StreamPiece&)>&)> pieces);

/// What is made of a recording, and of its other joint states where they are asked for.
MotionSource made_of(const MotionSource& source,
                     const std::function<MotionSource(const MotionSource&)>& change);

/// A part of every run: [from, to) of its samples as fractions of its length. For held-out checks.
MotionSource part_of(const MotionSource& source, double from, double to);

}  // namespace dyngen::runtime

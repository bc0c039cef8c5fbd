// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

struct WriteOptions {
  bool torque_required = true;
};

/// Writes a recording piece by piece, as write_recording() does.
class RecordingWriter {
 public:
  /// @param segments  with a column `segment`, the number of the run
  /// @throws RecordingError if the file cannot be written
  RecordingWriter(const std::string& path, bool segments);
  /// Takes an unfinished file away.
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// @param continues_run  its first row follows the last one of the chunk before
  /// @throws std::invalid_argument if the sizes do not fit together, or other columns came before
  /// @throws RecordingError
  void write(const Recording& chunk, bool continues_run, const WriteOptions& options = {});

  /// The file appears at its place. @throws RecordingError
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a recording as .csv, or as .csv.gz if the name ends in ".gz".
///
/// Numbers are the shortest that read back the same; reading gives the identical recording, as long
/// as nothing in it wants repair (docs/reference/recordings.md). With more than one run there is a
/// column `segment`. The file appears at once when it is complete.
///
/// @param options  without torque_required tau may be 0 x 0: a trajectory
/// @throws std::invalid_argument if the sizes in the recording do not fit together
/// @throws RecordingError if the file cannot be written, with the system's reason
void write_recording(const Recording& recording, const std::string& path,
                     const WriteOptions& options = {});

}  // namespace dyngen::runtime

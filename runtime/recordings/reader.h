// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/recording.h"
#include "runtime/recordings/sample_rows.h"

namespace dyngen::runtime {

struct ReadOptions {
  int joints = 0;                ///< how many are expected; 0: as many as the header names
  bool torque_required = true;   ///< false: tau may be absent, it is 0 x 0 then
  std::size_t max_notices = 20;  ///< of different kinds; one more says how many were left out
  /// All rows are read first, and sorted by time within their segment if that makes time regular
  /// (sort_shuffled_rows()). Memory is that of the whole file.
  bool sort_rows = false;
  /// Rows that share a time with other values are spread evenly up to the next time; else they are
  /// left out.
  bool spread_stamps = false;
  /// read_recording() alone: what only the whole signal shows is repaired (repair_signals()). Not
  /// where torque is not required: a trajectory is what somebody wants, jumps and all.
  bool repair_signals = true;
};

/// Reads a recording (.csv, .csv.gz) piece by piece in constant memory.
/// docs/reference/recordings.md has the format, what is repaired and what is refused.
///
///     RecordingReader reader("run.csv.gz");
///     Recording chunk;
///     while (reader.next(chunk, 10000)) use(chunk, reader.continues_run());
class RecordingReader {
 public:
  /// Opens the file and reads its header.
  /// @throws RecordingError
  explicit RecordingReader(const std::string& path, ReadOptions options = {});

  /// The same of samples that something else reads. @param place_word  what a place of them is
  RecordingReader(const OpenSampleSource& open_rows, const std::string& name,
                  const std::string& place_word, const ReadOptions& options = {});

  /// The same from memory (plain or gzip); `name` stands in messages.
  static RecordingReader from_text(std::string bytes, const std::string& name,
                                   ReadOptions options = {});

  ~RecordingReader();
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;

  /// Up to `rows` (>= 1) further samples; run_starts are relative to the chunk, the first is 0.
  /// The samples do not depend on how they are cut into chunks.
  ///
  /// @return false, and an empty chunk, at the end of the recording
  /// @throws RecordingError; also at the end, if too much was bad or nothing is left
  bool next(Recording& chunk, Eigen::Index rows);

  /// True if the first row of the last chunk continues the last run of the chunk before.
  [[nodiscard]] bool continues_run() const;

  /// What was repaired so far, in the order of the file.
  [[nodiscard]] const std::vector<Notice>& notices() const;

  [[nodiscard]] int joints() const;

  /// How often time went backward within a segment, in the rows of the file so far.
  [[nodiscard]] std::size_t backward_steps() const;

  /// How many rows had the time of the row before with other values, and how many rows there were.
  [[nodiscard]] std::size_t repeated_stamps() const;
  [[nodiscard]] std::size_t rows_read() const;

  /// ReadOptions::sort_rows: rows were not in the order of time, and are now.
  [[nodiscard]] bool rows_were_sorted() const;

  /// 0 .. 1, of the bytes on disk: for progress.
  [[nodiscard]] double fraction_read() const;

 private:
  struct State;
  explicit RecordingReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A recording that can be opened, as a file of its own or as what is made of a log.
struct RecordingInput {
  std::string name;
  std::function<RecordingReader(const ReadOptions& options)> open;
  bool reopens = true;         ///< it can be read again; a pipe cannot
  std::size_t text_bytes = 0;  ///< about how long it is as plain text; 0: not known
};

/// The recording in a file.
RecordingInput recording_file(const std::string& path);

/// Whether so many stamps are repeated that their rows are samples of their own.
bool stamps_are_repeated(const RecordingReader& reader);

/// Reads a whole recording into memory: rows that are shuffled are sorted, and signals are repaired
/// (repair_signals()).
///
/// @param notices  what was repaired is appended, if not null; also if the recording is then
/// refused
/// @throws RecordingError
Recording read_recording(const std::string& path, const ReadOptions& options = {},
                         std::vector<Notice>* notices = nullptr);
Recording read_recording(const RecordingInput& input, const ReadOptions& options = {},
                         std::vector<Notice>* notices = nullptr);

/// All that is left of a reader, in one piece.
Recording read_all(RecordingReader& reader);

}  // namespace dyngen::runtime

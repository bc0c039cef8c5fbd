// SPDX-License-Identifier: MIT
#include "runtime/recordings/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/recordings/byte_source.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/line_reader.h"
#include "runtime/recordings/row_parser.h"
#include "runtime/recordings/row_repair.h"
#include "runtime/recordings/time_repair.h"

namespace dyngen::runtime {

/// The file's lines as rows. Blank lines and comments are skipped.
/// Not in an unnamed namespace: RecordingReader::State, which has external linkage, holds one.
class RecordingRows {
 public:
  RecordingRows(ByteSource source, const ReadOptions& options, NoticeLog& log)
      : log_(&log), lines_(std::move(source), log), columns_(find_header(options)) {
    parser_.emplace(columns_, log);
  }

  [[nodiscard]] const Columns& columns() const { return columns_; }
  [[nodiscard]] double fraction_read() const { return lines_.fraction_read(); }
  [[nodiscard]] std::size_t last_line() const { return line_.number; }

  /// Appends the next row to `rows`; false at the end of the file.
  bool next(RowQueue& rows) {
    while (next_line()) {
      if (last_short_) throw *last_short_;
      rows.add();
      if (parser_->parse(line_, rows) == RowParser::Outcome::kRow) return true;
      rows.pop_back();
      last_short_ = parser_->too_short();
      last_short_line_ = line_.number;
    }
    if (last_short_) {
      log_->add_once("truncated", last_short_line_, 0, "the last row is truncated; left out");
      last_short_.reset();
    }
    return false;
  }

 private:
  bool next_line() {
    if (held_back_) {
      held_back_ = false;
      return true;
    }
    while (lines_.next(line_)) {
      const std::string_view text = trimmed(line_.text);
      if (text.empty()) {
        log_->add("blank", line_.number, 1, "found a blank line; skipped");
      } else if (text.front() == '#') {
        log_->add("comment", line_.number, 1, "found a comment; skipped");
        keep_comment(text);
      } else {
        return true;
      }
    }
    return false;
  }

  /// Some programs write the header as a comment.
  void keep_comment(std::string_view text) {
    if (header_found_) return;
    text.remove_prefix(
        text.find_first_not_of("# \t") == text.npos ? text.size() : text.find_first_not_of("# \t"));
    if (text.size() <= 1 << 16 && looks_like_header(text)) {
      comment_.assign(text);
      comment_line_ = line_.number;
    }
  }

  Columns find_header(const ReadOptions& options) {
    if (!next_line()) {
      throw recording_error(log_->file(), line_.number, 1,
                            line_.number == 0
                                ? "found an empty file, expected a recording"
                                : fmt::format("found no header, expected 'time,q1,...{}'",
                                              options.torque_required ? ",tau1,..." : ""));
    }
    header_found_ = true;
    const std::string_view text = trimmed(line_.text);
    constexpr std::string_view kNumberBegins = "+-.0123456789";
    if (!comment_.empty() && kNumberBegins.find(text.front()) != kNumberBegins.npos) {
      log_->add_once("comment header", comment_line_, 1, "the header is a comment; accepted");
      held_back_ = true;
      return read_header(comment_, comment_line_, options.joints, options.torque_required, *log_);
    }
    return read_header(line_.text, line_.number, options.joints, options.torque_required, *log_);
  }

  NoticeLog* log_;
  LineReader lines_;
  Line line_;
  bool header_found_ = false;
  bool held_back_ = false;  ///< line_ is still to be used
  std::string comment_;     ///< the last one that looks like a header
  std::size_t comment_line_ = 0;
  Columns columns_;
  std::optional<RowParser> parser_;
  std::optional<RecordingError> last_short_;  ///< an error, unless the file ends there
  std::size_t last_short_line_ = 0;
};

struct RecordingReader::State {
  State(ByteSource source, std::string name, const ReadOptions& options)
      : log(std::move(name), options.max_notices),
        rows(std::move(source), options, log),
        out(rows.columns().width()),
        filter(rows.columns().width(), out, log),
        values(rows.columns().width(), filter, log),
        time(rows.columns().width(), values, log) {
    notices = log.notices();
  }

  void fill(std::size_t wanted);
  void finish();
  void take(Recording& chunk, std::size_t count);

  NoticeLog log;
  std::vector<Notice> notices;
  RecordingRows rows;
  RowQueue out;
  ShortRunFilter filter;
  BadValueRepair values;
  TimeRepair time;
  std::size_t data_rows = 0;
  std::size_t delivered = 0;
  bool finished = false;
  bool continues_run = false;
};

void RecordingReader::State::fill(std::size_t wanted) {
  while (out.size() < wanted && !finished) {
    if (rows.next(time.queue())) {
      ++data_rows;
      time.pushed();
    } else {
      finish();
    }
  }
}

void RecordingReader::State::finish() {
  finished = true;
  time.finish();
  values.finish();
  filter.finish();
  if (data_rows == 0) {
    throw recording_error(log.file(), rows.last_line(), 1,
                          "found no rows of data after the header, expected two or more");
  }
  if (delivered + out.size() < 2) {
    throw recording_error(
        log.file(), rows.last_line(), 1,
        data_rows == 1
            ? "found one row of data, expected two or more"
            : fmt::format("found no run of {} samples among {} rows of data, expected one or more "
                          "(a run ends where time goes back or leaves a gap)",
                          kShortestRun, data_rows));
  }
}

/// Moves the first `count` rows of `out` into the columns of a chunk.
void RecordingReader::State::take(Recording& chunk, std::size_t count) {
  const Columns& columns = rows.columns();
  const auto samples = static_cast<Eigen::Index>(count);
  const Eigen::Index n = columns.joints;
  chunk.file_name = log.file();
  chunk.run_starts.clear();
  chunk.time.resize(samples);
  chunk.q.resize(samples, n);
  const auto shape = [&](Eigen::MatrixXd& matrix, bool there, Eigen::Index width) {
    matrix.resize(there ? samples : 0, there ? width : 0);
  };
  shape(chunk.tau, columns.tau, n);
  shape(chunk.dq, columns.dq, n);
  shape(chunk.ddq, columns.ddq, n);
  shape(chunk.tau_sim, columns.tau_sim, n);
  shape(chunk.temperature, columns.temperatures > 0, columns.temperatures);

  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double* value = out.values(0);
    const bool starts_run = out.info(0).starts_run;
    if (i == 0) continues_run = !starts_run;
    if (starts_run || i == 0) chunk.run_starts.push_back(row);
    chunk.time(row) = *value++;
    for (Eigen::MatrixXd* matrix :
         {&chunk.q, &chunk.tau, &chunk.dq, &chunk.ddq, &chunk.tau_sim, &chunk.temperature}) {
      for (Eigen::Index j = 0; j < matrix->cols(); ++j) (*matrix)(row, j) = *value++;
    }
    out.pop_front();
  }
  delivered += count;
}

RecordingReader::RecordingReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
RecordingReader::~RecordingReader() = default;
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;

RecordingReader::RecordingReader(const std::string& path, ReadOptions options) {
  try {
    state_ = std::make_unique<State>(ByteSource::from_file(path), path, options);
  } catch (const RecordingError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw recording_error(path, 0, 0, error.what());
  }
}

RecordingReader RecordingReader::from_text(std::string bytes, std::string name,
                                           ReadOptions options) {
  try {
    return RecordingReader(
        std::make_unique<State>(ByteSource::from_text(std::move(bytes)), name, options));
  } catch (const RecordingError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw recording_error(name, 0, 0, error.what());
  }
}

bool RecordingReader::next(Recording& chunk, Eigen::Index rows) {
  if (rows < 1) {
    throw std::invalid_argument(
        fmt::format("RecordingReader::next(): rows is {}, expected 1 or more", rows));
  }
  const auto wanted = static_cast<std::size_t>(rows);
  try {
    state_->fill(wanted);
  } catch (...) {
    state_->finished = true;
    state_->notices = state_->log.notices();
    throw;
  }
  state_->notices = state_->log.notices();
  state_->take(chunk, std::min(wanted, state_->out.size()));
  return chunk.samples() > 0;
}

bool RecordingReader::continues_run() const { return state_->continues_run; }
const std::vector<Notice>& RecordingReader::notices() const { return state_->notices; }
int RecordingReader::joints() const { return state_->rows.columns().joints; }

double RecordingReader::fraction_read() const {
  return state_->finished ? 1 : state_->rows.fraction_read();
}

Recording read_all(RecordingReader& reader) {
  constexpr Eigen::Index kRows = 1 << 15;
  std::vector<Recording> chunks;
  std::vector<bool> continues;
  Eigen::Index samples = 0;
  Recording all;
  for (Recording chunk; reader.next(chunk, kRows); chunk = Recording()) {
    samples += chunk.samples();
    continues.push_back(reader.continues_run());
    chunks.push_back(std::move(chunk));
  }
  if (chunks.empty()) return all;

  all.file_name = chunks.front().file_name;
  all.time.resize(samples);
  constexpr std::array<Eigen::MatrixXd Recording::*, 6> kParts = {
      &Recording::q,   &Recording::tau,     &Recording::dq,
      &Recording::ddq, &Recording::tau_sim, &Recording::temperature};
  for (const auto part : kParts) {
    const Eigen::Index width = (chunks.front().*part).cols();
    (all.*part).resize(width > 0 ? samples : 0, width);
  }
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    Recording& chunk = chunks[i];
    const Eigen::Index count = chunk.samples();
    all.time.segment(first, count) = chunk.time;
    for (const auto part : kParts) {
      if ((all.*part).cols() > 0) (all.*part).middleRows(first, count) = chunk.*part;
    }
    for (std::size_t run = continues[i] && i > 0 ? 1 : 0; run < chunk.run_starts.size(); ++run) {
      all.run_starts.push_back(first + chunk.run_starts[run]);
    }
    first += count;
    chunk = Recording();  // its memory is needed
  }
  return all;
}

Recording read_recording(const std::string& path, const ReadOptions& options,
                         std::vector<Notice>* notices) {
  RecordingReader reader(path, options);
  const auto tell = [&] {
    if (notices == nullptr) return;
    notices->insert(notices->end(), reader.notices().begin(), reader.notices().end());
  };
  try {
    Recording recording = read_all(reader);
    tell();
    return recording;
  } catch (const RecordingError&) {
    tell();
    throw;
  }
}

}  // namespace dyngen::runtime

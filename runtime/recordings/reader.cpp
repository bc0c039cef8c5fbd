// SPDX-License-Identifier: MIT
#include "runtime/recordings/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

#include "runtime/recordings/byte_source.h"
#include "runtime/recordings/recording_rows.h"
#include "runtime/recordings/row_repair.h"
#include "runtime/recordings/shuffled_rows.h"
#include "runtime/recordings/signal_repair.h"
#include "runtime/recordings/time_repair.h"

namespace dyngen::runtime {

struct RecordingReader::State {
  State(const OpenSampleSource& open_rows, std::string name, std::string place_word,
        const ReadOptions& options)
      : log(std::move(name), options.max_notices, std::move(place_word)),
        sort_rows(options.sort_rows),
        rows(open_rows(log)),
        all(rows->layout().width()),
        out(rows->layout().width()),
        filter(rows->layout().width(), out, log),
        values(rows->layout().width(), filter, log),
        time(rows->layout().width(), values, log, options.spread_stamps) {
    if (sort_rows) rows->segments_come_again();
    notices = log.notices();
  }

  bool next_row();
  void read_and_sort();
  void fill(std::size_t wanted);
  void finish();
  void take(Recording& chunk, std::size_t count);

  NoticeLog log;
  std::vector<Notice> notices;
  bool sort_rows, were_sorted = false;
  std::unique_ptr<SampleSource> rows;
  RowQueue all;  ///< every row, if they are to be sorted
  RowQueue out;
  ShortRunFilter filter;
  BadValueRepair values;
  TimeRepair time;
  std::size_t data_rows = 0;
  std::size_t delivered = 0;
  std::size_t backward_steps = 0;
  std::size_t repeated_stamps = 0;
  double last_time = std::numeric_limits<double>::quiet_NaN();
  std::int64_t last_segment = 0;
  bool all_read = false;
  bool finished = false;
  bool continues_run = false;
};

/// Puts the next row into time.queue().
bool RecordingReader::State::next_row() {
  RowQueue& queue = time.queue();
  if (sort_rows) {
    if (!all_read) read_and_sort();
    if (all.empty()) return false;
    queue.push(all.values(0), all.info(0));
    all.pop_front();
    return true;
  }
  if (!rows->next(queue)) return false;
  const double now = queue.time(queue.size() - 1);
  const std::int64_t segment = queue.info(queue.size() - 1).segment;
  if (now < last_time && segment == last_segment) ++backward_steps;
  if (now == last_time && segment == last_segment && queue.size() > 1) {
    const double* row = queue.values(queue.size() - 1);
    const double* before = queue.values(queue.size() - 2);
    if (!std::equal(row + 1, row + rows->layout().width(), before + 1)) ++repeated_stamps;
  }
  if (!std::isnan(now)) last_time = now;
  last_segment = segment;
  return true;
}

void RecordingReader::State::read_and_sort() {
  while (rows->next(all)) {
  }
  all_read = true;
  were_sorted = sort_shuffled_rows(all, rows->layout().width(), log);
}

void RecordingReader::State::fill(std::size_t wanted) {
  while (out.size() < wanted && !finished) {
    if (next_row()) {
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
    throw log.error(rows->last_place(), 1,
                    "found no rows of data after the header, expected two or more");
  }
  if (delivered + out.size() < 2) {
    throw log.error(
        rows->last_place(), 1,
        data_rows == 1
            ? "found one row of data, expected two or more"
            : fmt::format("found no run of {} samples among {} rows of data, expected one or more "
                          "(a run ends where time goes back or leaves a gap)",
                          kShortestRun, data_rows));
  }
}

/// Moves the first `count` rows of `out` into the columns of a chunk.
void RecordingReader::State::take(Recording& chunk, std::size_t count) {
  const SampleLayout& columns = rows->layout();
  const auto samples = static_cast<Eigen::Index>(count);
  const Eigen::Index n = columns.joints;
  chunk.file_name = log.file();
  chunk.place_word = log.place_word();
  chunk.run_starts.clear();
  chunk.lines.clear();
  chunk.lines.reserve(count);
  chunk.time.resize(samples);
  chunk.q.resize(samples, n);
  const auto shape = [&](Eigen::MatrixXd& matrix, bool there, Eigen::Index width) {
    matrix.resize(there ? samples : 0, there ? width : 0);
  };
  shape(chunk.tau, columns.tau, n);
  shape(chunk.dq, columns.dq, n);
  shape(chunk.ddq, columns.ddq, n);
  shape(chunk.tau_sim, columns.tau_sim, n);
  shape(chunk.q_link, !columns.links.empty(), n);
  chunk.q_link.setConstant(std::numeric_limits<double>::quiet_NaN());
  chunk.link_places.assign(columns.links.empty() ? 0 : static_cast<std::size_t>(n), {0, 0});
  for (const LinkColumn& link : columns.links) {
    chunk.link_places[static_cast<std::size_t>(link.joint)] = {link.line, link.column};
  }
  shape(chunk.temperature, columns.temperatures > 0, columns.temperatures);

  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double* value = out.values(0);
    const bool starts_run = out.info(0).starts_run;
    if (i == 0) continues_run = !starts_run;
    if (starts_run || i == 0) chunk.run_starts.push_back(row);
    chunk.lines.push_back(static_cast<std::uint32_t>(out.info(0).line));
    chunk.time(row) = *value++;
    for (Eigen::MatrixXd* matrix : {&chunk.q, &chunk.tau, &chunk.dq, &chunk.ddq, &chunk.tau_sim}) {
      for (Eigen::Index j = 0; j < matrix->cols(); ++j) (*matrix)(row, j) = *value++;
    }
    for (const LinkColumn& link : columns.links) chunk.q_link(row, link.joint) = *value++;
    for (Eigen::Index j = 0; j < chunk.temperature.cols(); ++j) {
      chunk.temperature(row, j) = *value++;
    }
    out.pop_front();
  }
  delivered += count;
}

namespace {

OpenSampleSource rows_of_text(ByteSource source, const ReadOptions& options) {
  auto held = std::make_shared<ByteSource>(std::move(source));
  return [held, options](NoticeLog& log) -> std::unique_ptr<SampleSource> {
    return std::make_unique<RecordingRows>(
        std::move(*held), ExpectedColumns{options.joints, options.torque_required}, log);
  };
}

}  // namespace

RecordingReader::RecordingReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
RecordingReader::~RecordingReader() = default;
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;

RecordingReader::RecordingReader(const std::string& path, ReadOptions options) {
  try {
    state_ = std::make_unique<State>(rows_of_text(ByteSource::from_file(path), options), path,
                                     "line", options);
  } catch (const RecordingError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw recording_error(path, 0, 0, error.what());
  }
}

RecordingReader::RecordingReader(const OpenSampleSource& open_rows, const std::string& name,
                                 const std::string& place_word, const ReadOptions& options) {
  state_ = std::make_unique<State>(open_rows, name, place_word, options);
}

RecordingReader RecordingReader::from_text(std::string bytes, const std::string& name,
                                           ReadOptions options) {
  try {
    return RecordingReader(std::make_unique<State>(
        rows_of_text(ByteSource::from_text(std::move(bytes)), options), name, "line", options));
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
int RecordingReader::joints() const { return state_->rows->layout().joints; }
std::size_t RecordingReader::backward_steps() const { return state_->backward_steps; }
std::size_t RecordingReader::repeated_stamps() const { return state_->repeated_stamps; }
std::size_t RecordingReader::rows_read() const { return state_->data_rows; }
bool RecordingReader::rows_were_sorted() const { return state_->were_sorted; }

double RecordingReader::fraction_read() const {
  return state_->finished ? 1 : state_->rows->fraction_read();
}

bool stamps_are_repeated(const RecordingReader& reader) {
  constexpr std::size_t kFewestRepeated = 8;
  constexpr double kPartRepeated = 0.01;  // of the rows: fewer are rows that came twice
  return reader.repeated_stamps() >= kFewestRepeated &&
         static_cast<double>(reader.repeated_stamps()) >
             kPartRepeated * static_cast<double>(reader.rows_read());
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
  all.place_word = chunks.front().place_word;
  all.link_places = chunks.front().link_places;
  all.time.resize(samples);
  for (const auto part : kRecordingParts) {
    const Eigen::Index width = (chunks.front().*part).cols();
    (all.*part).resize(width > 0 ? samples : 0, width);
  }
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    Recording& chunk = chunks[i];
    const Eigen::Index count = chunk.samples();
    all.time.segment(first, count) = chunk.time;
    for (const auto part : kRecordingParts) {
      if ((all.*part).cols() > 0) (all.*part).middleRows(first, count) = chunk.*part;
    }
    for (std::size_t run = continues[i] && i > 0 ? 1 : 0; run < chunk.run_starts.size(); ++run) {
      all.run_starts.push_back(first + chunk.run_starts[run]);
    }
    all.lines.insert(all.lines.end(), chunk.lines.begin(), chunk.lines.end());
    first += count;
    chunk = Recording();  // its memory is needed
  }
  return all;
}

namespace {

/// A file that was read once, whether it could be or not.
struct Attempt {
  Recording recording;
  std::vector<Notice> notices;
  std::exception_ptr error;
  std::size_t backward_steps = 0;
  bool sorted = false;
  bool stamps_repeat = false;
};

Attempt read_once(const RecordingInput& input, const ReadOptions& options) {
  RecordingReader reader = input.open(options);
  Attempt result;
  try {
    result.recording = read_all(reader);
  } catch (const RecordingError&) {
    result.error = std::current_exception();
  }
  result.notices = reader.notices();
  result.backward_steps = reader.backward_steps();
  result.sorted = reader.rows_were_sorted();
  result.stamps_repeat = stamps_are_repeated(reader);
  return result;
}

/// About how many bytes of text a file holds; 0 if it cannot be read, which its reader will say.
std::size_t bytes_of_text(const std::string& path) {
  constexpr std::size_t kPacked = 4;  // times as much text as gzip, at least
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (error) return 0;
  std::ifstream stream(path, std::ios::binary);
  const bool packed = stream.get() == 0x1f && stream.get() == 0x8b;
  return packed ? kPacked * bytes : bytes;
}

/// A pipe is not.
bool can_be_read_again(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

}  // namespace

RecordingInput recording_file(const std::string& path) {
  return {path, [path](const ReadOptions& options) { return RecordingReader(path, options); },
          can_be_read_again(path), bytes_of_text(path)};
}

Recording read_recording(const std::string& path, const ReadOptions& options,
                         std::vector<Notice>* notices) {
  return read_recording(recording_file(path), options, notices);
}

Recording read_recording(const RecordingInput& input, const ReadOptions& options,
                         std::vector<Notice>* notices) {
  Attempt result = read_once(input, options);
  if (result.backward_steps >= kFewestBackwardSteps && input.reopens) {
    ReadOptions sorting = options;
    sorting.sort_rows = true;
    Attempt sorted = read_once(input, sorting);
    if (sorted.sorted) result = std::move(sorted);
  } else if (result.stamps_repeat && input.reopens) {
    ReadOptions spreading = options;
    spreading.spread_stamps = true;
    result = read_once(input, spreading);
  }
  if (!result.error && options.repair_signals && options.torque_required) {
    try {
      repair_signals(result.recording, result.notices);
    } catch (const RecordingError&) {
      result.error = std::current_exception();
    }
  }
  if (notices != nullptr) {
    notices->insert(notices->end(), result.notices.begin(), result.notices.end());
  }
  if (result.error) std::rethrow_exception(result.error);
  return std::move(result.recording);
}

}  // namespace dyngen::runtime

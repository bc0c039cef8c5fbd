// SPDX-License-Identifier: MIT
#include "runtime/recordings/writer.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "runtime/recordings/gzip.h"

namespace dyngen::runtime {

/// Plain or gzip, by the name of the final file.
class RecordingFileOutput {
 public:
  RecordingFileOutput(const std::string& path, bool gzip) {
    if (gzip) {
      zipped_.emplace(path);
    } else {
      plain_.reset(std::fopen(path.c_str(), "wb"));
      if (!plain_) throw std::runtime_error(std::strerror(errno));
    }
  }
  void write(std::string_view text) {
    if (zipped_) {
      zipped_->write(text);
    } else if (std::fwrite(text.data(), 1, text.size(), plain_.get()) != text.size()) {
      throw std::runtime_error(std::strerror(errno));
    }
  }
  void close() {
    if (zipped_) {
      zipped_->close();
    } else if (std::fclose(plain_.release()) != 0) {
      throw std::runtime_error(std::strerror(errno));
    }
  }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, CloseFile> plain_;
  std::optional<ZippedFile> zipped_;
};

namespace {

using Eigen::Index;

struct Part {
  const char* name;
  Eigen::MatrixXd Recording::*matrix;
  bool per_joint;
};

constexpr std::array<Part, 7> kWrittenParts = {{{"q", &Recording::q, true},
                                                {"tau", &Recording::tau, true},
                                                {"qd", &Recording::dq, true},
                                                {"qdd", &Recording::ddq, true},
                                                {"tausim", &Recording::tau_sim, true},
                                                {"ql", &Recording::q_link, true},
                                                {"temp", &Recording::temperature, false}}};

void check(const Recording& recording, const WriteOptions& options) {
  const auto fail = [](const std::string& message) {
    throw std::invalid_argument("write_recording(): " + message);
  };
  if (recording.q.cols() < 1) fail("the recording has no joints");
  for (const Part& part : kWrittenParts) {
    const Eigen::MatrixXd& matrix = recording.*part.matrix;
    const bool required =
        part.matrix == &Recording::q || (part.matrix == &Recording::tau && options.torque_required);
    if (matrix.cols() == 0 && !required) continue;
    if (matrix.rows() != recording.samples() ||
        (part.per_joint && matrix.cols() != recording.q.cols())) {
      fail(fmt::format("{} is {} x {}, expected {} x {}", part.name, matrix.rows(), matrix.cols(),
                       recording.samples(), recording.q.cols()));
    }
  }
  Index least = 0;
  for (const Index start : recording.run_starts) {
    if (start < least || (start > 0 && least == 0) || start >= recording.samples()) {
      fail(fmt::format("run_starts has {}, expected 0 first, then rising below {}", start,
                       recording.samples()));
    }
    least = start + 1;
  }
}

void append_number(std::string& text, double value) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

/// All but positions behind gears that have no second encoder.
bool is_written(const Recording& recording, const Part& part, Index joint) {
  return part.matrix != &Recording::q_link || recording.has_link(joint);
}

std::string header_of(const Recording& recording, bool segments) {
  std::string text = "time";
  for (const Part& part : kWrittenParts) {
    for (Index j = 0; j < (recording.*part.matrix).cols(); ++j) {
      if (is_written(recording, part, j)) text += fmt::format(",{}{}", part.name, j + 1);
    }
  }
  text += segments ? ",segment\n" : "\n";
  return text;
}

/// @param first_run  number of the first row's run, from 0
void write_rows(const Recording& recording, bool segments, std::size_t first_run,
                RecordingFileOutput& file) {
  std::string text;
  std::size_t run = 0;
  for (Index k = 0; k < recording.samples(); ++k) {
    append_number(text, recording.time(k));
    for (const Part& part : kWrittenParts) {
      const Eigen::MatrixXd& matrix = recording.*part.matrix;
      for (Index j = 0; j < matrix.cols(); ++j) {
        if (!is_written(recording, part, j)) continue;
        text += ',';
        append_number(text, matrix(k, j));
      }
    }
    if (segments) {
      while (run < recording.run_starts.size() && recording.run_starts[run] <= k) ++run;
      text += ',';
      text += std::to_string(first_run + run);
    }
    text += '\n';
    constexpr std::size_t kWrittenAtOnce = 1 << 18;
    if (text.size() > kWrittenAtOnce) {
      file.write(text);
      text.clear();
    }
  }
  file.write(text);
}

}  // namespace

struct RecordingWriter::State {
  std::string path, unfinished;
  bool segments = true;
  std::optional<RecordingFileOutput> file;
  std::string header;
  std::size_t runs = 0;  ///< begun so far

  void remove() {
    file.reset();
    std::error_code ignored;
    if (!unfinished.empty()) std::filesystem::remove(unfinished, ignored);
    unfinished.clear();
  }
  /// Does something with the file; what fails takes it away.
  template <typename Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const std::runtime_error& error) {
      remove();
      throw RecordingError(fmt::format("{}: error: cannot write the file: {}", path, error.what()));
    }
  }
};

RecordingWriter::RecordingWriter(const std::string& path, bool segments)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->segments = segments;
  state_->unfinished = path + ".part";
  state_->guarded([&] { state_->file.emplace(state_->unfinished, path.ends_with(".gz")); });
}

RecordingWriter::~RecordingWriter() { state_->remove(); }

void RecordingWriter::write(const Recording& chunk, bool continues_run,
                            const WriteOptions& options) {
  check(chunk, options);
  const std::string header = header_of(chunk, state_->segments);
  if (!state_->header.empty() && header != state_->header) {
    throw std::invalid_argument(
        fmt::format("RecordingWriter::write(): found columns {} after {}", header, state_->header));
  }
  state_->guarded([&] {
    if (state_->header.empty()) state_->file->write(header);
    state_->header = header;
    const bool continues = continues_run && state_->runs > 0;
    const std::size_t before = state_->runs - (continues ? 1 : 0);
    write_rows(chunk, state_->segments, before, *state_->file);
    state_->runs = before + chunk.run_starts.size();
  });
}

void RecordingWriter::finish() {
  state_->guarded([&] {
    state_->file->close();
    std::error_code failure;
    std::filesystem::rename(state_->unfinished, state_->path, failure);
    if (failure) throw std::runtime_error(failure.message());
    state_->unfinished.clear();
  });
}

void write_recording(const Recording& recording, const std::string& path,
                     const WriteOptions& options) {
  check(recording, options);
  RecordingWriter writer(path, recording.run_starts.size() > 1);
  writer.write(recording, false, options);
  writer.finish();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
// Any bytes are either a recording or a RecordingError that says where; nothing else may happen,
// and the samples do not depend on how they are cut into chunks.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "runtime/recordings/reader.h"

namespace {

using dyngen::runtime::Recording;
using dyngen::runtime::RecordingError;
using dyngen::runtime::RecordingReader;

constexpr std::string_view kFileName = "fuzz.csv";

[[noreturn]] void fail(const char* claim, std::string_view detail) {
  std::fprintf(stderr, "violated: %s\n%.*s\n", claim, static_cast<int>(detail.size()),
               detail.data());
  std::abort();
}

struct Outcome {
  std::string error;
  Eigen::Index samples = 0;
  std::size_t runs = 0;
  double sum = 0;
};

void check_chunk(const Recording& chunk, bool continues_run, double& last_time) {
  const Eigen::Index rows = chunk.samples();
  if (chunk.q.rows() != rows || chunk.tau.rows() != rows || chunk.q.cols() != chunk.tau.cols()) {
    fail("sizes fit", "");
  }
  if (chunk.run_starts.empty() || chunk.run_starts.front() != 0) fail("a run begins at row 0", "");
  if (!chunk.time.allFinite() || !chunk.q.allFinite() || !chunk.tau.allFinite() ||
      !chunk.dq.allFinite() || !chunk.ddq.allFinite() || !chunk.tau_sim.allFinite() ||
      !chunk.temperature.allFinite()) {
    fail("values are finite", "");
  }
  for (Eigen::Index k = 0; k < rows; ++k) {
    const bool starts =
        std::find(chunk.run_starts.begin(), chunk.run_starts.end(), k) != chunk.run_starts.end();
    if ((!starts || (k == 0 && continues_run)) && !(chunk.time(k) > last_time)) {
      fail("time increases within a run", "");
    }
    last_time = chunk.time(k);
  }
}

Outcome read(const std::string& text, Eigen::Index rows) {
  Outcome outcome;
  try {
    RecordingReader reader = RecordingReader::from_text(text, std::string(kFileName));
    double last_time = 0;
    for (Recording chunk; reader.next(chunk, rows);) {
      check_chunk(chunk, reader.continues_run(), last_time);
      outcome.samples += chunk.samples();
      outcome.runs += chunk.run_starts.size() - (reader.continues_run() ? 1 : 0);
      outcome.sum += chunk.q.cwiseAbs().sum();
    }
    if (outcome.samples < 2) fail("a recording has two samples", "");
    if (reader.fraction_read() != 1) fail("all was read", "");
    for (const auto& notice : reader.notices()) {
      if (!notice.text().starts_with("fuzz.csv:")) fail("a notice names the file", notice.text());
    }
  } catch (const RecordingError& error) {
    outcome.error = error.what();
    if (!outcome.error.starts_with("fuzz.csv:") ||
        outcome.error.find(": error: ") == std::string::npos) {
      fail("an error names the file", outcome.error);
    }
  }
  return outcome;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Outcome whole = read(text, 1 << 20);
  const Outcome pieces = read(text, 5);
  if (whole.error != pieces.error) fail("chunks make no difference", whole.error + pieces.error);
  if (whole.error.empty() && (whole.samples != pieces.samples || whole.runs != pieces.runs ||
                              std::abs(whole.sum - pieces.sum) > 1e-12 * whole.sum)) {
    fail("chunks make no difference", "");
  }
  return 0;
}

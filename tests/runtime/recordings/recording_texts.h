// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/recording.h"

/// Small recordings as text, and ways to read them.
namespace dyngen::test {

/// Lines of a recording of two joints, header first: time k ms, q1 = k, q2 = -k, tau1 = k / 2,
/// tau2 = 7. Linear in time, so that interpolated values are known.
std::vector<std::string> plain_lines(int samples);

/// The lines, each with `end`.
std::string joined(const std::vector<std::string>& lines, const std::string& end = "\n");

/// plain_lines() with line `number` (from 1, the header is line 1) replaced.
std::string with_line(int samples, std::size_t number, const std::string& text);

struct ReadResult {
  runtime::Recording recording;
  std::vector<std::string> notices;  ///< as text
};

/// Reads text as "run.csv", in one piece.
ReadResult read_text(const std::string& text, runtime::ReadOptions options = {});

/// The same in chunks of that many rows, put together.
ReadResult read_in_chunks(const std::string& text, Eigen::Index rows);

/// The RecordingError that the text gives, or "nothing was thrown".
std::string error_of(const std::string& text, runtime::ReadOptions options = {});

/// Everything equal, bit by bit, but the file's name.
bool same(const runtime::Recording& a, const runtime::Recording& b);

}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#include "tests/runtime/recordings/recording_texts.h"

#include <cstdio>
#include <limits>

namespace dyngen::test {

using runtime::Recording;
using runtime::RecordingReader;

std::vector<std::string> plain_lines(int samples) {
  std::vector<std::string> lines = {"time,q1,q2,tau1,tau2"};
  for (int k = 0; k < samples; ++k) {
    char line[100];
    std::snprintf(line, sizeof line, "%.3f,%d,%d,%.1f,7", k * 1e-3, k, -k, k / 2.0);
    lines.emplace_back(line);
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end) {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

std::string with_line(int samples, std::size_t number, const std::string& text) {
  std::vector<std::string> lines = plain_lines(samples);
  lines.at(number - 1) = text;
  return joined(lines);
}

namespace {

std::vector<std::string> texts(const RecordingReader& reader) {
  std::vector<std::string> all;
  for (const runtime::Notice& notice : reader.notices()) all.push_back(notice.text());
  return all;
}

void append(Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
  if (more.cols() == 0) return;
  const Eigen::Index rows = all.rows();
  all.conservativeResize(rows + more.rows(), more.cols());
  all.bottomRows(more.rows()) = more;
}

}  // namespace

ReadResult read_text(const std::string& text, runtime::ReadOptions options) {
  RecordingReader reader = RecordingReader::from_text(text, "run.csv", options);
  ReadResult result;
  result.recording = runtime::read_all(reader);
  result.notices = texts(reader);
  return result;
}

ReadResult read_in_chunks(const std::string& text, Eigen::Index rows) {
  RecordingReader reader = RecordingReader::from_text(text, "run.csv");
  ReadResult result;
  Recording& all = result.recording;
  for (Recording chunk; reader.next(chunk, rows);) {
    const Eigen::Index first = all.samples();
    for (std::size_t i = reader.continues_run() ? 1 : 0; i < chunk.run_starts.size(); ++i) {
      all.run_starts.push_back(first + chunk.run_starts[i]);
    }
    all.time.conservativeResize(first + chunk.samples());
    all.time.tail(chunk.samples()) = chunk.time;
    for (const auto part : {&Recording::q, &Recording::tau, &Recording::dq, &Recording::ddq,
                            &Recording::tau_sim, &Recording::temperature}) {
      append(all.*part, chunk.*part);
    }
  }
  result.notices = texts(reader);
  return result;
}

std::string error_of(const std::string& text, runtime::ReadOptions options) {
  try {
    read_text(text, options);
  } catch (const runtime::RecordingError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

bool same(const Recording& a, const Recording& b) {
  bool equal = a.run_starts == b.run_starts && a.time.size() == b.time.size() && a.time == b.time;
  for (const auto part : {&Recording::q, &Recording::tau, &Recording::dq, &Recording::ddq,
                          &Recording::tau_sim, &Recording::temperature}) {
    equal = equal && (a.*part).rows() == (b.*part).rows() && (a.*part).cols() == (b.*part).cols() &&
            a.*part == b.*part;
  }
  return equal;
}

}  // namespace dyngen::test

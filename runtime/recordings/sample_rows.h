// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/row_queue.h"

namespace dyngen::runtime {

/// A column ql of a file.
struct LinkColumn {
  int joint = 0;                     ///< from 0
  std::size_t line = 0, column = 0;  ///< of its name in the file; 0: not known
};

/// Which values a sample has. They stand in one order whatever the file's: time, q, tau, dq, ddq,
/// tau_sim, q_link, temperature; all but time and q only if recorded. q_link has the joints of
/// `links` alone.
struct SampleLayout {
  int joints = 0;
  bool tau = false, dq = false, ddq = false, tau_sim = false;
  std::vector<LinkColumn> links;  ///< by joint
  int temperatures = 0;

  /// Number of values a sample has.
  [[nodiscard]] std::size_t width() const {
    const int groups = 1 + (tau ? 1 : 0) + (dq ? 1 : 0) + (ddq ? 1 : 0) + (tau_sim ? 1 : 0);
    return static_cast<std::size_t>(1 + groups * joints + temperatures) + links.size();
  }
};

/// Samples as they were written, in SI units and at the joints, before anything is repaired.
class SampleSource {
 public:
  SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;
  virtual ~SampleSource() = default;

  [[nodiscard]] virtual const SampleLayout& layout() const = 0;

  /// Appends the next row to `rows`: its values, and its info with place, segment, and the first
  /// bad value (which is NaN).
  /// @return false at the end  @throws RecordingError
  virtual bool next(RowQueue& rows) = 0;

  /// 0 .. 1: for progress.
  [[nodiscard]] virtual double fraction_read() const = 0;

  /// Of the last row, as its info has it.
  [[nodiscard]] virtual std::size_t last_place() const = 0;

  /// From now on a segment that comes again is the segment that it was.
  virtual void segments_come_again() {}
};

/// Opens samples; what is told of them goes to the log, which outlives them.
using OpenSampleSource = std::function<std::unique_ptr<SampleSource>(NoticeLog& log)>;

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace dyngen::runtime {

/// What a recording can hardly mean.
struct Remark {
  /// In one word: "degrees", "counts", "time_unit", "torque_unit", "torque_sign", "position_sign",
  /// "swapped", "same_column", "range", "torque_range", "motor_side", "gravity", "lag", "velocity",
  /// "torque_dead", "clipped", "negative", "position_unit", "residual".
  std::string kind;
  bool refused = false;   ///< nothing that is fitted to it would mean anything
  int joint = 0;          ///< from 1; 0: no single one
  std::string recording;  ///< empty: all of them
  std::string text;       ///< what, where, and what to do: a sentence

  /// "run.csv: joint 2: ..."
  [[nodiscard]] std::string words() const;
};

/// Recordings that are refused; what() has a line for each finding.
class ImplausibleError : public std::runtime_error {
 public:
  /// @param sentence  the findings as prose, for a report
  ImplausibleError(const std::string& lines, std::string sentence)
      : std::runtime_error(lines), sentence_(std::move(sentence)) {}
  [[nodiscard]] const std::string& sentence() const { return sentence_; }

 private:
  std::string sentence_;
};

}  // namespace dyngen::runtime

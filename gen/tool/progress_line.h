// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace dyngen {

/// One line on the terminal (standard error) that says what is being done, from the first second
/// on. Where standard error is no terminal there is none.
class ProgressLine {
 public:
  /// @param tool  that speaks
  explicit ProgressLine(std::string tool);
  /// Takes the line away.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const std::string& name, std::size_t place, std::size_t all);
  void clear();

 private:
  std::string tool_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool terminal_ = false;
  bool shown_ = false;
};

}  // namespace dyngen

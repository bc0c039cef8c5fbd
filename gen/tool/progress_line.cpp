// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/progress_line.h"

#include <unistd.h>

#include <iostream>
#include <utility>

namespace dyngen {
namespace {

constexpr const char* kClearLine = "\r\033[K";

}  // namespace

ProgressLine::ProgressLine(std::string tool)
    : tool_(std::move(tool)), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::clear() {
  if (shown_) std::cerr << kClearLine << std::flush;
  shown_ = false;
}

void ProgressLine::show(const std::string& name, std::size_t place, std::size_t all) {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  if (!terminal_ || elapsed < std::chrono::seconds(1)) return;
  std::cerr << kClearLine << tool_ << ": " << name << " (" << place + 1 << " of " << all << ")"
            << std::flush;
  shown_ = true;
}

}  // namespace dyngen

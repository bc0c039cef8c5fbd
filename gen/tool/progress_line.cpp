// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/progress_line.h"

#include <unistd.h>

#include <algorithm>
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
  constexpr std::size_t kColumns = 79;  // a longer line would not be taken away whole
  const std::string count = " (" + std::to_string(place + 1) + " of " + std::to_string(all) + ")";
  const std::size_t room = kColumns - std::min(kColumns - 4, tool_.size() + 2 + count.size());
  const std::string shown =
      name.size() <= room ? name : "..." + name.substr(name.size() - (room - 3));
  std::cerr << kClearLine << tool_ << ": " << shown << count << std::flush;
  shown_ = true;
}

}  // namespace dyngen

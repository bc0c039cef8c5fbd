// SPDX-License-Identifier: MIT
#include "runtime/recordings/notice_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dyngen::runtime {

RecordingError recording_error(const std::string& file, std::size_t line, std::size_t column,
                               std::string_view message) {
  std::string place = file;
  if (line != 0) place += fmt::format(":{}:{}", line, std::max<std::size_t>(column, 1));
  return RecordingError(fmt::format("{}: error: {}", place, message));
}

std::string quoted(std::string_view piece) {
  constexpr std::size_t kLongest = 40;
  std::string text(piece.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return fmt::format("'{}{}'", text, piece.size() > kLongest ? "..." : "");
}

NoticeLog::NoticeLog(std::string file, std::size_t max_notices, std::string place_word)
    : file_(std::move(file)), place_word_(std::move(place_word)), max_notices_(max_notices) {}

RecordingError NoticeLog::error(std::size_t line, std::size_t column,
                                std::string_view message) const {
  if (place_word_ == "line" || line == 0) return recording_error(file_, line, column, message);
  return RecordingError(fmt::format("{}: {} {}: error: {}", file_, place_word_, line, message));
}

NoticeLog::Entry* NoticeLog::find(std::string_view kind) {
  const auto same = [&](const Entry& entry) { return entry.kind == kind; };
  const auto found = std::find_if(entries_.begin(), entries_.end(), same);
  return found == entries_.end() ? nullptr : &*found;
}

void NoticeLog::add(std::string_view kind, std::size_t line, std::size_t column,
                    std::string message) {
  if (Entry* entry = find(kind)) {
    ++entry->more;
    entry->last_line = std::max(entry->last_line, line);
  } else if (entries_.size() < max_notices_) {
    entries_.push_back({std::string(kind), {file_, line, column, std::move(message), place_word_}, 0, line});
  } else {
    ++left_out_;
  }
}

void NoticeLog::add_once(std::string_view kind, std::size_t line, std::size_t column,
                         std::string message) {
  if (find(kind) == nullptr) add(kind, line, column, std::move(message));
}

std::vector<Notice> NoticeLog::notices() const {
  std::vector<Notice> all;
  all.reserve(entries_.size() + 1);
  for (const Entry& entry : entries_) {
    all.push_back(entry.first);
    if (entry.more > 0) {
      all.back().message +=
          fmt::format(" ({} such in all, the last in {} {})", entry.more + 1, place_word_,
                      entry.last_line);
    }
  }
  if (left_out_ > 0) {
    all.push_back(
        {file_, 0, 0, fmt::format("{} more notices are left out", left_out_), place_word_});
  }
  return all;
}

}  // namespace dyngen::runtime

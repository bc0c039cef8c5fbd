// SPDX-License-Identifier: MIT
#include "runtime/recordings/line_reader.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace dyngen::runtime {
namespace {

constexpr std::size_t kFirstPiece = 1 << 12, kPiece = 1 << 18;  // small files want little memory

/// Place of `wanted` in buffer[begin, end), or end.
std::size_t find_byte(const std::vector<char>& buffer, std::size_t begin, std::size_t end,
                      char wanted) {
  const void* found = std::memchr(buffer.data() + begin, wanted, end - begin);
  if (found == nullptr) return end;
  return static_cast<std::size_t>(static_cast<const char*>(found) - buffer.data());
}

}  // namespace

LineReader::LineReader(ByteSource source, NoticeLog& log)
    : source_(std::move(source)), log_(&log), buffer_(kFirstPiece) {}

void LineReader::refill() {
  if (end_ - begin_ > kLongestLine) {
    throw recording_error(log_->file(), number_ + 1, 1,
                          "found a line of more than 1 MB, expected one row a line");
  }
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size() || (number_ > 0 && buffer_.size() < kPiece)) {
    buffer_.resize(2 * buffer_.size());
  }
  try {
    const std::size_t got = source_.read(buffer_.data() + end_, buffer_.size() - end_);
    at_end_ = got == 0;
    if (number_ == 0 && source_.is_utf16()) {
      log_->add_once("utf16", 1, 1, "the text is UTF-16; read");
    }
    end_ += got;
  } catch (const std::runtime_error& error) {
    throw recording_error(log_->file(), number_ + 1, 1, error.what());
  }
  lf_ = find_byte(buffer_, begin_, end_, '\n');
  cr_ = find_byte(buffer_, begin_, end_, '\r');
}

void LineReader::take(Line& line, std::size_t stop, std::size_t end_size) {
  line.text = std::string_view(buffer_.data() + begin_, stop - begin_);
  line.number = ++number_;
  line.terminated = end_size > 0;
  begin_ = stop + end_size;
  if (lf_ < begin_) lf_ = find_byte(buffer_, begin_, end_, '\n');
  if (cr_ < begin_) cr_ = find_byte(buffer_, begin_, end_, '\r');

  if (line.text.size() > kLongestLine) {
    throw recording_error(log_->file(), number_, 1,
                          "found a line of more than 1 MB, expected one row a line");
  }
  if (const std::size_t nul = line.text.find('\0'); nul != line.text.npos) {
    throw recording_error(
        log_->file(), number_, nul + 1,
        "found a NUL byte, expected text (a binary file? 'dynid import --list' says what "
        "is in a log, and '--map' reads it)");
  }
  if (number_ == 1 && line.text.starts_with("\xEF\xBB\xBF")) {
    line.text.remove_prefix(3);
    log_->add_once("bom", 1, 1, "found a byte order mark; skipped");
  }
}

bool LineReader::next(Line& line) {
  for (;;) {
    const std::size_t stop = std::min(lf_, cr_);
    const bool cut_pair = stop + 1 == end_ && stop == cr_ && !at_end_;  // its LF may follow
    if (stop < end_ && !cut_pair) {
      const bool cr = stop == cr_;
      const bool crlf = cr && stop + 1 < end_ && buffer_[stop + 1] == '\n';
      take(line, stop, crlf ? 2 : 1);
      if (crlf && !crlf_noticed_) {
        crlf_noticed_ = true;
        log_->add_once("crlf", number_, line.text.size() + 1, "lines end with CR LF; accepted");
      } else if (cr && !crlf && !cr_noticed_) {
        cr_noticed_ = true;
        log_->add_once("cr", number_, line.text.size() + 1, "lines end with CR alone; accepted");
      }
      return true;
    }
    if (at_end_) {
      if (begin_ == end_) return false;
      take(line, end_, 0);
      return true;
    }
    refill();
  }
}

double LineReader::fraction_read() const { return source_.fraction_read(); }

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/recordings/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace dyngen::runtime {
namespace {

constexpr std::size_t kRawPiece = 1 << 18;

}  // namespace

ByteSource ByteSource::from_file(const std::string& path) {
  ByteSource source;
  errno = 0;
  source.file_.reset(std::fopen(path.c_str(), "rb"));
  if (!source.file_) {
    throw std::runtime_error(std::string("cannot open the file: ") + std::strerror(errno));
  }
  std::setvbuf(source.file_.get(), nullptr, _IONBF, 0);  // read in pieces here
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown) source.size_ = static_cast<double>(size);
  source.refill();
  source.detect_gzip();
  return source;
}

ByteSource ByteSource::from_text(std::string bytes) {
  ByteSource source;
  source.raw_ = std::move(bytes);
  source.size_ = static_cast<double>(source.raw_.size());
  source.consumed_ = source.size_;
  source.at_end_ = true;
  source.detect_gzip();
  return source;
}

void ByteSource::detect_gzip() {
  if (raw_.starts_with("\x1f\x8b")) unzipper_.emplace();
}

void ByteSource::refill() {
  raw_.resize(kRawPiece);
  begin_ = 0;
  const std::size_t got = std::fread(raw_.data(), 1, raw_.size(), file_.get());
  if (got == 0 && std::ferror(file_.get()) != 0) {
    throw std::runtime_error(std::string("cannot read the file: ") + std::strerror(errno));
  }
  raw_.resize(got);
  consumed_ += static_cast<double>(got);
  at_end_ = got == 0;
}

std::size_t ByteSource::read(char* out, std::size_t size) {
  for (;;) {
    if (begin_ == raw_.size() && !at_end_) refill();
    std::string_view unused = std::string_view(raw_).substr(begin_);
    if (!unzipper_) {
      const std::size_t taken = std::min(size, unused.size());
      std::memcpy(out, unused.data(), taken);
      begin_ += taken;
      return taken;
    }
    const bool nothing_left = unused.empty();
    if (nothing_left && unzipper_->at_member_end()) return 0;
    const std::size_t written = unzipper_->unpack(unused, out, size);
    begin_ = raw_.size() - unused.size();
    if (written > 0) return written;
    if (nothing_left) {
      throw std::runtime_error(
          "found the end of the file within a gzip stream, expected more: "
          "the file is truncated");
    }
  }
}

double ByteSource::fraction_read() const {
  if (at_end_ && begin_ == raw_.size()) return 1;
  if (size_ <= 0) return 0;
  const double waiting = static_cast<double>(raw_.size() - begin_);
  return std::clamp((consumed_ - waiting) / size_, 0.0, 1.0);
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/logs/log_bytes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "runtime/logs/log_error.h"

namespace dyngen::runtime {

BinaryReader::BinaryReader(const LogBytes& bytes) : name_(bytes.name), memory_(bytes.memory) {
  if (memory_) {
    size_ = memory_->size();
    return;
  }
  errno = 0;
  file_.reset(std::fopen(bytes.path.c_str(), "rb"));
  if (!file_) {
    throw log_error(name_, fmt::format("cannot open the file: {}", std::strerror(errno)));
  }
  std::error_code error;
  const auto size = std::filesystem::file_size(bytes.path, error);
  if (error) throw log_error(name_, "this format is read from files only, not from pipes");
  size_ = size;
}

void BinaryReader::fail(std::uint64_t place, std::string_view message) const {
  throw log_error_at(name_, "byte", place + 1, message);
}

void BinaryReader::seek(std::uint64_t place) {
  place_ = std::min(place, size_);
  if (file_ && fseeko(file_.get(), static_cast<off_t>(place_), SEEK_SET) != 0) {
    fail(place_, fmt::format("cannot read the file: {}", std::strerror(errno)));
  }
}

void BinaryReader::read(char* out, std::uint64_t count, std::string_view what) {
  if (count > left()) {
    fail(place_, fmt::format("found the end of the file after {} bytes, expected {} ({} bytes)",
                             left(), what, count));
  }
  const auto size = static_cast<std::size_t>(count);
  if (memory_) {
    std::memcpy(out, memory_->data() + place_, size);
  } else if (std::fread(out, 1, size, file_.get()) != size) {
    fail(place_, fmt::format("cannot read the file: {}", std::strerror(errno)));
  }
  place_ += count;
}

void BinaryReader::read(std::string& out, std::uint64_t count, std::string_view what) {
  if (count <= left()) out.resize(static_cast<std::size_t>(count));
  read(out.data(), count, what);
}

template <typename Value>
Value PieceReader::number() {
  const std::string_view raw = bytes(sizeof(Value));
  Value value = 0;
  for (std::size_t i = sizeof(Value); i-- > 0;) {
    value = static_cast<Value>(static_cast<std::uint64_t>(value) << 8 |
                               static_cast<unsigned char>(raw[i]));
  }
  return value;
}

template std::uint8_t PieceReader::number();
template std::uint16_t PieceReader::number();
template std::uint32_t PieceReader::number();
template std::uint64_t PieceReader::number();

std::string_view PieceReader::bytes(std::uint64_t count) {
  if (count > left()) {
    throw std::runtime_error(fmt::format("found {} bytes to its end at its byte {}, expected {}",
                                         left(), place_ + 1, count));
  }
  const std::string_view found = piece_.substr(place_, static_cast<std::size_t>(count));
  place_ += found.size();
  return found;
}

std::string_view PieceReader::text() { return bytes(number<std::uint32_t>()); }

ReadablePath::ReadablePath(const LogBytes& bytes) : path_(bytes.path) {
  if (!bytes.memory) return;
  std::error_code error;
  path_ = (std::filesystem::temp_directory_path(error) / "dyngen_log_XXXXXX").string();
  const int descriptor = mkstemp(path_.data());
  is_copy_ = descriptor >= 0;
  std::string_view left = *bytes.memory;
  while (is_copy_ && !left.empty()) {
    const ssize_t written = write(descriptor, left.data(), left.size());
    if (written <= 0) break;
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  if (is_copy_) close(descriptor);
  if (!is_copy_ || !left.empty()) {
    if (is_copy_) std::filesystem::remove(path_, error);
    throw log_error(bytes.name, "cannot write a copy of it, which the library of its format needs");
  }
}

ReadablePath::~ReadablePath() {
  std::error_code ignored;
  if (is_copy_) std::filesystem::remove(path_, ignored);
}

}  // namespace dyngen::runtime

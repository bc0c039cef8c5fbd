// SPDX-License-Identifier: MIT
#include "runtime/recordings/gzip.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

#if DYNGEN_WITH_ZLIB
#include <zlib.h>
#endif

namespace dyngen::runtime {

#if DYNGEN_WITH_ZLIB

bool gzip_available() { return true; }

struct Unzipper::State {
  z_stream stream{};
  bool member_end = false;
  State() {
    constexpr int kGzipOnly = 16;
    if (inflateInit2(&stream, MAX_WBITS + kGzipOnly) != Z_OK) {
      throw std::runtime_error("zlib found no memory");
    }
  }
  ~State() { inflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Unzipper::Unzipper() : state_(std::make_unique<State>()) {}

std::size_t Unzipper::unpack(std::string_view& packed, char* out, std::size_t size) {
  z_stream& stream = state_->stream;
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (state_->member_end) {
    if (packed.empty()) return 0;
    state_->member_end = false;
    inflateReset(&stream);
  }
  const std::size_t given = std::min(packed.size(), kMost);
  const std::size_t room = std::min(size, kMost);
  // zlib does not write to its input; its interface is older than const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(given);
  stream.next_out = reinterpret_cast<Bytef*>(out);
  stream.avail_out = static_cast<uInt>(room);
  const int outcome = inflate(&stream, Z_NO_FLUSH);
  packed.remove_prefix(given - stream.avail_in);
  if (outcome == Z_STREAM_END) {
    state_->member_end = true;
  } else if (outcome != Z_OK && outcome != Z_BUF_ERROR) {
    throw std::runtime_error(std::string("found a corrupt gzip stream (") +
                             (stream.msg != nullptr ? stream.msg : "zlib gives no reason") +
                             "), expected a whole .gz file");
  }
  return room - stream.avail_out;
}

bool Unzipper::at_member_end() const { return state_->member_end; }

struct ZippedFile::State {
  gzFile file = nullptr;
};

ZippedFile::ZippedFile(const std::string& path) : state_(std::make_unique<State>()) {
  errno = 0;
  state_->file = gzopen(path.c_str(), "wb");
  if (state_->file == nullptr) {
    throw std::runtime_error(errno != 0 ? std::strerror(errno) : "zlib found no memory");
  }
}

ZippedFile::~ZippedFile() {
  if (state_->file != nullptr) gzclose(state_->file);
}

void ZippedFile::write(std::string_view text) {
  if (!text.empty() &&
      gzwrite(state_->file, text.data(), static_cast<unsigned>(text.size())) == 0) {
    throw std::runtime_error(std::strerror(errno));
  }
}

void ZippedFile::close() {
  const int outcome = gzclose(state_->file);
  state_->file = nullptr;
  if (outcome != Z_OK) throw std::runtime_error(std::strerror(errno));
}

#else

bool gzip_available() { return false; }

namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error(
      "found a gzip file, and this library was built without zlib; unpack it first, or install "
      "zlib1g-dev and build anew");
}

}  // namespace

struct Unzipper::State {};
Unzipper::Unzipper() { refuse(); }
std::size_t Unzipper::unpack(std::string_view&, char*, std::size_t) { refuse(); }
bool Unzipper::at_member_end() const { return true; }

struct ZippedFile::State {};
ZippedFile::ZippedFile(const std::string&) {
  throw std::runtime_error(
      "a .gz file cannot be written: this library was built without zlib (zlib1g-dev)");
}
ZippedFile::~ZippedFile() = default;
void ZippedFile::write(std::string_view) {}
void ZippedFile::close() {}

#endif

Unzipper::~Unzipper() = default;
Unzipper::Unzipper(Unzipper&&) noexcept = default;
Unzipper& Unzipper::operator=(Unzipper&&) noexcept = default;

}  // namespace dyngen::runtime

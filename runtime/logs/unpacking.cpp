// SPDX-License-Identifier: MIT
#include "runtime/logs/unpacking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>

#include "runtime/logs/log_error.h"
#include "runtime/recordings/notice_log.h"

#ifdef DYNGEN_LOGS_WITH_LZ4
#include <lz4frame.h>
#endif
#ifdef DYNGEN_LOGS_WITH_ZSTD
#include <zstd.h>
#endif
#ifdef DYNGEN_LOGS_WITH_BZIP2
#include <bzlib.h>
#endif
#ifdef DYNGEN_LOGS_WITH_ZLIB
#include <zlib.h>
#endif

namespace dyngen::runtime {
namespace {

constexpr std::size_t kUnpackedPiece = 1 << 17;

/// Grows as bytes come.
class Unpacked {
 public:
  explicit Unpacked(std::size_t most) : most_(most), piece_(kUnpackedPiece, '\0') {}
  char* piece() { return piece_.data(); }
  [[nodiscard]] std::size_t piece_size() const { return piece_.size(); }
  void take(std::size_t size) {
    if (size > most_ - bytes_.size()) {
      throw std::runtime_error(fmt::format(
          "found more than {} bytes when it is unpacked, expected as many at most", most_));
    }
    bytes_.append(piece_, 0, size);
  }
  std::string result() { return std::move(bytes_); }

 private:
  std::size_t most_;
  std::string piece_, bytes_;
};

[[noreturn, maybe_unused]] void fail_without(std::string_view method, std::string_view package) {
  throw std::runtime_error(fmt::format(
      "found data packed with {}; reading it needs {} when dynid is built", method, package));
}

[[noreturn, maybe_unused]] void fail_damaged(std::string_view method, std::string_view why) {
  throw std::runtime_error(fmt::format("found damaged {} data ({}), expected whole data", method,
                                       why.empty() ? "no reason is given" : why));
}

#ifdef DYNGEN_LOGS_WITH_LZ4
std::string unpacked_lz4(std::string_view packed, std::size_t most) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    fail_damaged("lz4", "no memory");
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  Unpacked out(most);
  std::size_t wanted = 1;
  while (!packed.empty() || wanted != 0) {
    std::size_t given = packed.size(), room = out.piece_size();
    wanted = LZ4F_decompress(context.get(), out.piece(), &room, packed.data(), &given, nullptr);
    if (LZ4F_isError(wanted) != 0) fail_damaged("lz4", LZ4F_getErrorName(wanted));
    packed.remove_prefix(given);
    out.take(room);
    if (given == 0 && room == 0) {
      if (wanted == 0) break;
      fail_damaged("lz4", "it is cut off");
    }
  }
  return out.result();
}
#else
std::string unpacked_lz4(std::string_view, std::size_t) { fail_without("lz4", "liblz4-dev"); }
#endif

#ifdef DYNGEN_LOGS_WITH_ZSTD
std::string unpacked_zstd(std::string_view packed, std::size_t most) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          ZSTD_freeDStream);
  if (!stream || ZSTD_isError(ZSTD_initDStream(stream.get())) != 0) {
    fail_damaged("zstd", "no memory");
  }
  Unpacked out(most);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t wanted = 1;
  for (;;) {
    ZSTD_outBuffer piece{out.piece(), out.piece_size(), 0};
    const std::size_t before = in.pos;
    wanted = ZSTD_decompressStream(stream.get(), &piece, &in);
    if (ZSTD_isError(wanted) != 0) fail_damaged("zstd", ZSTD_getErrorName(wanted));
    out.take(piece.pos);
    if (in.pos == in.size && piece.pos < piece.size) break;
    if (in.pos == before && piece.pos == 0) break;
  }
  if (wanted != 0) fail_damaged("zstd", "it is cut off");
  return out.result();
}
#else
std::string unpacked_zstd(std::string_view, std::size_t) { fail_without("zstd", "libzstd-dev"); }
#endif

#ifdef DYNGEN_LOGS_WITH_BZIP2
std::string unpacked_bzip2(std::string_view packed, std::size_t most) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) fail_damaged("bz2", "no memory");
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                       BZ2_bzDecompressEnd);
  Unpacked out(most);
  // libbz2 does not write to its input; its interface is older than const.
  stream.next_in = const_cast<char*>(packed.data());
  stream.avail_in = static_cast<unsigned>(std::min<std::size_t>(packed.size(), kMostUnpacked));
  for (;;) {
    stream.next_out = out.piece();
    stream.avail_out = static_cast<unsigned>(out.piece_size());
    const int outcome = BZ2_bzDecompress(&stream);
    const std::size_t written = out.piece_size() - stream.avail_out;
    out.take(written);
    if (outcome == BZ_STREAM_END) return out.result();
    if (outcome != BZ_OK) fail_damaged("bz2", fmt::format("its error {}", outcome));
    if (stream.avail_in == 0 && written == 0) fail_damaged("bz2", "it is cut off");
  }
}
#else
std::string unpacked_bzip2(std::string_view, std::size_t) { fail_without("bz2", "libbz2-dev"); }
#endif

#ifdef DYNGEN_LOGS_WITH_ZLIB
constexpr bool kHasZlib = true;
std::string unpacked_zlib(std::string_view packed, std::size_t most) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) fail_damaged("zlib", "no memory");
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, inflateEnd);
  Unpacked out(most);
  // zlib does not write to its input; its interface is older than const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size(), kMostUnpacked));
  for (;;) {
    stream.next_out = reinterpret_cast<Bytef*>(out.piece());
    stream.avail_out = static_cast<uInt>(out.piece_size());
    const int outcome = inflate(&stream, Z_NO_FLUSH);
    const std::size_t written = out.piece_size() - stream.avail_out;
    out.take(written);
    if (outcome == Z_STREAM_END) return out.result();
    if (outcome != Z_OK && outcome != Z_BUF_ERROR) {
      fail_damaged("zlib", stream.msg != nullptr ? stream.msg : "");
    }
    if (stream.avail_in == 0 && written == 0) fail_damaged("zlib", "it is cut off");
  }
}
#else
constexpr bool kHasZlib = false;
std::string unpacked_zlib(std::string_view, std::size_t) { fail_without("zlib", "zlib1g-dev"); }
#endif

constexpr std::array<std::uint32_t, 256> crc_table() {
  constexpr std::uint32_t kPolynomial = 0xEDB88320;  // ISO 3309, bits turned round
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value & 1U) != 0 ? value >> 1 ^ kPolynomial : value >> 1;
    }
    table[i] = value;
  }
  return table;
}

}  // namespace

std::string unpacked(std::string_view method, std::string_view packed, std::size_t most) {
  if (method.empty() || method == "none") {
    if (packed.size() > most) {
      throw std::runtime_error(fmt::format("found {} bytes, expected {}", packed.size(), most));
    }
    return std::string(packed);
  }
  if (method == "lz4") return unpacked_lz4(packed, most);
  if (method == "zstd") return unpacked_zstd(packed, most);
  if (method == "bz2") return unpacked_bzip2(packed, most);
  if (method == "zlib") return unpacked_zlib(packed, most);
  throw std::runtime_error(
      fmt::format("found data packed with {}, expected lz4, zstd or bz2", in_quotes(method)));
}

bool unpacks_zlib() { return kHasZlib; }

bool is_zstd(std::string_view bytes) { return bytes.starts_with("\x28\xB5\x2F\xFD"); }

std::uint32_t crc32_of(std::string_view bytes) {
  static constexpr auto kTable = crc_table();
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFF] ^ crc >> 8;
  }
  return ~crc;
}

}  // namespace dyngen::runtime

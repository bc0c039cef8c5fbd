// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dyngen::runtime {

/// Pieces of a log that unpack to more than this are refused.
inline constexpr std::size_t kMostUnpacked = std::size_t{1} << 30;

/// Unpacks one piece: `method` is "lz4" (frames), "zstd", "bz2", "zlib", or "" and "none" for what
/// is not packed. Memory grows with what is really unpacked, up to `most` bytes.
///
/// @throws std::runtime_error, a sentence: the piece is damaged, unpacks to more, the method is
/// unknown, or this library was built without its package, which is named
std::string unpacked(std::string_view method, std::string_view packed, std::size_t most);

/// True if this library was built with zlib: unpacked() knows "zlib" then.
bool unpacks_zlib();

/// True if bytes begin as zstd does.
bool is_zstd(std::string_view bytes);

/// CRC-32 of ISO 3309, as zip, PNG and MCAP use it.
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace dyngen::runtime

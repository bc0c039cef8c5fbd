// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace dyngen::runtime {

enum class LogFormat {
  kText,
  kJson,
  kMatlab,
  kHdf5,
  kNumpy,
  kZip,
  kRosbag1,
  kSqlite,
  kMcap,
  kZstd
};

/// What bytes are, by their beginning.
/// @param head  the first bytes, of gzip files unpacked; kFormatHead of them if there are as many
LogFormat format_of(std::string_view head);

inline constexpr std::size_t kFormatHead = 1024;

}  // namespace dyngen::runtime

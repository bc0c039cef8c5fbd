// SPDX-License-Identifier: MIT
#include "runtime/logs/log_format.h"

namespace dyngen::runtime {
namespace {

/// The first sign of a JSON object or array: "[" may begin a row of units or names as well.
bool looks_like_json(std::string_view head) {
  constexpr std::string_view kBlanks = " \t\r\n";
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  std::size_t at = head.find_first_not_of(kBlanks);
  if (at == head.npos || (head[at] != '{' && head[at] != '[')) return false;
  const bool object = head[at] == '{';
  while (at < head.size() && head[at] == '[') at = head.find_first_not_of(kBlanks, at + 1);
  if (at >= head.size()) return !object;
  if (object) {
    at = head.find_first_not_of(kBlanks, at + 1);
    return at < head.size() && (head[at] == '"' || head[at] == '}');
  }
  return std::string_view("{]\"-0123456789nNtf").find(head[at]) != std::string_view::npos;
}

}  // namespace

LogFormat format_of(std::string_view head) {
  using namespace std::string_view_literals;
  if (head.starts_with("\x89HDF\r\n\x1a\n"sv)) return LogFormat::kHdf5;
  if (head.starts_with("MATLAB ")) return LogFormat::kMatlab;  // 7.3 too: HDF5 begins at 512
  if (head.size() > 520 && head.substr(512).starts_with("\x89HDF\r\n\x1a\n"sv)) {
    return LogFormat::kHdf5;  // with a block of the user's before it
  }
  if (head.starts_with("\x93NUMPY"sv)) return LogFormat::kNumpy;
  if (head.starts_with("PK\x03\x04"sv) || head.starts_with("PK\x05\x06"sv)) return LogFormat::kZip;
  if (head.starts_with("#ROSBAG V"sv)) return LogFormat::kRosbag1;
  if (head.starts_with("SQLite format 3\0"sv)) return LogFormat::kSqlite;
  if (head.starts_with("\x89MCAP0\r\n"sv)) return LogFormat::kMcap;
  if (head.starts_with("\x28\xB5\x2F\xFD"sv)) return LogFormat::kZstd;
  return looks_like_json(head) ? LogFormat::kJson : LogFormat::kText;
}

}  // namespace dyngen::runtime

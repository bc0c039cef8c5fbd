// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <utility>

#include "runtime/logs/bag_folder.h"
#include "runtime/logs/hdf5_log.h"
#include "runtime/logs/json_log.h"
#include "runtime/logs/log_bytes.h"
#include "runtime/logs/log_error.h"
#include "runtime/logs/log_format.h"
#include "runtime/logs/matlab_log.h"
#include "runtime/logs/mcap_source.h"
#include "runtime/logs/message_log.h"
#include "runtime/logs/numpy_log.h"
#include "runtime/logs/raw_log.h"
#include "runtime/logs/rosbag1_source.h"
#include "runtime/logs/sqlite_source.h"
#include "runtime/logs/text_log.h"
#include "runtime/recordings/byte_source.h"

namespace dyngen::runtime {
namespace {

using OpenBytes = std::function<ByteSource()>;

/// The first bytes, unpacked if they are gzip.
std::string head_of(ByteSource source) {
  std::string head(kFormatHead, '\0');
  std::size_t size = 0;
  while (size < head.size()) {
    const std::size_t got = source.read(head.data() + size, head.size() - size);
    if (got == 0) break;
    size += got;
  }
  head.resize(size);
  return head;
}

std::unique_ptr<RawLog> open_as(LogFormat format, const LogBytes& bytes, const OpenBytes& open,
                                const LogTextSettings& settings) {
  switch (format) {
    case LogFormat::kText:
      return open_text_log(open(), bytes.name, settings);
    case LogFormat::kJson:
      return open_json_log(open, bytes.name);
    case LogFormat::kMatlab:
      return open_matlab(bytes);
    case LogFormat::kHdf5:
      return open_hdf5(bytes);
    case LogFormat::kNumpy:
      return open_npy(bytes);
    case LogFormat::kZip:
      return open_npz(bytes);
    case LogFormat::kRosbag1:
      return open_message_log(open_rosbag1(bytes), bytes.name);
    case LogFormat::kSqlite:
      return open_message_log(open_rosbag2_database(bytes), bytes.name);
    case LogFormat::kMcap:
      return open_message_log(open_mcap(bytes), bytes.name);
    case LogFormat::kZstd:
      break;
  }
  throw log_error(bytes.name, "found a file packed with zstd; unpack it first: zstd -d FILE");
}

bool may_be_packed(LogFormat format) {
  return format == LogFormat::kText || format == LogFormat::kJson;
}

std::unique_ptr<RawLog> open_bytes(const LogBytes& bytes, bool packed, const OpenBytes& open,
                                   const LogTextSettings& settings) {
  const LogFormat format = format_of(head_of(open()));
  if (packed && !may_be_packed(format)) {
    throw log_error(bytes.name,
                    "found a binary log packed with gzip; unpack it first: gunzip FILE");
  }
  return open_as(format, bytes, open, settings);
}

bool is_gzip(std::string_view head) { return head.starts_with("\x1f\x8b"); }

}  // namespace

std::unique_ptr<RawLog> open_log(const std::string& path, const LogTextSettings& settings) {
  std::error_code error;
  try {
    if (std::filesystem::is_directory(path, error)) {
      return open_message_log(open_bag_folder(path), path);
    }
    const OpenBytes open = [path] { return ByteSource::from_file(path); };
    // a pipe is read once, so its first bytes cannot be looked at
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
      return open_text_log(open(), path, settings);
    }
    const LogBytes bytes{path, nullptr, path};
    std::string magic;
    BinaryReader reader(bytes);
    if (reader.size() >= 2) reader.read(magic, 2, "a log");
    return open_bytes(bytes, is_gzip(magic), open, settings);
  } catch (const LogError&) {
    throw;
  } catch (const std::runtime_error& failed) {
    throw log_error(path, failed.what());
  }
}

std::unique_ptr<RawLog> open_log_bytes(std::string bytes, const std::string& name,
                                       const LogTextSettings& settings) {
  const auto memory = std::make_shared<const std::string>(std::move(bytes));
  const OpenBytes open = [memory] { return ByteSource::from_text(*memory); };
  try {
    return open_bytes({{}, memory, name}, is_gzip(*memory), open, settings);
  } catch (const LogError&) {
    throw;
  } catch (const std::runtime_error& failed) {
    throw log_error(name, failed.what());
  }
}

}  // namespace dyngen::runtime

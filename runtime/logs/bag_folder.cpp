// SPDX-License-Identifier: MIT
#include "runtime/logs/bag_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>
#include <vector>

#include "runtime/logs/log_error.h"
#include "runtime/logs/mcap_source.h"
#include "runtime/logs/sqlite_source.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;

/// The list below "relative_file_paths:" of metadata.yaml, file names without folders.
std::vector<std::string> files_of_metadata(const fs::path& metadata) {
  std::ifstream file(metadata);
  std::vector<std::string> names;
  bool in_list = false;
  for (std::string line; std::getline(file, line);) {
    std::string_view text = trimmed(line);
    if (text.starts_with("relative_file_paths:")) {
      in_list = true;
    } else if (in_list && text.starts_with("- ")) {
      text = trimmed(text.substr(2));
      if (text.size() > 1 && (text.front() == '"' || text.front() == '\'')) {
        text = text.substr(1, text.size() - 2);
      }
      names.push_back(fs::path(text).filename().string());
    } else if (in_list) {
      break;
    }
  }
  return names;
}

/// Several files as one; topics of the same name and type are one.
class JoinedBags final : public MessageSource {
 public:
  JoinedBags(std::vector<std::string> paths, std::string folder)
      : paths_(std::move(paths)), folder_(std::move(folder)) {}

  [[nodiscard]] const std::vector<MessageTopic>& topics() const override { return topics_; }
  [[nodiscard]] double fraction_read() const override {
    const double part = source_ ? source_->fraction_read() : 0;
    return (static_cast<double>(file_) + part) / static_cast<double>(paths_.size());
  }

  void rewind() override {
    file_ = 0;
    number_ = 0;
    source_.reset();
  }

  bool next(LogMessage& message) override {
    while (file_ < paths_.size()) {
      if (!source_) {
        source_ = open_file(paths_[file_]);
        places_.clear();
      }
      if (source_->next(message)) {
        message.topic = place_of(message.topic);
        message.place = ++number_;
        return true;
      }
      source_.reset();
      ++file_;
    }
    return false;
  }

 private:
  static std::unique_ptr<MessageSource> open_file(const std::string& path) {
    const LogBytes bytes{path, nullptr, path};
    return path.ends_with(".mcap") ? open_mcap(bytes) : open_rosbag2_database(bytes);
  }

  std::size_t place_of(std::size_t topic) {
    const std::vector<MessageTopic>& own = source_->topics();
    for (std::size_t i = places_.size(); i < own.size(); ++i) {
      const auto same = [&](const MessageTopic& other) {
        return other.name == own[i].name && other.type == own[i].type;
      };
      const auto known = std::find_if(topics_.begin(), topics_.end(), same);
      places_.push_back(static_cast<std::size_t>(known - topics_.begin()));
      if (known == topics_.end()) topics_.push_back(own[i]);
    }
    return places_[topic];
  }

  std::vector<std::string> paths_;
  std::string folder_;
  std::vector<MessageTopic> topics_;
  std::unique_ptr<MessageSource> source_;
  std::vector<std::size_t> places_;  ///< of the topics of the open file in topics_
  std::size_t file_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace

std::unique_ptr<MessageSource> open_bag_folder(const std::string& path) {
  const fs::path folder(path);
  std::error_code error;
  std::vector<std::string> names = files_of_metadata(folder / "metadata.yaml");
  if (names.empty()) {
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".db3") || name.ends_with(".mcap")) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
  }
  if (names.empty()) {
    throw log_error(path,
                    "found a folder without .db3 and .mcap files, expected one of rosbag2, or "
                    "a file");
  }
  std::vector<std::string> paths;
  for (const std::string& name : names) {
    const std::string file = (folder / name).string();
    if (name.ends_with(".zstd")) {
      throw log_error(file, "found a packed bag; unpack it first: zstd -d " + name);
    }
    if (!fs::exists(file, error)) {
      throw log_error(file, "metadata.yaml names this file, and it is not there");
    }
    paths.push_back(file);
  }
  return std::make_unique<JoinedBags>(std::move(paths), path);
}

}  // namespace dyngen::runtime

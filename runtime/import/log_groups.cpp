// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runtime/import/imported_rows.h"
#include "runtime/import/spelling.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

/// '*' is any text, '?' one character.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = pattern.npos, from = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      from = n;
    } else if (star != pattern.npos) {
      p = star + 1;
      n = ++from;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

/// Files of a folder that a pattern matches, in the order of their names.
std::vector<std::string> files_of(const std::string& folder, const std::string& pattern) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string path = entry.path().string();
    if (!is_folder(path) && matches(pattern, file_name(path))) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Those of the command line that each pattern matches, a folder's files among them.
std::vector<std::vector<std::string>> sorted_by_pattern(const ImportMap& map,
                                                        const std::vector<std::string>& paths) {
  std::vector<std::vector<std::string>> found(map.files.size());
  for (const std::string& path : paths) {
    if (is_folder(path)) {
      for (std::size_t i = 0; i < map.files.size(); ++i) {
        const auto files = files_of(path, map.files[i].pattern);
        found[i].insert(found[i].end(), files.begin(), files.end());
      }
      continue;
    }
    std::vector<std::size_t> matching;
    for (std::size_t i = 0; i < map.files.size(); ++i) {
      if (matches(map.files[i].pattern, file_name(path))) matching.push_back(i);
    }
    if (matching.size() != 1) {
      std::vector<std::string> patterns;
      for (const FileMap& file : map.files) patterns.push_back(file.pattern);
      throw ImportError(
          map_error(map, map.files.front().place,
                    fmt::format("found file {}, which matches {} of 'files', expected one of {}",
                                runtime::quoted(std::string_view(path)),
                                matching.empty() ? "none" : "several", listed(patterns))));
    }
    found[matching.front()].push_back(path);
  }
  return found;
}

}  // namespace

std::vector<LogGroup> log_groups(const ImportMap& map, const std::vector<std::string>& paths) {
  std::vector<LogGroup> groups;
  if (map.files.empty()) {
    for (const std::string& path : paths) groups.push_back({{path}});
    return groups;
  }
  const std::vector<std::vector<std::string>> found = sorted_by_pattern(map, paths);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty() || found[i].size() != found.front().size()) {
      throw ImportError(map_error(
          map, map.files[i].place,
          fmt::format(
              "found {} file{} for {} ({}), expected {}", found[i].size(),
              found[i].size() == 1 ? "" : "s", runtime::quoted(std::string_view(map.files[i].key)),
              map.files[i].pattern,
              found.front().empty() || i == 0
                  ? "one for each recording"
                  : fmt::format("{} as for {}", found.front().size(),
                                runtime::quoted(std::string_view(map.files.front().key))))));
    }
  }
  for (std::size_t k = 0; k < found.front().size(); ++k) {
    LogGroup group;
    for (const auto& files : found) group.paths.push_back(files[k]);
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<OpenedLog> open_logs(const ImportMap& map, const LogGroup& group) {
  std::vector<OpenedLog> logs;
  for (std::size_t i = 0; i < group.paths.size(); ++i) {
    LogTextSettings settings = map.text;
    std::string key;
    if (i < map.files.size()) {
      const LogTextSettings& own = map.files[i].text;
      key = map.files[i].key;
      if (own.separator) settings.separator = own.separator;
      if (own.decimal) settings.decimal = own.decimal;
      if (own.skip_lines > 0) settings.skip_lines = own.skip_lines;
      if (own.columns) settings.columns = own.columns;
    }
    try {
      logs.push_back({group.paths[i], key, open_log(group.paths[i], settings)});
    } catch (const LogError& error) {
      throw RecordingError(error.what());
    }
  }
  return logs;
}

RecordingInput imported_recording(std::shared_ptr<const ImportMap> map, const LogGroup& group,
                                  const ImportedRobot& robot) {
  RecordingInput input;
  input.name = group.paths.front();
  input.reopens = true;
  for (const std::string& path : group.paths) {
    const RecordingInput file = recording_file(path);
    input.reopens = input.reopens && file.reopens;
    input.text_bytes += file.text_bytes;
  }
  input.open = [map, group, robot, name = input.name](const ReadOptions& options) {
    auto logs = std::make_shared<std::vector<OpenedLog>>(open_logs(*map, group));
    const std::string place_word = logs->front().log->place_word();
    return RecordingReader(
        [&](NoticeLog& log) { return imported_rows(*map, std::move(*logs), robot, log); }, name,
        place_word, options);
  };
  return input;
}

}  // namespace dyngen::runtime

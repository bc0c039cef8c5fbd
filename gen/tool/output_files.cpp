// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/output_files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace dyngen {
namespace {

namespace fs = std::filesystem;

/// Removes the temporary files that were not renamed.
class Temporaries {
 public:
  Temporaries() = default;
  Temporaries(const Temporaries&) = delete;
  Temporaries& operator=(const Temporaries&) = delete;
  ~Temporaries() {
    std::error_code ignored;
    for (const std::string& path : paths) fs::remove(path, ignored);
  }
  std::vector<std::string> paths;
};

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw OutputError(path + ": error: cannot write: " + reason);
}

std::string escape(const std::string& path) {
  std::string result;
  for (const char c : path) {
    if (c == ' ' || c == '#' || c == ':' || c == '\\') result += '\\';
    if (c == '$') result += '$';
    result += c;
  }
  return result;
}

}  // namespace

void write_files(const std::vector<OutputFile>& files) {
  Temporaries temporaries;
  for (const OutputFile& file : files) {
    std::error_code ignored;
    if (fs::is_directory(file.path, ignored)) fail(file.path, "it is a directory");
    const std::string temporary = file.path + ".tmp" + std::to_string(getpid());
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) fail(file.path, errno != 0 ? std::strerror(errno) : "cannot open it");
    temporaries.paths.push_back(temporary);
    stream << file.content;
    stream.close();
    if (!stream) fail(file.path, errno != 0 ? std::strerror(errno) : "the disk may be full");
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::error_code error;
    fs::rename(temporaries.paths[i], files[i].path, error);
    if (error) fail(files[i].path, error.message());
  }
  temporaries.paths.clear();
}

std::string depfile_text(const std::vector<std::string>& targets,
                         const std::vector<std::string>& dependencies) {
  const auto absolute = [](const std::string& path) {  // a ".." behind a link is not what it seems
    return fs::weakly_canonical(fs::absolute(path)).string();
  };
  std::string text;
  for (const std::string& target : targets) {
    text += (text.empty() ? "" : " ") + escape(absolute(target));
  }
  text += ":";
  for (const std::string& dependency : dependencies) text += " " + escape(absolute(dependency));
  return text + "\n";
}

}  // namespace dyngen

// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/output_files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

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
    // a pipe or a device is written to, and not replaced
    const bool device = fs::exists(file.path, ignored) && !fs::is_regular_file(file.path, ignored);
    const std::string temporary =
        device ? file.path : file.path + ".tmp" + std::to_string(getpid());
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) fail(file.path, errno != 0 ? std::strerror(errno) : "cannot open it");
    if (!device) temporaries.paths.push_back(temporary);
    stream << file.content;
    stream.close();
    if (!stream) fail(file.path, errno != 0 ? std::strerror(errno) : "the disk may be full");
  }
  for (const std::string& temporary : temporaries.paths) {
    const std::string path = temporary.substr(0, temporary.rfind(".tmp"));
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) fail(path, error.message());
  }
  temporaries.paths.clear();
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && fs::exists(b, ignored)) {
    return fs::is_regular_file(a, ignored) && fs::equivalent(a, b, ignored);
  }
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
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

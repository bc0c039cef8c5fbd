// SPDX-License-Identifier: MIT
#include "tests/support/shared_object.h"

#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace dyngen::test {
namespace {

std::string make_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "dyngen_test_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder");
  return pattern;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Runs a command; whatever it prints is an error.
void run(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run: " + command);
  std::string output;
  std::array<char, 512> buffer{};
  while (fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
  if (pclose(pipe) != 0 || !output.empty()) throw std::runtime_error(command + "\n" + output);
}

/// Before a compiler's name: the compiler cache, where there is one. Emitted code is the same in
/// every run. What is compiled for the processor at hand is not cached: another one may read it.
std::string launcher(const std::string& options) {
  static const bool present = std::system("command -v ccache >/dev/null 2>&1") == 0;
  const bool native = options.find("native") != std::string::npos;
  return present && !native ? "CCACHE_NOHASHDIR=1 ccache " : "";
}

}  // namespace

SharedObject::SharedObject(const std::map<std::string, std::string>& files,
                           const std::string& flags, const std::string& compiler)
    : folder_(make_folder()) {
  const std::string object = folder_ + "/model.so";
  const std::string options =
      " " + flags + " -fPIC -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion";
  for (const auto& [name, text] : files) write(folder_ + "/" + name, text);
  std::string parts;
  for (const auto& [name, text] : files) {
    if (!name.ends_with(".c") && !name.ends_with(".cpp")) continue;
    // from within the folder, whose name is another one each time
    run("cd " + folder_ + " && " + launcher(options) + compiler + options + " -c " + name + " -o " +
        name + ".o");
    parts += " " + folder_ + "/" + name + ".o";
  }
  // objects are no sources of the language that a compiler may have been told
  run(compiler + options + " -shared -x none" + parts + " -o " + object + " -lm");
  library_ = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw std::runtime_error(dlerror());
}

SharedObject::~SharedObject() {
  if (library_ != nullptr) dlclose(library_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void* SharedObject::symbol(const std::string& name) const {
  void* found = dlsym(library_, name.c_str());
  if (found == nullptr) throw std::runtime_error("no symbol " + name);
  return found;
}

}  // namespace dyngen::test

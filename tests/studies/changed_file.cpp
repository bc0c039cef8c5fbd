// SPDX-License-Identifier: MIT
#include "tests/studies/changed_file.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dyngen::test {

std::string file_without(const std::string& path_in_project,
                         const std::vector<std::string>& keywords) {
  const std::filesystem::path path = std::filesystem::path(DYNGEN_SOURCE_DIR) / path_in_project;
  std::ifstream input(path);
  if (!input) throw std::invalid_argument("file_without(): cannot read " + path.string());
  const std::filesystem::path changed = std::filesystem::temp_directory_path() /
                                        (std::to_string(getpid()) + "_" + path.filename().string());
  std::ofstream output(changed);
  for (std::string line; std::getline(input, line);) {
    std::string word;
    std::istringstream(line) >> word;
    if (std::find(keywords.begin(), keywords.end(), word) == keywords.end()) output << line << "\n";
  }
  return changed.string();
}

}  // namespace dyngen::test

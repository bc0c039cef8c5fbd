// SPDX-License-Identifier: MIT
#include "tests/studies/changed_file.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dyngen::test {

namespace fs = std::filesystem;

ChangedFile::ChangedFile(const std::string& path_in_project,
                         const std::vector<std::string>& left_out) {
  const fs::path original = fs::path(DYNGEN_SOURCE_DIR) / path_in_project;
  std::ifstream input(original);
  if (!input) throw std::invalid_argument("ChangedFile: cannot read " + original.string());
  const std::string name = std::to_string(getpid()) + "_" + original.filename().string();
  path_ = (fs::temp_directory_path() / name).string();
  std::ofstream output(path_);
  for (std::string line; std::getline(input, line);) {
    std::string word;
    std::istringstream(line) >> word;
    if (std::find(left_out.begin(), left_out.end(), word) == left_out.end()) output << line << "\n";
  }
}

ChangedFile::~ChangedFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace dyngen::test

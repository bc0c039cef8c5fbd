// SPDX-License-Identifier: MIT
#include "tests/support/golden.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace dyngen::test {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The lines around which the texts differ: '-' expected, '+' found.
std::string difference(const std::string& expected, const std::string& found) {
  const std::vector<std::string> a = split_lines(expected);
  const std::vector<std::string> b = split_lines(found);
  std::size_t head = 0;
  while (head < a.size() && head < b.size() && a[head] == b[head]) ++head;
  std::size_t tail = 0;
  while (tail < a.size() - head && tail < b.size() - head &&
         a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) {
    ++tail;
  }
  std::string out = "@@ line " + std::to_string(head + 1) + " @@\n";
  for (std::size_t i = head; i < a.size() - tail; ++i) out += "-" + a[i] + "\n";
  for (std::size_t i = head; i < b.size() - tail; ++i) out += "+" + b[i] + "\n";
  return out;
}

}  // namespace

void expect_golden(const std::string& path, const std::string& text) {
  const fs::path file = fs::path(DYNGEN_SOURCE_DIR) / "tests/golden" / path;
  const char* update = std::getenv("DYNGEN_UPDATE_GOLDEN");
  if (update != nullptr && *update != '\0') {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return;
  }
  const std::string expected = read_text(file);
  EXPECT_TRUE(text == expected) << "tests/golden/" << path << "\n"
                                << difference(expected, text)
                                << "To accept: DYNGEN_UPDATE_GOLDEN=1 ctest -R golden";
}

}  // namespace dyngen::test

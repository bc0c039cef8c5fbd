// SPDX-License-Identifier: MIT
// Each file in tests/golden/messages holds mistakes; the .expected beside it holds the messages,
// word for word.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "gen/effect_code/bound_effect.h"
#include "gen/robot_file/robot_file.h"
#include "tests/support/golden.h"

namespace dyngen {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(DYNGEN_SOURCE_DIR) / "tests/golden/messages";

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// What dyngen says about a file: the errors, else the warnings.
std::string messages_of(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::string text = read_text(path);
  try {
    const RobotFile file =
        parse_robot_file(text, name, [](const RobotFile& rows, Diagnostics& diagnostics) {
          if (!rows.effects.empty()) check_effect_rows(rows, EffectCatalogue(), diagnostics);
        });
    Diagnostics warnings(name, text);
    for (const Diagnostic& d : file.warnings) {
      warnings.warning(d.position, d.length, d.message, d.hint);
    }
    return warnings.render();
  } catch (const ModelError& error) {
    return error.what();
  }
}

std::vector<std::string> file_stems() {
  std::vector<std::string> stems;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".robot") stems.push_back(entry.path().stem().string());
  }
  std::sort(stems.begin(), stems.end());
  return stems;
}

class Messages : public testing::TestWithParam<std::string> {};

TEST_P(Messages, AreAsExpected) {
  const std::string found = messages_of(kFolder / (GetParam() + ".robot"));
  EXPECT_FALSE(found.empty()) << "the file is meant to hold a mistake";
  test::expect_golden("messages/" + GetParam() + ".expected", found);
}

std::string test_name(const testing::TestParamInfo<std::string>& info) { return "_" + info.param; }

INSTANTIATE_TEST_SUITE_P(golden, Messages, testing::ValuesIn(file_stems()), test_name);

}  // namespace
}  // namespace dyngen

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "gen/drawing/arm_drawing.h"
#include "gen/explain/explain.h"
#include "tests/support/golden.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

class ExplainText : public testing::TestWithParam<const char*> {};

TEST_P(ExplainText, IsAsCommitted) {
  const std::string name = GetParam();
  const std::string file = name.substr(name.rfind('/') + 1);
  const std::string text = explain(read_model(name + ".robot"));
  expect_golden("explained/" + file + ".txt", text);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(ArmDrawing, IsAsCommitted) {
  expect_golden("drawn/rp.svg", arm_drawing(read_model("tests/robots/rp.robot")));
}

INSTANTIATE_TEST_SUITE_P(golden, ExplainText,
                         testing::Values("robots/planar2r", "robots/puma560", "robots/sarcos_grla",
                                         "robots/scara", "tests/robots/rp"),
                         [](const auto& entry) {
                           const std::string name = entry.param;
                           return name.substr(name.rfind('/') + 1);
                         });

}  // namespace
}  // namespace dyngen::test

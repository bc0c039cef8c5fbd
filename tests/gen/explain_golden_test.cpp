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

TEST(ExplainedParameters, AreSaidToBeBaseParameters) {
  const std::string file = "number_link 1\nal pi/2\nmX 1\nZZ 1\ngz 9.81\n";
  EXPECT_EQ(explain(parse_model(file + "stop\n")).find("are base parameters"), std::string::npos);
  EXPECT_NE(explain(parse_model(file + "parameters base\nstop\n"))
                .find("The numbers of the file are base parameters"),
            std::string::npos);
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

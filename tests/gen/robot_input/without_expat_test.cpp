// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "gen/robot_input/robot_input.h"

namespace dyngen {
namespace {

TEST(RobotInput, SaysWhichPackageReadsXml) {
  try {
    parse_robot("<robot name=\"r\"><link name=\"a\"/></robot>", "r.urdf");
    FAIL() << "read";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("libexpat1-dev"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dyngen

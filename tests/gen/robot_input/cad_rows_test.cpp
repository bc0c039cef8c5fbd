// SPDX-License-Identifier: MIT
#include "gen/robot_file/cad_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gen/robot_file/robot_file.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::numeric;

RobotFile read_rows_of(const std::string& rows) {
  return parse_robot_file("number_link 2\nal 0 pi/2\n" + rows + "gz 9.81\nstop\n", "cad.robot");
}

std::string cad_error(const std::string& rows) {
  try {
    read_rows_of(rows);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

const FieldValue& value(const RobotFile& file, RowKey key, std::size_t link) {
  return file.row(key).values.at(link);
}

TEST(CadRows, BecomeMomentsAboutTheOriginExactly) {
  const RobotFile file = read_rows_of(
      "m 2 3\ncX 0.1 0\ncY 0 -0.2\ncZ 0.3 0\nIXX 0.01 0.02\nIXY 0.001 0\nIYY 0.02 0.03\n"
      "IZZ 0.015 0.04\n");
  EXPECT_TRUE(value(file, RowKey::kMX, 0).value.is_equal(numeric(1, 5)));
  EXPECT_TRUE(value(file, RowKey::kMY, 1).value.is_equal(numeric(-3, 5)));
  // 0.01 + 2 (0.3^2), 0.001, -2 0.1 0.3
  EXPECT_TRUE(value(file, RowKey::kXX, 0).value.is_equal(numeric(19, 100)));
  EXPECT_TRUE(value(file, RowKey::kXY, 0).value.is_equal(numeric(1, 1000)));
  EXPECT_TRUE(value(file, RowKey::kXZ, 0).value.is_equal(numeric(-6, 100)));
  EXPECT_TRUE(value(file, RowKey::kYY, 0).value.is_equal(numeric(22, 100)));
  EXPECT_TRUE(value(file, RowKey::kXX, 1).value.is_equal(numeric(14, 100)));
  EXPECT_TRUE(value(file, RowKey::kYZ, 1).value.is_zero());
  EXPECT_FALSE(file.row(RowKey::kCX).present);
  EXPECT_EQ(value(file, RowKey::kMX, 0).position.line, 4);
}

TEST(CadRows, MayBeMixedWithTheOthersLinkByLink) {
  const RobotFile file = read_rows_of(
      "m 2 3\ncX 0.1 -\ncY 0 -\ncZ 0 -\nmX - 0.6\nmY - 0\nmZ - 0\n"
      "IXX 0.01 -\nIYY 0.01 -\nIZZ 0.01 -\nXX - 0.5\nYY - 0.6\nZZ - 0.4\n");
  EXPECT_TRUE(value(file, RowKey::kMX, 0).value.is_equal(numeric(1, 5)));
  EXPECT_TRUE(value(file, RowKey::kMX, 1).value.is_equal(numeric(3, 5)));
  EXPECT_TRUE(value(file, RowKey::kZZ, 0).value.is_equal(numeric(3, 100)));
  EXPECT_TRUE(value(file, RowKey::kZZ, 1).value.is_equal(numeric(2, 5)));
}

TEST(CadRows, AxesOfAnotherFrameAreTurned) {
  const RobotFile file = read_rows_of(
      "m 1 1\ncX 0 0\ncY 0 0\ncZ 0 0\nIXX 1 3\nIYY 2 3\nIZZ 3 3\nirZ pi/2 0.3\nirX 0 0.2\n");
  EXPECT_TRUE(value(file, RowKey::kXX, 0).value.is_equal(2));
  EXPECT_TRUE(value(file, RowKey::kYY, 0).value.is_equal(1));
  EXPECT_TRUE(value(file, RowKey::kXY, 0).value.is_zero());
  EXPECT_NEAR(to_double(value(file, RowKey::kXX, 1).value), 3, 1e-15);
  EXPECT_TRUE(value(file, RowKey::kXZ, 1).value.is_zero());  // a ball, whatever its axes
  // Rz(0.3) diag(1, 2, 3) Rz(0.3)^T
  const RobotFile one = read_rows_of(
      "m 1 1\ncX 0 0\ncY 0 0\ncZ 0 0\nIXX 1 1\nIYY 2 2\nIZZ 3 3\nirZ 0.3 0\nirY 0 0.4\n");
  const double c = std::cos(0.3), s = std::sin(0.3);
  EXPECT_NEAR(to_double(value(one, RowKey::kXX, 0).value), c * c + 2 * s * s, 1e-15);
  EXPECT_NEAR(to_double(value(one, RowKey::kXY, 0).value), -c * s, 1e-15);
  EXPECT_NEAR(to_double(value(one, RowKey::kXZ, 1).value), 2 * std::cos(0.4) * std::sin(0.4),
              1e-15);
}

TEST(CadRows, UnknownNumbersStayUnknownWhereTheyMatter) {
  const RobotFile file =
      read_rows_of("m * 2\ncX 0 *\ncY 0.1 0\ncZ 0 0\nIXX 1 1\nIYY 1 1\nIZZ 1 *\n");
  EXPECT_FALSE(value(file, RowKey::kMX, 0).unknown);
  EXPECT_TRUE(value(file, RowKey::kMY, 0).unknown);
  EXPECT_TRUE(value(file, RowKey::kXX, 0).unknown);
  EXPECT_FALSE(value(file, RowKey::kYY, 0).unknown);
  EXPECT_TRUE(value(file, RowKey::kMX, 1).unknown);
  EXPECT_FALSE(value(file, RowKey::kXX, 1).unknown);
  EXPECT_TRUE(value(file, RowKey::kYY, 1).unknown);
  EXPECT_TRUE(value(file, RowKey::kZZ, 1).unknown);
}

TEST(CadRows, MistakesAreReportedWithTheirPlace) {
  EXPECT_NE(cad_error("m 1 1\ncX 0 0\nmX 0 0\n").find("cad.robot:4:4: error: link 1 has cX"),
            std::string::npos)
      << cad_error("m 1 1\ncX 0 0\nmX 0 0\n");
  EXPECT_NE(cad_error("m 1 1\ncX 0 0\nIXX 1 1\nXX - 1\n").find("link 2 has IXX"),
            std::string::npos);
  EXPECT_NE(cad_error("m 1 1\nmX 0 -\n").find("link 2 has '-' and no number"), std::string::npos);
  EXPECT_NE(cad_error("cX 0 0.1\n").find("needs a mass"), std::string::npos);
  EXPECT_NE(cad_error("m 1 1\nIXX 1 1\n").find("centre of mass, which is not given"),
            std::string::npos);
  EXPECT_NE(cad_error("m 1 1\nXX 1 1\nirX 0.1 0\n").find("irX .. and no IXX"), std::string::npos);
  EXPECT_NE(cad_error("parameters base\nm 1 1\ncX 0 0\n").find("sums over bodies"),
            std::string::npos);
  EXPECT_NE(cad_error("m - 1\n"), "");
  EXPECT_NE(cad_error("m 1 1\nirX * 0\n"), "");
}

TEST(LimitRows, OneJointMayHaveNone) {
  const RobotFile file = read_rows_of("m 1 1\nqmin - -1\nqmax - 1\nvmax 2 -\n");
  EXPECT_TRUE(value(file, RowKey::kQmin, 0).unknown);
  EXPECT_FALSE(value(file, RowKey::kQmin, 1).unknown);
  EXPECT_TRUE(value(file, RowKey::kVmax, 1).unknown);
  EXPECT_NE(cad_error("m 1 1\nqmin * 0\n").find("write - for a joint without a limit"),
            std::string::npos);
  EXPECT_NE(cad_error("m 1 1\nal2 - 0\n"), "");
}

}  // namespace
}  // namespace dyngen

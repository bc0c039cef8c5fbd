// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/robot_text.h"

#include <gtest/gtest.h>

namespace dyngen::runtime {
namespace {

RobotFile read_text(const std::string& text) { return parse_robot_file(text, "arm.robot"); }

RobotTextChange without_masses(std::vector<std::string> added) {
  RobotTextChange change;
  change.removed = [](const RowText& row) {
    return row.statement == Statement::kValues && (row.key == RowKey::kM || row.key == RowKey::kMX);
  };
  change.added = std::move(added);
  return change;
}

TEST(RobotText, TakesRowsOutOfSharedLinesAndOutOfSeveral) {
  const RobotFile file = read_text(
      "number_link 2 d 0 0.4 m 1 2, mX 3 # both\n   4\n# mine\nal 0 0  # twist\ngz 9.81 stop\n");
  EXPECT_EQ(changed_text(file, without_masses({"m 5 6"})),
            "number_link 2 d 0 0.4  \nm 5 6\n# mine\nal 0 0  # twist\ngz 9.81 stop\n");
}

TEST(RobotText, AddsBeforeStopWhereNothingWasTakenOut) {
  EXPECT_EQ(changed_text(read_text("number_link 1\r\ngz 9.81 stop # end"), without_masses({"m 5"})),
            "number_link 1\ngz 9.81 \nm 5\nstop # end\n");
  EXPECT_EQ(changed_text(read_text("number_link 1\ngz 9.81"), without_masses({"m 5"})),
            "number_link 1\ngz 9.81\nm 5\n");
}

TEST(RobotText, TakesOutLetRowsThatNothingUsesAnyMore) {
  const RobotFile file = read_text(
      "number_link 1\nlet a 2\nlet b a*2  # kg\nlet c 1\nr c\nm b mX a\n\ngz 9.81\nstop\n");
  const std::string text = changed_text(file, without_masses({"m 7"}));
  EXPECT_EQ(text, "number_link 1\nlet c 1\nr c\nm 7\n\ngz 9.81\nstop\n");
  EXPECT_NO_THROW(read_text(text));
}

TEST(RobotText, WritesEffectsAnewWhereTheyStand) {
  const RobotFile file = read_text(
      "number_link 1\nlet v 0.1\ngz 9.81 effect stribeck joint=1 vs=v  # seen\n"
      "effect dahl joint=1\nstop\n");
  RobotTextChange change;
  change.effects = {"effect stribeck joint=1 vs=0.2", "effect dahl joint=1 sigma=3"};
  EXPECT_EQ(changed_text(file, change),
            "number_link 1\ngz 9.81 effect stribeck joint=1 vs=0.2  # seen\n"
            "effect dahl joint=1 sigma=3\nstop\n");
}

}  // namespace
}  // namespace dyngen::runtime

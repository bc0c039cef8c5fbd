// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/robot_options.h"

#include <CLI/CLI.hpp>

namespace dyngen {

CLI::Option* add_robot(CLI::App& command, RobotSource& robot, const std::string& words) {
  CLI::Option* file =
      command.add_option("robot", robot.path, words + ": .robot, URDF, MJCF or SYMORO's .par")
          ->required()
          ->type_name("FILE");
  add_robot_part(command, robot);
  return file;
}

void add_robot_part(CLI::App& command, RobotSource& robot) {
  command
      .add_option("--base", robot.base,
                  "of URDF and MJCF: the link that stands still (default: the root)")
      ->type_name("LINK");
  command
      .add_option(
          "--tip", robot.tip,
          "of URDF and MJCF: the chain from the base to this link alone, whose frame is the "
          "last (default: everything that hangs on the base)")
      ->type_name("LINK");
  command
      .add_option("--round-angles", robot.round_angles,
                  "rad, of URDF and MJCF: angles so near a multiple of pi/12 are that multiple "
                  "(1e-4 makes 1.5708 a right angle)")
      ->check(CLI::Range(0.0, 0.01))
      ->type_name("TOL");
}

}  // namespace dyngen

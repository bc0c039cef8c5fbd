// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_code/checked_robot.h"

#include "gen/robot_input/robot_input.h"

namespace dyngen {

CheckedRobot read_checked_robot(const RobotSource& source,
                                const std::vector<std::string>& folders) {
  CheckedRobot robot;
  robot.file = read_robot_file(source, [&](const RobotFile& file, Diagnostics& diagnostics) {
    if (file.effects.empty() && folders.empty()) return;
    auto catalogue = std::make_shared<EffectCatalogue>();
    for (const std::string& folder : folders) catalogue->add_folder(folder);
    check_effect_rows(file, *catalogue, diagnostics);
    robot.catalogue = std::move(catalogue);
  });
  return robot;
}

void add_robot_warnings(const CheckedRobot& robot, const RobotModel& model, AbsentRows absent,
                        Diagnostics& diagnostics) {
  for (const Diagnostic& warning : robot.file.warnings) {
    diagnostics.warning(warning.position, warning.length, warning.message, warning.hint);
  }
  if (absent == AbsentRows::kZero && robot.file.made_of.empty()) {
    check_masses(robot.file, absent, diagnostics);
  }
  if (robot.catalogue) {
    check_requirements(bind_effects(model, *robot.catalogue), model, diagnostics);
  }
}

}  // namespace dyngen

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/joint_words.h"

#include <fmt/format.h>

namespace dyngen::runtime {
namespace {

bool has_name(const RobotModel& model, int row) {
  return model.joint(row).name != fmt::format("joint{}", row);
}

}  // namespace

std::string joint_words(const RobotModel& model, int row) {
  return has_name(model, row) ? fmt::format("joint {} ({})", row, model.joint(row).name)
                              : fmt::format("joint {}", row);
}

std::string coordinate_words(const RobotModel& model, int coordinate) {
  for (int row = 1; row <= model.size(); ++row) {
    if (model.joint(row).coordinate == coordinate && has_name(model, row)) {
      return model.joint(row).name;
    }
  }
  return fmt::format("joint {}", coordinate + 1);
}

std::string joint_legend(const RobotModel& model) {
  std::string legend;
  for (int row = 1; row <= model.size(); ++row) {
    const int coordinate = model.joint(row).coordinate;
    if (coordinate < 0 || !has_name(model, row)) continue;
    legend += fmt::format("{}{} {}", legend.empty() ? "joints: " : ", ", coordinate + 1,
                          model.joint(row).name);
  }
  return legend;
}

}  // namespace dyngen::runtime

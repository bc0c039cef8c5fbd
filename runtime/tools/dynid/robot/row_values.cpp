// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/row_values.h"

#include <limits>

#include "gen/symbols/exact.h"

namespace dyngen::runtime {

Eigen::VectorXd row_values(const DescribedRobot& robot, RowKey key) {
  Eigen::VectorXd values =
      Eigen::VectorXd::Constant(robot.linear.joints(), std::numeric_limits<double>::infinity());
  const Row& row = robot.file.row(key);
  if (!row.present) return values;
  for (std::size_t j = 0; j < row.values.size(); ++j) {
    const int coordinate = robot.model.joints[j].coordinate;
    if (coordinate >= 0 && !row.values[j].unknown) {
      values[coordinate] = to_double(row.values[j].value);
    }
  }
  return values;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/file_values.h"

#include <fmt/format.h>

#include <cmath>

#include "gen/diagnostic/diagnostic.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd file_values(const DescribedRobot& robot, const RobotSource& source,
                     const std::string& why) {
  const StandardParameters written = describe_robot(source, OpenParameters::kAsWritten).standard;
  VectorXd beta = VectorXd::Zero(robot.grouping.rows());
  std::string unknown;
  for (Index i = 0; i < beta.size(); ++i) {
    for (Index c = 0; c < written.size(); ++c) {
      if (robot.grouping(i, c) != 0) beta[i] += robot.grouping(i, c) * written[c];
    }
    if (std::isfinite(beta[i])) continue;
    unknown +=
        (unknown.empty() ? "" : " ") + robot.linear.parameters[static_cast<std::size_t>(i)].name;
  }
  if (unknown.empty()) return beta;
  throw ModelError(
      fmt::format("{}: error: parameters are unknown ('*'): {}; expected numbers, {}\n",
                  source.path, unknown, why));
}

}  // namespace dyngen::runtime

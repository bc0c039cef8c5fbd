// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/identified_robot.h"

#include <fstream>
#include <random>

#include "gen/robot_input/robot_input.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/robot/description_bodies.h"
#include "runtime/tools/dynid/robot/identified_file.h"

namespace dyngen::test {

/// The same arm with other masses, centres, moments and friction.
std::vector<MadeLink> with_other_bodies(std::vector<MadeLink> links, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> factor(0.8, 1.25), shift(-0.01, 0.01);
  for (MadeLink& link : links) {
    const double mass = factor(random);
    link.mass *= mass;
    link.inertia *= mass * factor(random);
    for (double& value : link.centre) value += link.mass > 0 ? shift(random) : 0;
    link.damping *= factor(random);
    link.friction *= factor(random);
  }
  return links;
}

/// What dynid writes of the arm if its base parameters are found exactly.
std::string identified_base_parameters(const std::vector<MadeLink>& links) {
  const runtime::DescribedRobot robot = runtime::describe_robot(
      parse_robot(urdf_of(links), "truth.urdf"), runtime::OpenParameters::kEverything);
  const Eigen::VectorXd beta = robot.grouping * runtime::numbers_of(build_model(robot.file));
  return runtime::identified_text(robot, runtime::carried(robot, beta), {{"fitted"}, {}, {}});
}

std::string written(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

runtime::IdentifiedDescription into(const std::string& path, const std::string& identified) {
  runtime::WriteBackTask task;
  task.description = RobotSource(path);
  task.comment = {"fitted -- by a test"};
  return runtime::identified_description(identified, "truth.robot", task,
                                         runtime::effect_catalogue({}));
}

}  // namespace dyngen::test

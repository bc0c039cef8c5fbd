// SPDX-License-Identifier: MIT
#include "tests/bench/speed_robots.h"

#include "bench_panda_emitted.h"
#include "bench_puma560_emitted.h"
#include "bench_ur10e_emitted.h"
#include "tests/support/model_bridge.h"
#include "tests/support/physical_robot.h"

namespace dyngen::bench {
namespace {

/// The robot with links that could be built: some libraries refuse others.
test::NumericRobot with_physical_links(const RobotModel& model) {
  test::NumericRobot robot = test::numeric_robot(test::with_random_values(model, 1));
  const test::NumericRobot links = test::physical_robot(4, static_cast<int>(robot.size()));
  for (std::size_t j = 0; j < robot.size(); ++j) {
    robot.joints[j].inertial = links.joints[j].inertial;
  }
  return robot;
}

SpeedRobot make_robot(const std::string& name, const std::string& oracle, const Emitted& plain,
                      const Emitted& native) {
  const RobotModel model = test::read_model("tests/bench/robots/" + name + "_unknown.robot");
  SpeedRobot robot;
  robot.name = name;
  robot.numbers = with_physical_links(model);
  GeneratorOptions options;
  options.parameters = ParameterMode::kRuntime;
  options.functions = {"id"};
  const test::EvaluatedModel evaluated(model, test::robot_model(robot.numbers), options);
  robot.chi = evaluated.chi();
  robot.id = lower(evaluated.functions().front().trace);
  robot.stored = test::load_oracle(oracle).states;
  robot.plain = plain;
  robot.native = native;
  return robot;
}

}  // namespace

std::vector<SpeedRobot> speed_robots() {
  return {make_robot("puma560", "puma560_akb_mdh", bench_puma560_plain(), bench_puma560_native()),
          make_robot("ur10e", "ur10e", bench_ur10e_plain(), bench_ur10e_native()),
          make_robot("panda", "panda7", bench_panda_plain(), bench_panda_native())};
}

}  // namespace dyngen::bench

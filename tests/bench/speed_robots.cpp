// SPDX-License-Identifier: MIT
#include "tests/bench/speed_robots.h"

#include <numbers>
#include <random>

#include "bench_panda_native.h"
#include "bench_panda_plain.h"
#include "bench_puma560_native.h"
#include "bench_puma560_plain.h"
#include "bench_ur10e_native.h"
#include "bench_ur10e_plain.h"
#include "gen/generator/generator.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen::bench {
namespace {

Program id_program(const std::string& file) {
  const RobotModel model = build_model(read_robot_file(DYNGEN_SOURCE_DIR "/" + file));
  GeneratorOptions options;
  options.functions = {"id"};
  CodeModel code = make_code_model(model, options);
  return lower(write_functions(code, options).front().trace);
}

}  // namespace

States random_states(std::size_t joints) {
  std::mt19937_64 random(20240607);
  const auto draw = [&](double limit) {
    std::uniform_real_distribution<double> uniform(-limit, limit);
    std::vector<double> values(kStates * joints);
    for (double& value : values) value = uniform(random);
    return values;
  };
  States states;
  states.joints = joints;
  states.q = draw(std::numbers::pi);
  states.dq = draw(3.0);
  states.ddq = draw(10.0);
  return states;
}

std::vector<SpeedRobot> speed_robots() {
  std::vector<SpeedRobot> robots;
  robots.push_back({"puma560",
                    test::load_oracle("puma560_akb_mdh"),
                    {bench_puma560_plain_id, bench_puma560_plain_gravity},
                    {bench_puma560_native_id, bench_puma560_native_gravity},
                    id_program("robots/puma560.robot")});
  robots.push_back({"ur10e",
                    test::load_oracle("ur10e"),
                    {bench_ur10e_plain_id, bench_ur10e_plain_gravity},
                    {bench_ur10e_native_id, bench_ur10e_native_gravity},
                    id_program("tests/robots/ur10e_oracle.robot")});
  robots.push_back({"panda",
                    test::load_oracle("panda7"),
                    {bench_panda_plain_id, bench_panda_plain_gravity},
                    {bench_panda_native_id, bench_panda_native_gravity},
                    id_program("tests/robots/panda7_oracle.robot")});
  return robots;
}

}  // namespace dyngen::bench

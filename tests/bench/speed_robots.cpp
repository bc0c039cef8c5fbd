// SPDX-License-Identifier: MIT
#include "tests/bench/speed_robots.h"

#include <utility>

#include "gen/generator/generator.h"
#include "tests/support/model_bridge.h"

namespace dyngen::bench {

// emitted.cpp.in
Emitted emitted_bench_puma560_plain();
Emitted emitted_bench_puma560_native();
Emitted emitted_bench_ur10e_plain();
Emitted emitted_bench_ur10e_native();
Emitted emitted_bench_panda_plain();
Emitted emitted_bench_panda_native();
Emitted emitted_bench_puma560_rigid_plain();
Emitted emitted_bench_puma560_rigid_native();
Emitted emitted_bench_panda_rigid_plain();
Emitted emitted_bench_panda_rigid_native();

namespace {

SpeedRobot robot(const std::string& name, const std::string& file, ParameterMode parameters,
                 const Emitted& plain, const Emitted& native) {
  const RobotModel model = test::read_model(file);
  GeneratorOptions options;
  options.functions = {"id"};
  options.parameters = parameters;
  CodeModel code = make_code_model(model, options);
  Program id = lower(write_functions(code, options).front().trace);
  return {name, model, test::numeric_robot(model), plain, native, std::move(id)};
}

}  // namespace

std::vector<SpeedRobot> robots_of_files() {
  constexpr ParameterMode kBaked = ParameterMode::kBaked;
  return {robot("puma560", "robots/puma560.robot", kBaked, emitted_bench_puma560_plain(),
                emitted_bench_puma560_native()),
          robot("ur10e", "tests/robots/ur10e_oracle.robot", kBaked, emitted_bench_ur10e_plain(),
                emitted_bench_ur10e_native()),
          robot("panda", "tests/robots/panda7_oracle.robot", kBaked, emitted_bench_panda_plain(),
                emitted_bench_panda_native())};
}

std::vector<SpeedRobot> robots_at_run_time() {
  constexpr ParameterMode kRuntime = ParameterMode::kRuntime;
  return {robot("puma560_rigid", "tests/bench/robots/puma560_rigid.robot", kRuntime,
                emitted_bench_puma560_rigid_plain(), emitted_bench_puma560_rigid_native()),
          robot("panda_rigid", "tests/bench/robots/panda_rigid.robot", kRuntime,
                emitted_bench_panda_rigid_plain(), emitted_bench_panda_rigid_native())};
}

}  // namespace dyngen::bench

// SPDX-License-Identifier: MIT
// blind_baselines: what simpler methods say of a case; reads what dynid reads, and nothing else.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "runtime/diagnosis/views/views.h"
#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "tests/baselines/baselines.h"

namespace dyngen::test {
namespace {

using Paths = std::vector<std::string>;

std::vector<runtime::MotionSource> read(const Paths& paths) {
  runtime::MotionOptions options;
  options.stream_above = std::numeric_limits<std::size_t>::max();
  options.average_periods = false;
  std::vector<runtime::MotionSource> sources;
  for (const std::string& path : paths) sources.push_back(runtime::motion_of_file(path, options));
  return sources;
}

std::vector<BaselineResult> results(const std::string& robot_path, const Paths& train,
                                    const Paths& heldout) {
  const EffectCatalogue catalogue = runtime::effect_catalogue({});
  const runtime::DescribedRobot robot =
      runtime::describe_robot(robot_path, runtime::OpenParameters::kAbsentRows);
  runtime::DiagnosisInput input;
  input.model = robot.linear;
  input.robot = runtime::effect_robot(robot);
  input.train = read(train);
  input.heldout = read(heldout);
  std::vector<runtime::MotionSource> all = input.train;
  all.insert(all.end(), input.heldout.begin(), input.heldout.end());
  const runtime::ViewOptions view{runtime::diagnosis_rows(input.train, 0), {}};
  return baseline_results(runtime::equations_of(input, input.train, view),
                          runtime::equations_of(input, input.heldout, view),
                          runtime::competing_effects(robot, catalogue, all));
}

std::string json_of(const std::vector<BaselineResult>& all) {
  nlohmann::json baselines = nlohmann::json::array();
  for (const BaselineResult& one : all) {
    nlohmann::json names = nlohmann::json::array();
    for (const auto& name : one.names) {
      names.push_back({{"family", name.family}, {"joint", name.joint}});
    }
    const std::vector<double> rms(one.heldout_rms.begin(), one.heldout_rms.end());
    baselines.push_back({{"baseline", one.baseline}, {"names", names}, {"heldout_rms", rms}});
  }
  return nlohmann::json{{"schema", "blind.baselines/1"}, {"baselines", baselines}}.dump(1) + "\n";
}

void write(const std::string& path, const std::string& text) {
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  std::filesystem::rename(unfinished, path);
}

}  // namespace
}  // namespace dyngen::test

int main(int argc, char** argv) {
  CLI::App app{"Says what simpler methods than a diagnosis find in recordings, and leave of them."};
  std::string robot, json;
  std::vector<std::string> train, heldout;
  app.add_option("robot", robot, "robot file")->required();
  app.add_option("recordings", train, "two or more that are fitted")->required();
  app.add_option("--holdout", heldout, "one that is not; may be given again")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--json", json, "the answer")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    dyngen::test::write(json, dyngen::test::json_of(dyngen::test::results(robot, train, heldout)));
  } catch (const std::exception& error) {
    fmt::print(stderr, "blind_baselines: {}\n", error.what());
    return 1;
  }
  return 0;
}

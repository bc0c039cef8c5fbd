// SPDX-License-Identifier: MIT
// blind_baselines: what simpler methods say of a case; reads what dynid reads, and nothing else.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "gen/tool/output_files.h"
#include "runtime/diagnosis/equation_sets/equation_sets.h"
#include "tests/baselines/baselines.h"
#include "tests/blind/dynid/case_input.h"

namespace dyngen::test {
namespace {

std::vector<BaselineResult> results(const runtime::DiagnosisInput& input) {
  const runtime::EquationSetOptions view{runtime::diagnosis_rows(input.train, 0), {}};
  return baseline_results(runtime::equations_of(input, input.train, view),
                          runtime::equations_of(input, input.heldout, view), input.hypotheses);
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
    const auto input = blind::case_input(robot, train, heldout);
    dyngen::write_files({{json, dyngen::test::json_of(dyngen::test::results(input))}});
  } catch (const std::exception& error) {
    fmt::print(stderr, "blind_baselines: {}\n", error.what());
    return 1;
  }
  return 0;
}

// SPDX-License-Identifier: MIT
// Time from the text of a robot file to the C text of all functions, through the library.
//
//   bench_generate [--markdown]
//
// Every robot of robots/ as it stands and with all parameters unknown (limit 0.5 s), and a generic
// chain of 30 joints (limit 10 s). Exit code 1 if a limit is passed.
#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "gen/robot_file/robot_file.h"
#include "tests/bench/bench_robots.h"
#include "tests/bench/table.h"

namespace dyngen::bench {
namespace {

constexpr double kRobotLimit = 0.5, kChainLimit = 10.0;  // s
constexpr int kChainJoints = 30;

struct Generation {
  double seconds = 0;
  std::size_t base_parameters = 0;
  std::size_t bytes = 0;  ///< of the C source
};

Generation generate_once(const std::string& text, const std::string& name, bool unknown) {
  const auto start = std::chrono::steady_clock::now();
  RobotModel model = build_model(parse_robot_file(text, name));
  GeneratorOptions options;
  if (unknown) {
    model = with_unknown_parameters(model, Unknown::kInertialAndDrive);
    options.parameters = ParameterMode::kRuntime;
  }
  const CText c = generate(model, options);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  return {spent.count(), make_code_model(model, options).beta.size(), c.source.size()};
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return text.str();
}

std::vector<std::string> row(const std::string& name, const std::string& parameters,
                             const Generation& generation, double limit) {
  return {name,
          parameters,
          fmt::to_string(generation.base_parameters),
          fmt::format("{:.1f}", static_cast<double>(generation.bytes) / 1000.0),
          fmt::format("{:.3f}", generation.seconds),
          fmt::format("{}{}", limit, generation.seconds > limit ? " PASSED" : "")};
}

int run(bool markdown) {
  Table table;
  table.header = {"robot", "parameters", "base", "C text, kB", "s", "limit, s"};
  bool passed = false;
  const auto add = [&](const std::string& name, const std::string& text, bool unknown,
                       double limit) {
    const Generation generation = generate_once(text, name + ".robot", unknown);
    passed = passed || generation.seconds > limit;
    table.rows.push_back(row(name, unknown ? "all unknown" : "as in the file", generation, limit));
  };
  for (const auto& path : project_robots()) {
    const std::string text = read_text(path);
    for (const bool unknown : {false, true}) add(path.stem().string(), text, unknown, kRobotLimit);
  }
  add(fmt::format("chain of {}", kChainJoints), generic_chain(kChainJoints), true, kChainLimit);
  fmt::print("{}", markdown ? table.markdown() : table.text());
  return passed ? 1 : 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  const bool markdown = argc == 2 && std::string_view(argv[1]) == "--markdown";
  if (argc > 1 && !markdown) {
    fmt::print(stderr, "usage: bench_generate [--markdown]\n");
    return 2;
  }
  try {
    return dyngen::bench::run(markdown);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

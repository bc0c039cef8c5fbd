// SPDX-License-Identifier: MIT
// Time from the text of a robot file to C text, through the library: id alone and all functions.
//
//   bench_generate [--markdown]
//
// Every robot of robots/ as it stands and with all parameters unknown, and a generic chain of 30
// joints. Exit code 1 if a limit is passed.
#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "gen/robot_file/robot_file.h"
#include "tests/bench/bench_robots.h"
#include "tests/bench/table.h"

namespace dyngen::bench {
namespace {

constexpr int kChainJoints = 30;

/// How long it may take, s.
struct Limits {
  double id, all;
};
constexpr Limits kRobotLimits{0.5, 10.0}, kChainLimits{5.0, 60.0};

struct Generation {
  double seconds = 0;
  std::size_t base_parameters = 0;
  std::size_t bytes = 0;  ///< of the C source
};

/// @param functions  as GeneratorOptions has them: empty for all
Generation generate_once(const std::string& text, const std::string& name, bool unknown,
                         const std::vector<std::string>& functions) {
  const auto start = std::chrono::steady_clock::now();
  RobotModel model = build_model(parse_robot_file(text, name));
  GeneratorOptions options;
  options.functions = functions;
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

std::string time_text(double seconds, double limit) {
  return fmt::format("{:.2f}{}", seconds, seconds > limit ? " ABOVE" : "");
}

int run(bool markdown) {
  Table table;
  table.header = {"robot",    "parameters", "base",     "id, s",
                  "limit, s", "all, s",     "limit, s", "C text of all, kB"};
  bool passed = false;
  const auto add = [&](const std::string& name, const std::string& text, bool unknown,
                       const Limits& limits) {
    const Generation id = generate_once(text, name + ".robot", unknown, {"id"});
    const Generation all = generate_once(text, name + ".robot", unknown, {});
    passed = passed || id.seconds > limits.id || all.seconds > limits.all;
    table.rows.push_back({name, unknown ? "all unknown" : "as in the file",
                          fmt::to_string(all.base_parameters), time_text(id.seconds, limits.id),
                          fmt::to_string(limits.id), time_text(all.seconds, limits.all),
                          fmt::to_string(limits.all),
                          fmt::format("{:.0f}", static_cast<double>(all.bytes) / 1000.0)});
  };
  for (const auto& path : project_robots()) {
    const std::string text = read_text(path);
    for (const bool unknown : {false, true}) add(path.stem().string(), text, unknown, kRobotLimits);
  }
  add(fmt::format("chain of {}", kChainJoints), generic_chain(kChainJoints), true, kChainLimits);
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

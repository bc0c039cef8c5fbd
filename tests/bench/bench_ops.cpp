// SPDX-License-Identifier: MIT
// Operation counts of the emitted code beside the general bounds and the best others known.
//
//   bench_ops [--markdown] [--compared] [FILE.robot ...]
//
// --compared: only what others have counts of.
// Exit code 1 if a robot with known others needs more operations (mul + add) than the best of them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "tests/bench/bench_robots.h"
#include "tests/bench/table.h"

namespace dyngen::bench {
namespace {

/// How a robot's parameters enter the code.
enum class Case {
  kRigid,       ///< ten unknown inertial parameters per link, no rotor, no friction: the others'
                ///< convention
  kWithDrives,  ///< the same with IA, FV, FS unknown
  kDiagonal,    ///< as kRigid, products of inertia are zero
  kSymmetric,   ///< as kDiagonal, and centres of mass are on the joints' axes
  kFolded,      ///< as kRigid, with --fold: what parameters alone give is worked out apart
  kFile,        ///< the robot file as it stands, its numbers baked in
};

/// A count published or measured for another program.
struct Other {
  std::string_view robot, function;
  Case convention;
  std::string_view name;
  int mul, add;
  int sum = mul + add;  ///< given alone (mul = add = 0) where only the sum is known
};

// Of OpenSYMORO and SymPyBotics after their own dead code is removed, sin and cos apart; UR10 has
// the zeros of UR10e. For gravity the better of the two stands. The thesis's Sarcos listing has
// 248/227 as printed; 74/46 of it are needed.
constexpr Other kOthers[] = {
    {"puma560", "id", Case::kRigid, "OpenSYMORO", 315, 253},
    {"puma560", "id", Case::kRigid, "SymPyBotics", 330, 259},
    {"puma560", "gravity", Case::kRigid, "better of both", 50, 28},
    {"rx90", "id", Case::kRigid, "OpenSYMORO", 287, 226},
    {"rx90", "id", Case::kRigid, "SymPyBotics", 286, 226},
    {"rx90", "gravity", Case::kRigid, "better of both", 50, 28},
    {"ur10e", "id", Case::kRigid, "OpenSYMORO", 302, 244},
    {"ur10e", "id", Case::kRigid, "SymPyBotics", 322, 251},
    {"ur10e", "gravity", Case::kRigid, "better of both", 48, 26},
    {"panda", "id", Case::kRigid, "OpenSYMORO", 361, 288},
    {"panda", "id", Case::kRigid, "SymPyBotics", 375, 292},
    {"panda", "gravity", Case::kRigid, "better of both", 64, 38},
    {"sarcos_grla", "gravity", Case::kFile, "thesis, needed part", 74, 46},
    {"puma560", "id", Case::kSymmetric, "OpenSYMORO", 202, 147},
    {"rx90", "id", Case::kSymmetric, "OpenSYMORO", 170, 117},
    {"puma560", "base_regressor", Case::kRigid, "OpenSYMORO", 0, 0, 1071},
    {"rx90", "base_regressor", Case::kRigid, "SymPyBotics", 0, 0, 843},
    {"ur10e", "base_regressor", Case::kRigid, "better of both", 0, 0, 986},
    {"panda", "base_regressor", Case::kRigid, "SymPyBotics", 0, 0, 1342},
    {"puma560", "mass_matrix", Case::kRigid, "better of both", 0, 0, 459},
    {"rx90", "mass_matrix", Case::kRigid, "better of both", 0, 0, 328},
    {"ur10e", "mass_matrix", Case::kRigid, "better of both", 0, 0, 394},
    {"panda", "mass_matrix", Case::kRigid, "better of both", 0, 0, 532},
};

/// The best of the others in this convention.
std::optional<Other> best_other(std::string_view robot, std::string_view function,
                                Case convention) {
  std::optional<Other> best;
  for (const Other& other : kOthers) {
    if (other.robot != robot || other.function != function || other.convention != convention) {
      continue;
    }
    if (!best || other.sum < best->sum) best = other;
  }
  return best;
}

std::string all_others(std::string_view robot, std::string_view function, Case convention) {
  std::string text;
  for (const Other& other : kOthers) {
    if (other.robot != robot || other.function != function || other.convention != convention) {
      continue;
    }
    text += fmt::format("{}{} ", text.empty() ? "" : ", ", other.name);
    text += other.mul > 0 ? fmt::format("{}/{}", other.mul, other.add)
                          : fmt::format("sum {}", other.sum);
  }
  return text.empty() ? "-" : text;
}

/// A function that is counted, and in which conventions.
struct CountedFunction {
  std::string_view name, title;
  std::vector<Case> cases{Case::kRigid};

  [[nodiscard]] bool in(Case which) const {
    return std::find(cases.begin(), cases.end(), which) != cases.end();
  }
};
const std::vector<CountedFunction>& counted_functions() {
  using enum Case;
  static const std::vector<CountedFunction> kFunctions = {
      {"id", "Inverse dynamics", {kRigid, kWithDrives, kDiagonal, kSymmetric, kFolded, kFile}},
      {"gravity", "Gravity", {kRigid, kFile}},
      {"mass_matrix", "Mass matrix"},
      {"fd", "Forward dynamics (one division for each joint besides)"},
      {"base_regressor", "Regressor in base parameters"},
      {"gravity_regressor", "Regressor of gravity"},
      {"energy_regressor", "Regressor of energy"},
      {"id_derivatives", "Derivatives of inverse dynamics by q, dq and ddq"},
      {"fold", "What is worked out once for each change of the parameters", {kFolded}},
  };
  return kFunctions;
}

struct CountedRobot {
  std::string name;
  int joints = 0;
  std::size_t base_parameters = 0;
  std::map<std::string_view, OperationCount> counts;  ///< by function
};

RobotModel in_convention(const RobotModel& model, Case which) {
  switch (which) {
    case Case::kRigid:
    case Case::kFolded:
      return with_unknown_parameters(model, Unknown::kInertial);
    case Case::kWithDrives:
      return with_unknown_parameters(model, Unknown::kInertialAndDrive);
    case Case::kDiagonal:
      return with_unknown_parameters(model, Unknown::kDiagonal);
    case Case::kSymmetric:
      return with_unknown_parameters(model, Unknown::kSymmetric);
    case Case::kFile:
      break;
  }
  return model;
}

/// @param compared  only functions that others have counts of; without such a function: no robot
std::optional<CountedRobot> count(const RobotModel& file, Case which, bool compared) {
  const RobotModel model = in_convention(file, which);
  GeneratorOptions options;
  for (const CountedFunction& function : counted_functions()) {
    const bool named = find_function(function.name) != nullptr;  // fold comes by itself
    const bool wanted = !compared || best_other(model.name, function.name, which);
    if (function.in(which) && named && wanted) options.functions.emplace_back(function.name);
  }
  if (compared && options.functions.empty()) return std::nullopt;
  options.parameters = which == Case::kFile ? ParameterMode::kBaked : ParameterMode::kRuntime;
  options.fold = which == Case::kFolded;
  CodeModel code = make_code_model(model, options);
  CountedRobot result{model.name, model.coordinate_count, code.beta.size(), {}};
  for (const RobotFunction& function : write_functions(code, options)) {
    result.counts[function.spec->name] = function.trace.count();
  }
  return result;
}

/// One table per function and convention; counts the robots that need more than the best other.
class Comparison {
 public:
  Comparison(std::string_view function, Case convention)
      : function_(function), convention_(convention) {
    table_.header = {"robot", "n", "mul", "add", "sum", "sin/cos"};
    if (shows_base()) table_.header.insert(table_.header.begin() + 2, "base");
    if (is_id()) table_.header.insert(table_.header.end(), {"bound", "of bound"});
    table_.header.insert(table_.header.end(), {"others (mul/add)", "best sum", "of best"});
  }

  void add(const CountedRobot& robot) {
    const OperationCount& own = robot.counts.at(function_);
    std::vector<std::string> row = {robot.name, fmt::to_string(robot.joints)};
    if (shows_base()) row.push_back(fmt::to_string(robot.base_parameters));
    for (const int number : {own.multiplications, own.additions, own.total(), own.sin_cos_pairs}) {
      row.push_back(fmt::to_string(number));
    }
    if (is_id()) {
      const int mul = 105 * robot.joints - 92, add = 94 * robot.joints - 86;
      row.push_back(fmt::format("{}/{}", mul, add));
      row.push_back(fmt::format("{:.0f} %", 100.0 * own.total() / (mul + add)));
    }
    row.push_back(all_others(robot.name, function_, convention_));
    const std::optional<Other> best = best_other(robot.name, function_, convention_);
    if (best) {
      const bool above = own.total() > best->sum;
      row.push_back(fmt::to_string(best->sum));
      row.push_back(
          fmt::format("{:.1f} %{}", 100.0 * own.total() / best->sum, above ? " ABOVE" : ""));
      if (above) ++above_;
    } else {
      row.insert(row.end(), {"-", "-"});
    }
    table_.rows.push_back(std::move(row));
  }

  [[nodiscard]] const Table& table() const { return table_; }
  [[nodiscard]] int above() const { return above_; }

 private:
  [[nodiscard]] bool is_id() const { return function_ == "id"; }
  [[nodiscard]] bool shows_base() const { return is_id() || function_ == "base_regressor"; }

  std::string_view function_;
  Case convention_;
  Table table_;
  int above_ = 0;
};

struct Convention {
  Case which;
  std::string_view title;
};
constexpr Convention kConventions[] = {
    {Case::kRigid,
     "(a) rigid bodies, all ten inertial parameters of every link unknown, no rotor, no friction"},
    {Case::kWithDrives, "(b) as (a), with IA, FV and FS of every joint unknown"},
    {Case::kFile, "(c) the robot file as it stands, its numbers baked in"},
    {Case::kDiagonal, "(d) as (a), products of inertia are zero"},
    {Case::kSymmetric, "(e) as (d), symmetric links: centres of mass are on the joints' axes"},
    {Case::kFolded, "(f) as (a), what depends on parameters alone worked out apart (--fold)"},
};

int run(const std::vector<std::filesystem::path>& paths, bool markdown, bool compared) {
  std::vector<RobotModel> models;
  for (const auto& path : paths) models.push_back(build_model(read_robot_file(path.string())));
  int above = 0;
  std::size_t rows = 0;
  for (const Convention& convention : kConventions) {
    std::vector<CountedRobot> robots;
    for (const RobotModel& model : models) {
      if (auto robot = count(model, convention.which, compared)) robots.push_back(*robot);
    }
    for (const CountedFunction& function : counted_functions()) {
      if (!function.in(convention.which)) continue;
      Comparison comparison(function.name, convention.which);
      for (const CountedRobot& robot : robots) {
        if (!compared || robot.counts.contains(function.name)) comparison.add(robot);
      }
      if (comparison.table().rows.empty()) continue;
      fmt::print("{}{}, {}\n\n{}\n", markdown ? "### " : "", function.title, convention.title,
                 markdown ? comparison.table().markdown() : comparison.table().text());
      above += comparison.above();
      rows += comparison.table().rows.size();
    }
  }
  if (rows == 0) throw std::runtime_error("bench_ops: nothing was counted");
  if (above > 0) fmt::print(stderr, "bench_ops: above the best other in {} case(s)\n", above);
  return above > 0 ? 1 : 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  bool markdown = false, compared = false;
  std::vector<std::filesystem::path> paths;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--markdown") {
      markdown = true;
    } else if (argument == "--compared") {
      compared = true;
    } else if (argument.starts_with("-")) {
      fmt::print(stderr,
                 "bench_ops: unknown option '{}'; usage: bench_ops [--markdown] [--compared] "
                 "[FILE...]\n",
                 argument);
      return 2;
    } else {
      paths.emplace_back(argument);
    }
  }
  try {
    if (paths.empty()) paths = dyngen::bench::project_robots();
    return dyngen::bench::run(paths, markdown, compared);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

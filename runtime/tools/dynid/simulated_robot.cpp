// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/simulated_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "gen/diagnostic/diagnostic.h"
#include "gen/generator/generator.h"
#include "gen/program/evaluator.h"
#include "gen/robot_file/robot_file.h"
#include "gen/symbols/exact.h"

namespace dyngen::runtime {
namespace {

void refuse_what_is_no_number(const RobotFile& file) {
  Diagnostics diagnostics(file.file_name, file.text);
  for (std::size_t key = 0; key < kRowKeyCount; ++key) {
    const auto row_key = static_cast<RowKey>(key);
    const std::vector<FieldValue>& values = file.row(row_key).values;
    const auto unknown = [](const FieldValue& value) { return value.unknown; };
    const auto first = std::find_if(values.begin(), values.end(), unknown);
    if (first != values.end()) {
      diagnostics.error(first->position, first->length,
                        fmt::format("{} of {} values of '{}' are unknown: expected numbers, since "
                                    "the robot is simulated",
                                    std::count_if(values.begin(), values.end(), unknown),
                                    values.size(), row_keyword(row_key)));
    }
    for (const FieldValue& value : values) {
      if (row_key != RowKey::kFs || value.unknown || to_double(value.value) >= 0) continue;
      diagnostics.error(value.position, value.length,
                        "'Fs' is negative: expected 0 or more, since a joint that stands is held "
                        "by it");
    }
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

/// @throws ModelError  if the robot cannot be accelerated
void check_forward_dynamics(const RobotFile& file, const CodeModel& code) {
  const std::string why = find_function("fd")->why_absent(code);
  if (why.empty()) return;
  throw ModelError(fmt::format("{}: error: it cannot be simulated: {}\n", file.file_name, why));
}

/// The robot's functions by name.
class Programs {
 public:
  Programs(CodeModel& code, const GeneratorOptions& options) {
    for (const RobotFunction& function : write_functions(code, options)) {
      std::vector<std::string> inputs(function.spec->inputs.begin(), function.spec->inputs.end());
      const std::string output(function.spec->outputs.front().array);
      programs_.emplace(function.name, ProgramEvaluator(lower(function.trace), inputs, output));
    }
  }
  [[nodiscard]] const ProgramEvaluator& at(const std::string& name) const {
    return programs_.at(name);
  }

 private:
  std::map<std::string, ProgramEvaluator> programs_;
};

auto three(ProgramEvaluator program) {
  return [program](const double* a, const double* b, const double* c, double* result) mutable {
    program.run({a, b, c}, result);
  };
}
auto one(ProgramEvaluator program) {
  return [program](const double* a, double* result) mutable { program.run({a}, result); };
}

}  // namespace

SimulatedRobot read_simulated_robot(const std::string& path, RobotUse use) {
  const RobotFile file = read_robot_file(path);
  refuse_what_is_no_number(file);
  const RobotModel model = build_model(file);

  GeneratorOptions options;
  options.functions = {"id_rigid", "gravity", "friction", "mass_matrix"};
  if (use == RobotUse::kPlant) options.functions.push_back("fd");
  options.search.work = 0;
  options.search.patience = 0;
  CodeModel code = make_code_model(model, options);
  if (use == RobotUse::kPlant) check_forward_dynamics(file, code);
  const Programs programs(code, options);

  SimulatedRobot robot;
  robot.name = model.name;
  robot.joint_names = code.coordinate_names;
  robot.revolute = code.coordinate_revolute;
  const int n = model.coordinate_count;
  robot.control.joints = robot.plant.joints = n;
  robot.control.rigid = robot.plant.rigid = three(programs.at("id_rigid"));
  robot.control.friction = robot.plant.friction = one(programs.at("friction"));
  robot.control.gravity = one(programs.at("gravity"));
  robot.plant.mass_matrix = one(programs.at("mass_matrix"));
  if (use == RobotUse::kPlant) robot.plant.forward = three(programs.at("fd"));

  robot.plant.coulomb.resize(n);
  robot.torque_limit.setConstant(n, std::numeric_limits<double>::infinity());
  const Row& taumax = file.row(RowKey::kTaumax);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const JointModel& joint = model.joints[i];
    if (joint.coordinate < 0) continue;
    robot.plant.coulomb[joint.coordinate] = to_double(joint.chi[index(Chi::kFS)].value);
    if (taumax.present) robot.torque_limit[joint.coordinate] = to_double(taumax.values[i].value);
  }
  if (!model.effects.empty()) {
    robot.warnings.push_back(fmt::format("{}: warning: {} rows 'effect' are not simulated",
                                         file.file_name, model.effects.size()));
  }
  return robot;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/simulate/simulated_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "gen/diagnostic/diagnostic.h"
#include "gen/effect_code/bound_effect.h"
#include "gen/generator/generator.h"
#include "gen/program/evaluator.h"
#include "gen/robot_file/keywords.h"
#include "gen/robot_file/robot_file.h"
#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/simulation/elastic_plant.h"
#include "runtime/simulation/twisting_effects.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/simulate/simulated_gears.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

void refuse_what_is_no_number(const RobotFile& file) {
  Diagnostics diagnostics(file.file_name, file.source_text);
  for (std::size_t key = 0; key < kRowKeyCount; ++key) {
    const auto row_key = static_cast<RowKey>(key);
    const std::vector<FieldValue>& values = file.row(row_key).values;
    const auto unknown = [](const FieldValue& value) { return value.unknown; };
    if (is_limit(row_key)) continue;  // a joint may have none
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
  for (const EffectRow& row : file.effects) {
    for (const EffectRow::Setting& setting : row.settings) {
      if (!setting.value.unknown) continue;
      diagnostics.error(setting.value.position, setting.value.length,
                        fmt::format("'{}' of effect '{}' is unknown: expected a number, since the "
                                    "robot is simulated",
                                    setting.key, row.name));
    }
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

/// A parameter that the row leaves out has no number either.
void refuse_missing_parameters(const RobotFile& file, const RobotModel& model,
                               const EffectCatalogue& catalogue) {
  Diagnostics diagnostics(file.file_name, file.source_text);
  for (const BoundEffect& effect : bind_effects(model, catalogue)) {
    for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
      if (!effect.parameters[k].unknown) continue;
      const auto& parameter = effect.file->parameters[k];
      diagnostics.error(effect.position, static_cast<int>(effect.file->name.size()),
                        fmt::format("effect '{}' has no '{}=': expected a number, since the robot "
                                    "is simulated",
                                    effect.file->name, parameter.name),
                        parameter.meaning);
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

/// What acts on the motion or twists joints into the plant, the rest beside it.
void add_effects(SimulatedRobot& robot, const RobotFile& file,
                 const std::vector<EffectInstance>& effects, const RobotModel& model,
                 const SimulatedTemperature& temperature, RobotUse use) {
  const int n = robot.joints();
  EffectSurroundings surroundings;
  for (VectorXd* part : {&surroundings.coulomb, &surroundings.viscous, &surroundings.rotor}) {
    part->setZero(n);
  }
  for (const JointModel& joint : model.joints) {
    if (joint.coordinate < 0) continue;
    surroundings.coulomb[joint.coordinate] = to_double(joint.chi[index(Chi::kFS)].value);
    surroundings.viscous[joint.coordinate] = to_double(joint.chi[index(Chi::kFV)].value);
    surroundings.rotor[joint.coordinate] = to_double(joint.chi[index(Chi::kIA)].value);
  }
  surroundings.temperature = temperature.start;
  surroundings.warming = temperature.rate;
  std::vector<EffectInstance> acting, twisting;
  std::vector<std::size_t> rows;  // of those that twist
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const EffectInstance& effect = effects[i];
    if (effect.law.reads("temp")) robot.reads_temperature = true;
    if (acts_on_plant(effect.law)) {
      acting.push_back(effect);
    } else if (effect.law.alignment == AlignmentOperator::kLag) {
      // what is recorded is the command
      robot.plant.lag.conservativeResizeLike(VectorXd::Zero(n));
      for (const int joint : joints_of(effect, n)) {
        robot.plant.lag[joint] += effect.parameters[effect.law.alignment_parameter];
      }
    } else if (twists_joint(effect)) {
      twisting.push_back(effect);
      rows.push_back(i);
    } else {
      robot.recorded_effects.push_back(effect);
    }
  }
  if (use != RobotUse::kPlant) return;
  std::vector<ElasticJoint> gears =
      elastic_joints(file, twisting, rows, surroundings.rotor, robot.mass_matrix, robot.remarks);
  // links behind gears have neither friction nor rotors
  for (VectorXd* part : {&surroundings.coulomb, &surroundings.viscous, &surroundings.rotor}) {
    part->conservativeResizeLike(VectorXd::Zero(n + static_cast<int>(gears.size())));
  }
  robot.plant.effects = PlantEffects(std::move(acting), std::move(surroundings));
  if (!gears.empty()) robot.plant = elastic_plant(std::move(robot.plant), std::move(gears));
}

auto three(ProgramEvaluator program) {
  return [program](const double* a, const double* b, const double* c, double* result) mutable {
    program.run({a, b, c}, result);
  };
}
auto one(ProgramEvaluator program) {
  return [program](const double* a, double* result) mutable { program.run({a}, result); };
}

}  // namespace

SimulatedRobot read_simulated_robot(const RobotSource& source, RobotUse use,
                                    const EffectCatalogue& catalogue,
                                    const SimulatedTemperature& temperature) {
  return simulated_robot(read_robot_file(source), use, catalogue, temperature);
}

SimulatedRobot simulated_robot(const RobotFile& file, RobotUse use,
                               const EffectCatalogue& catalogue,
                               const SimulatedTemperature& temperature) {
  refuse_what_is_no_number(file);
  const RobotModel whole = build_model(file);
  refuse_missing_parameters(file, whole, catalogue);
  RobotModel model = whole;  // its functions are those of the robot without effects
  model.effects.clear();

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
  robot.mass_matrix = robot.plant.mass_matrix = one(programs.at("mass_matrix"));
  if (use == RobotUse::kPlant) robot.plant.forward = three(programs.at("fd"));

  robot.plant.coulomb.resize(n);
  robot.torque_limit.setConstant(n, std::numeric_limits<double>::infinity());
  const Row& taumax = file.row(RowKey::kTaumax);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const JointModel& joint = model.joints[i];
    if (joint.coordinate < 0) continue;
    robot.plant.coulomb[joint.coordinate] = to_double(joint.chi[index(Chi::kFS)].value);
    if (taumax.present && !taumax.values[i].unknown) {
      robot.torque_limit[joint.coordinate] = to_double(taumax.values[i].value);
    }
  }
  add_effects(robot, file, effect_instances(whole, catalogue), whole, temperature, use);
  return robot;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "tests/support/model_bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

double known(const Quantity& quantity) {
  if (quantity.unknown) throw std::invalid_argument("numeric_robot(): a quantity is unknown");
  return to_double(quantity.value);
}

/// The rational number that the double's shortest decimal spells.
GiNaC::ex exact_decimal(double value) {
  if (value == 0.0) return 0;
  const std::string shortest = fmt::format("{}", std::fabs(value));
  const std::size_t exponent_at = shortest.find('e');
  std::string digits = shortest.substr(0, exponent_at);
  long exponent =
      exponent_at == std::string::npos ? 0 : std::stol(shortest.substr(exponent_at + 1));
  if (const std::size_t point = digits.find('.'); point != std::string::npos) {
    exponent -= static_cast<long>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  const GiNaC::numeric number =
      GiNaC::numeric(digits.c_str()) * GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(exponent));
  return value < 0 ? GiNaC::ex(-number) : GiNaC::ex(number);
}

GiNaC::ex exact_angle(double value) {
  const double twelfths = value / (std::acos(-1.0) / 12);
  const double nearest = std::round(twelfths);
  if (std::fabs(twelfths - nearest) < 1e-12) {
    return GiNaC::Pi * static_cast<long>(nearest) / 12;
  }
  return exact_decimal(value);
}

Quantity exact_quantity(double value) { return {false, exact_decimal(value), 1}; }

}  // namespace

std::vector<double> per_joint(const RobotModel& model, const std::vector<double>& values) {
  std::vector<double> result(model.joints.size(), 0.0);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const int coordinate = model.joints[j].coordinate;
    if (coordinate >= 0) result[j] = values[static_cast<std::size_t>(coordinate)];
  }
  return result;
}

NumericRobot numeric_robot(const RobotModel& model) {
  NumericRobot robot;
  robot.standard = model.convention == DhConvention::kStandard;
  for (const JointModel& joint : model.joints) {
    NumericJoint numeric;
    numeric.sigma = static_cast<int>(joint.type);
    numeric.parent = joint.parent;
    numeric.alpha = to_double(joint.alpha);
    numeric.theta = to_double(joint.theta);
    numeric.d = known(joint.d);
    numeric.r = known(joint.r);
    for (std::size_t k = 0; k < kInertialCount; ++k) numeric.inertial[k] = known(joint.chi[k]);
    numeric.IA = known(joint.chi[index(Chi::kIA)]);
    numeric.Fs = known(joint.chi[index(Chi::kFS)]);
    numeric.Fv = known(joint.chi[index(Chi::kFV)]);
    numeric.off = known(joint.chi[index(Chi::kOFF)]);
    robot.joints.push_back(numeric);
  }
  for (std::size_t k = 0; k < 3; ++k) robot.base_acceleration[k] = known(model.gravity[k]);
  return robot;
}

RobotModel robot_model(const NumericRobot& robot, const std::string& name) {
  RobotModel model;
  model.name = name;
  model.file_name = name + ".robot";
  model.convention = robot.standard ? DhConvention::kStandard : DhConvention::kModified;
  for (const NumericJoint& numeric : robot.joints) {
    JointModel joint;
    joint.type = static_cast<JointType>(numeric.sigma);
    joint.parent = numeric.parent;
    joint.alpha = exact_angle(numeric.alpha);
    joint.theta = exact_angle(numeric.theta);
    joint.d = exact_quantity(numeric.d);
    joint.r = exact_quantity(numeric.r);
    for (std::size_t k = 0; k < kInertialCount; ++k) {
      joint.chi[k] = exact_quantity(numeric.inertial[k]);
    }
    joint.chi[index(Chi::kIA)] = exact_quantity(numeric.IA);
    joint.chi[index(Chi::kFS)] = exact_quantity(numeric.Fs);
    joint.chi[index(Chi::kFV)] = exact_quantity(numeric.Fv);
    joint.chi[index(Chi::kOFF)] = exact_quantity(numeric.off);
    joint.name = "joint" + std::to_string(model.joints.size() + 1);
    if (joint.type != JointType::kFixed) joint.coordinate = model.coordinate_count++;
    model.joints.push_back(std::move(joint));
  }
  for (std::size_t k = 0; k < 3; ++k) model.gravity[k] = exact_quantity(robot.base_acceleration[k]);
  return model;
}

RobotModel read_model(const std::string& path_in_project) {
  return build_model(read_robot_file(std::string(DYNGEN_SOURCE_DIR "/") + path_in_project));
}

RobotModel parse_model(const std::string& text) {
  return build_model(parse_robot_file(text, "test.robot"));
}

RobotModel with_unknown_parameters(RobotModel model, bool inertial_only) {
  for (JointModel& joint : model.joints) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const bool inertial = k < kInertialCount;
      const bool drive = joint.type != JointType::kFixed && !inertial_only;
      joint.chi[k] = {};
      joint.chi[k].unknown = inertial || (drive && static_cast<Chi>(k) != Chi::kOFF);
    }
  }
  return model;
}

RobotModel with_random_values(RobotModel model, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> thousandths(-999, 999);
  const auto fill = [&](Quantity& quantity, bool positive) {
    if (!quantity.unknown) return;
    int value = thousandths(random);
    if (positive) value = 200 + std::abs(value);
    quantity.value = GiNaC::numeric(value == 0 ? 1 : value, 1000);
    quantity.unknown = false;
  };
  for (JointModel& joint : model.joints) {
    fill(joint.d, false);
    fill(joint.r, false);
    for (std::size_t k = 0; k < kChiCount; ++k) {
      fill(joint.chi[k], static_cast<Chi>(k) == Chi::kM || k >= kInertialCount);
    }
  }
  for (Quantity& component : model.gravity) fill(component, false);
  return model;
}

std::vector<MotionSample> random_samples(int coordinates, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto numbers = [&](int count_of, double range) {
    std::vector<double> values;
    for (int i = 0; i < count_of; ++i) values.push_back(range * unit(random));
    return values;
  };
  const auto vector = [&](double range) { return numbers(coordinates, range); };
  const std::vector<double> zero(static_cast<std::size_t>(coordinates), 0.0);
  std::vector<MotionSample> samples = {{.q = zero, .dq = zero, .ddq = zero}};
  while (static_cast<int>(samples.size()) < count) {
    samples.push_back({.q = vector(3.0), .dq = vector(3.0), .ddq = vector(5.0)});
  }
  for (MotionSample& sample : samples) {
    sample.tau = vector(20.0);
    sample.gravity = numbers(3, 9.8);
    sample.wrench = numbers(6, 10.0);
    sample.payload = numbers(static_cast<int>(kInertialCount), 1.0);
  }
  return samples;
}

const std::vector<double>& MotionSample::input(const std::string& name) const {
  if (name == "q") return q;
  if (name == "dq") return dq;
  if (name == "ddq") return ddq;
  if (name == "tau") return tau;
  if (name == "gravity") return gravity;
  if (name == "wrench") return wrench;
  if (name == "payload") return payload;
  if (name == "A") return weights;
  throw std::invalid_argument("MotionSample: no input " + name);
}

namespace {

/// Rows and columns of the moving joints, row-major.
std::vector<double> judge_mass_matrix(const RobotModel& model, const NumericRobot& robot,
                                      const std::vector<double>& q) {
  const SquareMatrix<double> M = mass_matrix(robot, q);
  std::vector<double> moving;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      if (model.joints[i].coordinate < 0 || model.joints[j].coordinate < 0) continue;
      moving.push_back(M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }
  return moving;
}

}  // namespace

std::vector<double> judge(const RobotModel& model, const NumericRobot& robot,
                          const std::string& function, const MotionSample& sample) {
  const std::vector<double> q = per_joint(model, sample.q);
  if (function == "mass_matrix") return judge_mass_matrix(model, robot, q);
  const std::vector<double> dq = per_joint(model, sample.dq);
  const std::vector<double> ddq = per_joint(model, sample.ddq);
  std::vector<double> torque;
  if (function == "id") torque = id(robot, q, dq, ddq);
  if (function == "id_rigid") {
    torque = id(robot, q, dq, ddq);
    const std::vector<double> loss = friction(robot, dq);
    for (std::size_t j = 0; j < torque.size(); ++j) torque[j] -= loss[j];
  }
  if (function == "gravity") torque = gravity(robot, q);
  if (function == "coriolis") torque = coriolis(robot, q, dq);
  if (function == "friction") torque = friction(robot, dq);
  if (torque.empty()) throw std::invalid_argument("judge(): unknown function " + function);
  std::vector<double> moving;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].coordinate >= 0) moving.push_back(torque[j]);
  }
  return moving;
}

std::vector<GeneratorOptions> every_mode(const std::vector<std::string>& functions) {
  std::vector<GeneratorOptions> result;
  for (const ParameterMode mode : {ParameterMode::kBaked, ParameterMode::kRuntime}) {
    for (const bool regroup : {true, false}) {
      GeneratorOptions options;
      options.functions = functions;
      options.parameters = mode;
      options.regroup = regroup;
      result.push_back(options);
    }
  }
  return result;
}

GeneratorOptions with_short_search(GeneratorOptions options) {
  options.search.work = std::min<std::int64_t>(options.search.work, 10000);
  return options;
}

EvaluatedModel::EvaluatedModel(const RobotModel& model, const RobotModel& values,
                               const GeneratorOptions& options)
    : code_(make_code_model(model, options)) {
  // chi as the user of a run-time model gets it: every grouped parameter from the numbers
  const SymbolicRobot symbolic = make_symbolic(model, options);
  const SymbolicRobot numbers = make_symbolic(with_random_values(values, 1));
  GiNaC::exmap known;
  const auto match = [&](const FileSymbol& entry, const GiNaC::ex& value) {
    known[entry.symbol] = value;
  };
  for (const FileSymbol& entry : symbolic.parameters) {
    GiNaC::ex value = 0;
    for (const FileSymbol& number : numbers.parameters) {
      if (number.name == entry.name) value = number.value;
    }
    match(entry, value);
  }
  for (const FileSymbol& entry : symbolic.geometry) {
    const std::size_t joint = std::stoul("0" + entry.name.substr(1)) - 1;
    const Quantity& quantity = entry.name[0] == 'd'   ? values.joints[joint].d
                               : entry.name[0] == 'r' ? values.joints[joint].r
                               : entry.name == "gx"   ? values.gravity[0]
                               : entry.name == "gy"   ? values.gravity[1]
                                                      : values.gravity[2];
    match(entry, quantity.value);
  }
  const Regrouping grouping = options.regroup ? regroup(symbolic) : keep_standard(symbolic);
  for (const GroupedParameter& parameter : grouping.parameters) {
    chi_.push_back(to_double(parameter.value.subs(known)));
  }
  for (const FileSymbol& entry : symbolic.geometry) {
    const bool is_argument = options.gravity && entry.name[0] == 'g';
    if (!is_argument) chi_.push_back(to_double(known[entry.symbol]));
  }
  for (std::size_t i = chi_.size(); i < code_.chi.size(); ++i) {  // of effects
    chi_.push_back(code_.chi[i].value ? to_double(*code_.chi[i].value) : 0.25);
  }
  functions_ = write_functions(code_, with_short_search(options));
  for (const RobotFunction& function : functions_) programs_.push_back(lower(function.trace));
}

std::size_t EvaluatedModel::place(const std::string& function) const {
  for (std::size_t i = 0; i < functions_.size(); ++i) {
    if (functions_[i].name == function) return i;
  }
  throw std::invalid_argument("EvaluatedModel: no function " + function);
}

EffectState EvaluatedModel::new_state(double dt) const {
  EffectState state;
  for (const CodeState& own : code_.memory.states) state.z.push_back(to_double(own.start));
  state.last.assign(code_.memory.last.size(), 0.0);
  state.dt = dt;
  return state;
}

std::vector<double> EvaluatedModel::call(const std::string& function, const MotionSample& sample,
                                         const std::string& output) const {
  return run(function, sample, output, nullptr);
}

std::vector<double> EvaluatedModel::advance(const std::string& function, const MotionSample& sample,
                                            EffectState& state) const {
  return run(function, sample, {}, &state);
}

std::vector<double> EvaluatedModel::run(const std::string& function, const MotionSample& sample,
                                        const std::string& output, EffectState* state) const {
  const std::size_t at = place(function);
  std::vector<InputArray> inputs;
  std::vector<OutputArray> outputs;
  std::vector<double> folded;
  std::map<std::string, std::vector<double>> values;
  std::string wanted = output;
  const std::vector<Argument> all = arguments(*functions_[at].spec, code_);
  EffectState before;
  if (state != nullptr) {
    before = *state;
    inputs = {{kStateArray, before.z},
              {kLastArray, before.last},
              {kStepArray, {&before.step, 1}},
              {kPeriodArray, {&before.dt, 1}}};
    outputs = {{kStateArray, state->z}, {kLastArray, state->last}, {kStepArray, {&state->step, 1}}};
  }
  for (const Argument& argument : all) {
    if (argument.state) continue;
    if (argument.output) {
      if (wanted.empty()) wanted = argument.name;
      std::vector<double>& array = values[argument.name];
      array.assign(static_cast<std::size_t>(argument.size()), std::nan(""));
      outputs.push_back({argument.name, array});
    } else if (argument.name == "folded") {
      folded = call("fold", sample);
      inputs.push_back({argument.name, folded});
    } else {
      inputs.push_back(
          {argument.name, argument.name == "chi" ? chi_ : sample.input(argument.name)});
    }
  }
  evaluate(programs_[at], 1, inputs, outputs);
  return values.at(wanted);
}

OperationCount EvaluatedModel::count(const std::string& function) const {
  return functions_[place(function)].trace.count();
}

}  // namespace dyngen::test

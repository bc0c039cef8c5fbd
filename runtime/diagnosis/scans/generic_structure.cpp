// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/generic_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;
using Form = GenericStructure::Form;

EffectInstance of_joint(int joint) {
  EffectInstance effect;
  effect.joint = joint;
  return effect;
}

/// Travel since the last reversal of a joint, of all samples.
VectorXd distance_since_reversal(const VectorXd& q, const VectorXd& sign) {
  VectorXd distance(q.size());
  double turned = q.size() > 0 ? q[0] : 0;
  for (Index k = 0; k < q.size(); ++k) {
    if (k > 0 && sign[k] * sign[k - 1] < 0) turned = q[k];
    distance[k] = std::abs(q[k] - turned);
  }
  return distance;
}

}  // namespace

std::string variable_name(const StructureVariable& variable) {
  const int joint = variable.joint + 1;
  switch (variable.kind) {
    case Kind::kPosition:
      return fmt::format("q{}", joint);
    case Kind::kVelocity:
      return fmt::format("qd{}", joint);
    case Kind::kAcceleration:
      return fmt::format("qdd{}", joint);
    case Kind::kLoad:
      return fmt::format("tau_load{}", joint);
    case Kind::kDistance:
      return fmt::format("distance{}", joint);
    case Kind::kTime:
      break;
  }
  return "t";
}

std::optional<StructureVariable> variable_of_name(const std::string& name) {
  if (name == "t") return StructureVariable{Kind::kTime, -1};
  const std::size_t digits = name.find_first_of("123456789");
  if (digits == std::string::npos || name.size() > digits + 4 ||
      name.find_first_not_of("0123456789", digits) != std::string::npos) {
    return std::nullopt;
  }
  const int joint = std::stoi(name.substr(digits)) - 1;
  for (const Kind kind :
       {Kind::kPosition, Kind::kVelocity, Kind::kAcceleration, Kind::kLoad, Kind::kDistance}) {
    if (variable_name({kind, joint}) == name) return StructureVariable{kind, joint};
  }
  return std::nullopt;
}

std::vector<std::string> GenericStructure::names() const {
  if (form == Form::kLine || form == Form::kRepeats) return {"t"};
  if (form == Form::kImpulses) return {variable_name({Kind::kDistance, joint})};
  std::vector<std::string> names;
  const auto add = [&](const StructureVariable& variable) {
    const std::string name = variable_name(variable);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const StructureVariable& variable : variables) add(variable);
  if (form == Form::kFriction) add({Kind::kVelocity, joint});
  return names;
}

GenericStructure impulses_at_reversals(int joint) { return {joint, {}, Form::kImpulses}; }

std::vector<GenericStructure> generic_structures(int joints) {
  std::vector<GenericStructure> structures;
  const StructureVariable time = {Kind::kTime, -1};
  for (int j = 0; j < joints; ++j) {
    const auto add = [&](std::vector<StructureVariable> variables, Form form) {
      structures.push_back({j, std::move(variables), form});
    };
    for (const Kind kind : {Kind::kPosition, Kind::kVelocity, Kind::kAcceleration, Kind::kLoad}) {
      add({{kind, j}}, Form::kFunction);
    }
    add({time}, Form::kFunction);
    for (const Kind kind : {Kind::kPosition, Kind::kAcceleration, Kind::kLoad, Kind::kDistance}) {
      add({{kind, j}}, Form::kFriction);
    }
    add({time}, Form::kFriction);
    add({}, Form::kImpulses);
    add({}, Form::kLine);
    add({}, Form::kRepeats);
    for (int k = 0; k < joints; ++k) {
      if (k == j) continue;
      for (const Kind kind : {Kind::kPosition, Kind::kVelocity, Kind::kAcceleration}) {
        add({{kind, k}}, Form::kFunction);
      }
      add({{Kind::kPosition, k}}, Form::kFriction);
    }
    for (int k = 0; k < joints; ++k) {
      const StructureVariable q = {Kind::kPosition, k}, qd = {Kind::kVelocity, k};
      add({{Kind::kVelocity, j}, q}, Form::kFunction);
      for (int c = 0; c < joints; ++c) add({qd, qd, {Kind::kPosition, c}}, Form::kSpeeds);
      for (int m = k + 1; m < joints; ++m) {
        const StructureVariable other = {Kind::kVelocity, m};
        add({q, {Kind::kPosition, m}}, Form::kFunction);
        add({q, {Kind::kPosition, m}}, Form::kWave);
        add({qd, other}, Form::kFunction);
        add({qd, other}, Form::kSpeeds);
        for (int c = 0; c < joints; ++c) add({qd, other, {Kind::kPosition, c}}, Form::kSpeeds);
      }
    }
  }
  return structures;
}

std::vector<GenericStructure> structures_of(const EffectRecordings& data) {
  std::vector<GenericStructure> structures = generic_structures(data.joints());
  std::erase_if(structures, [&](const GenericStructure& structure) {
    const auto masked = [&](const StructureVariable& variable) {
      return variable.joint >= 0 && data.is_masked(variable.joint);
    };
    return data.is_masked(structure.joint) ||
           std::any_of(structure.variables.begin(), structure.variables.end(), masked);
  });
  return structures;
}

VectorXd travelled_sign_of(const EffectRecordings& data, std::size_t run, int joint) {
  const EffectRun& here = data.runs[run];
  return travelled_sign(here.motion.q.col(joint), here.motion.dq.col(joint),
                        2.5 * here.position_step[joint]);
}

VectorXd variable_values(const EffectRecordings& data, EffectSignals& signals, std::size_t run,
                         const StructureVariable& variable) {
  const EffectRun& here = data.runs[run];
  const Motion& motion = here.motion;
  switch (variable.kind) {
    case Kind::kPosition:
      return motion.q.col(variable.joint);
    case Kind::kVelocity:
      return motion.dq.col(variable.joint);
    case Kind::kAcceleration:
      return motion.ddq.col(variable.joint);
    case Kind::kDistance:
      return distance_since_reversal(motion.q.col(variable.joint),
                                     travelled_sign_of(data, run, variable.joint));
    case Kind::kLoad: {
      EffectInstance effect = of_joint(variable.joint);
      effect.law.variables = {"tau_load"};
      return signals.variables(run, effect, variable.joint).col(0);
    }
    case Kind::kTime:
      break;
  }
  return here.time;
}

VectorXd values_at_equations(const EffectRecordings& data, EffectSignals& signals,
                             const StructureVariable& variable) {
  VectorXd values(data.equations());
  Index start = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    const VectorXd all = variable_values(data, signals, run, variable);
    const Index first = first_sample(here.decimator), rows = here.rows.Y.rows();
    for (Index k = 0; k < rows; ++k) values[start + k] = all[first + k * here.decimator.factor];
    start += rows;
  }
  return values;
}

}  // namespace dyngen::runtime

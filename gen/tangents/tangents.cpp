// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tangents/tangents.h"

#include <fmt/format.h>

#include <string>

#include "gen/algorithms/inverse_dynamics/rnea.h"
#include "gen/base_parameters/base_parameters.h"
#include "gen/diagnostic/assert.h"
#include "gen/functions/functions.h"
#include "gen/symbols/exact.h"
#include "gen/tangents/displaced_robot.h"

namespace dyngen {
namespace {

/// Which links have parameters.
enum class OpenLinks { kEvery, kOne, kNone };

/// All ten parameters of the links are unknown; there are no rotors and no friction.
/// @param one  of kOne: from 1
RobotModel opened(RobotModel model, OpenLinks open, bool gravity, int one = 0) {
  for (int j = 1; j <= model.size(); ++j) {
    const bool has_body =
        open == OpenLinks::kEvery || (open == OpenLinks::kOne && j == one);
    for (std::size_t k = 0; k < kChiCount; ++k) {
      Quantity& quantity = model.joints[static_cast<std::size_t>(j - 1)].chi[k];
      quantity = {.unknown = has_body && k < kInertialCount};
    }
  }
  if (gravity) {
    for (Quantity& component : model.gravity) component.unknown = true;
  }
  return model;
}

ParameterSum sum_of(const GroupedParameter& parameter, const SymbolicRobot& robot, int links) {
  ParameterSum sum;
  for (const FileSymbol& symbol : robot.parameters) {
    const GiNaC::ex factor = parameter.value.coeff(symbol.symbol, 1);
    if (factor.is_zero()) continue;
    for (int place = 0; place < links * static_cast<int>(kChiCount); ++place) {
      const auto kind = static_cast<std::size_t>(place) % kChiCount;
      const int link = place / static_cast<int>(kChiCount) + 1;
      if (chi_name(static_cast<Chi>(kind), link) != symbol.name) continue;
      sum.terms.push_back({place, to_double(factor)});
    }
  }
  return sum;
}

struct OpenRobot {
  CodeModel code;
  std::vector<ParameterSum> chi;
};

OpenRobot open_robot(const SymbolicRobot& robot, int links, bool gravity) {
  const Regrouping standard = keep_standard(robot);
  OpenRobot result;
  result.code = make_code_model(standard, standard.parameters,
                                {.parameters = ParameterMode::kRuntime, .gravity = gravity});
  for (const GroupedParameter& parameter : standard.parameters) {
    result.chi.push_back(sum_of(parameter, robot, links));
  }
  return result;
}

TangentProgram program_of(const OpenRobot& robot, const Trace& trace) {
  return {lower(trace), robot.chi};
}

TangentProgram catalogue_program(const RobotModel& model, const char* name) {
  const OpenRobot robot =
      open_robot(make_symbolic(opened(model, OpenLinks::kEvery, true)), model.size(), true);
  return program_of(robot, write_plain_function(parse_function_name(name), robot.code).trace);
}

}  // namespace

TangentProgram motion_derivatives(const RobotModel& model) {
  return catalogue_program(model, "id_derivatives");
}

TangentProgram gravity_torque(const RobotModel& model) {
  return catalogue_program(model, "gravity");
}

TangentProgram joint_wrenches(const RobotModel& model) {
  const OpenRobot robot =
      open_robot(make_symbolic(opened(model, OpenLinks::kEvery, true)), model.size(), true);
  Trace trace(&robot.code.inputs);
  CodeModel named = robot.code;
  named.links = with_named_parameters(trace, robot.code);
  write_joint_wrenches(trace, named);
  trace.drop_dead_code();
  return program_of(robot, trace);
}

PayloadProgram payload_regressor(const RobotModel& model, int link) {
  const OpenRobot robot =
      open_robot(make_symbolic(opened(model, OpenLinks::kOne, true, link)), model.size(), true);
  PayloadProgram result;
  result.program =
      lower(write_plain_function(parse_function_name("base_regressor"), robot.code).trace);
  result.columns = robot.chi;
  const int first = static_cast<int>(kChiCount) * (link - 1);
  for (ParameterSum& column : result.columns) {
    for (ParameterSum::Term& term : column.terms) term.place -= first;
  }
  return result;
}

Program link_jacobian(const RobotModel& model, int link) {
  const OpenRobot robot =
      open_robot(make_symbolic(opened(model, OpenLinks::kNone, false)), model.size(), false);
  return lower(
      write_plain_function(parse_function_name(fmt::format("jacobian_{}", link)), robot.code)
          .trace);
}

TangentProgram geometry_derivative(const RobotModel& model, int link, DhConstant constant) {
  const bool standard = model.convention == DhConvention::kStandard;
  const SymbolicRobot robot = make_symbolic(opened(model, OpenLinks::kEvery, true));
  const OpenRobot open =
      open_robot(displaced_robot(robot, link, constant, standard), model.size(), true);
  return program_of(open, write_plain_function(parse_function_name("id_dq_pos"), open.code).trace);
}

}  // namespace dyngen

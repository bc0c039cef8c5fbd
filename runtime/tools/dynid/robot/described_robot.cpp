// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/described_robot.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "gen/base_parameters/base_parameters.h"
#include "gen/diagnostic/diagnostic.h"
#include "gen/functions/functions.h"
#include "gen/generator/generator.h"
#include "gen/program/program.h"
#include "gen/symbols/exact.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kStandard = static_cast<int>(kChiCount);

bool is_of_actuator(Chi kind) { return index(kind) >= kInertialCount; }

/// A parameter that no data decide and that the file's author did not write down.
bool is_open(const Quantity& quantity, OpenParameters open) {
  switch (open) {
    case OpenParameters::kAsWritten:
      return false;
    case OpenParameters::kAbsentRows:
      return quantity.line == 0;
    case OpenParameters::kEverything:
      return quantity.line == 0 || quantity.known_zero();
  }
  return false;
}

RobotModel opened(RobotModel model, OpenParameters open) {
  for (JointModel& joint : model.joints) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const Chi kind = static_cast<Chi>(k);
      const bool written = joint.chi[k].line != 0;
      // a fixed joint has no actuator; an actuator's parameter that is written as zero stays zero
      if (is_of_actuator(kind) && (joint.type == JointType::kFixed || written)) continue;
      if (is_open(joint.chi[k], open)) joint.chi[k].unknown = true;
    }
  }
  return model;
}

/// Estimation needs numbers for what torque is not linear in.
void refuse_unknown_geometry(const RobotFile& file) {
  Diagnostics diagnostics(file.file_name, file.text);
  for (const RowKey key : {RowKey::kD, RowKey::kR, RowKey::kGx, RowKey::kGy, RowKey::kGz}) {
    const Row& row = file.row(key);
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const FieldValue& value = row.values[i];
      if (!value.unknown) continue;
      diagnostics.error(value.position, value.length,
                        fmt::format("'{}' is unknown: expected a number, since recordings are "
                                    "compared with the torque of a robot whose geometry is known",
                                    row_keyword(key)));
    }
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

ParameterKind kind_of(Chi kind) {
  switch (kind) {
    case Chi::kIA:
      return ParameterKind::kRotorInertia;
    case Chi::kFV:
      return ParameterKind::kViscous;
    case Chi::kFS:
      return ParameterKind::kCoulomb;
    case Chi::kOFF:
      return ParameterKind::kOffset;
    default:
      return ParameterKind::kInertial;
  }
}

/// Place of a symbol of the file among the standard parameters.
Index place_of(const FileSymbol& symbol, int links) {
  for (int link = 1; link <= links; ++link) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      if (symbol.name == chi_name(static_cast<Chi>(k), link)) {
        return static_cast<Index>(k) + kStandard * (link - 1);
      }
    }
  }
  throw std::logic_error("describe_robot(): '" + symbol.name + "' is no standard parameter");
}

MatrixXd grouping_matrix(const SymbolicRobot& robot,
                         const std::vector<GroupedParameter>& parameters) {
  MatrixXd K =
      MatrixXd::Zero(static_cast<Index>(parameters.size()), Index{kStandard} * robot.size());
  for (const FileSymbol& symbol : robot.parameters) {
    const Index place = place_of(symbol, robot.size());
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const GiNaC::ex coefficient = parameters[i].value.coeff(symbol.symbol, 1);
      if (!coefficient.is_zero()) K(static_cast<Index>(i), place) = to_double(coefficient);
    }
  }
  return K;
}

/// Columns of the grouping that carry the base parameters: a parameter's own place where it is one,
/// else chosen so that the system is well conditioned.
std::vector<Index> choose_places(const MatrixXd& grouping,
                                 const std::vector<GroupedParameter>& parameters) {
  std::vector<Index> places;
  MatrixXd own(grouping.rows(), grouping.rows());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Column& column = parameters[i].column;
    places.push_back(static_cast<Index>(index(column.kind)) + Index{kStandard} * (column.link - 1));
    own.col(static_cast<Index>(i)) = grouping.col(places.back());
  }
  if (own.isIdentity(1e-12)) return places;
  Eigen::ColPivHouseholderQR<MatrixXd> pivoted(grouping);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    places[i] = pivoted.colsPermutation().indices()(static_cast<Index>(i));
  }
  return places;
}

/// "ZZ2 + IA2 + ...", or what the parameter is where nothing is grouped into it.
std::string formula_of(const std::string& comment, const GroupedParameter& parameter) {
  if (comment.starts_with("= ")) return comment.substr(2);
  const int link = parameter.column.link;
  switch (parameter.column.kind) {
    case Chi::kIA:
      return fmt::format("rotor inertia of joint {}", link);
    case Chi::kFV:
      return fmt::format("viscous friction of joint {}", link);
    case Chi::kFS:
      return fmt::format("Coulomb friction of joint {}", link);
    case Chi::kOFF:
      return fmt::format("torque offset of joint {}", link);
    default:
      return parameter.name();
  }
}

std::optional<double> file_value(const GroupedParameter& parameter, const SymbolicRobot& robot) {
  const GiNaC::ex value = with_known_values(parameter.value, robot);
  if (!is_number(value)) return std::nullopt;
  return to_double(value);
}

StandardParameters standard_values(const RobotModel& model) {
  StandardParameters values(Index{kStandard} * model.size());
  for (int j = 1; j <= model.size(); ++j) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const Quantity& quantity = model.joint(j).chi[k];
      values[Index{kStandard} * (j - 1) + static_cast<Index>(k)] =
          quantity.unknown ? std::numeric_limits<double>::quiet_NaN() : to_double(quantity.value);
    }
  }
  return values;
}

/// Which elements of Y are zero whatever the motion: those that hold the constant 0.
std::vector<std::vector<int>> visible_columns(const Program& program, int joints, int parameters) {
  std::set<int> zeros;
  for (const Program::Constant& constant : program.constants) {
    if (constant.value == 0.0) zeros.insert(constant.reg);
  }
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(joints));
  for (const Program::Result& result : program.results) {
    if (zeros.contains(result.reg)) continue;
    columns[static_cast<std::size_t>(result.index / parameters)].push_back(result.index %
                                                                           parameters);
  }
  for (std::vector<int>& row : columns) std::sort(row.begin(), row.end());
  return columns;
}

void check_motion(const MatrixXd& matrix, const char* name, Index rows, Index columns) {
  if (matrix.rows() == rows && matrix.cols() == columns) return;
  throw std::invalid_argument(fmt::format("regressor(): {} is {} x {}, expected {} x {}", name,
                                          matrix.rows(), matrix.cols(), rows, columns));
}

/// The base regressor as a program that is evaluated over many samples.
void add_regressor(LinearModel& linear, CodeModel& code) {
  const std::vector<RobotFunction> functions =
      write_functions({parse_function_name("base_regressor")}, code, {.patience = 0, .work = 0});
  auto program = std::make_shared<const Program>(lower(functions.front().trace));
  linear.columns = visible_columns(*program, linear.joints(), linear.size());
  const Index joints = linear.joints(), size = linear.size();
  linear.regressor = [program, joints, size](const MatrixXd& q, const MatrixXd& dq,
                                             const MatrixXd& ddq, MatrixXd& Y) {
    check_motion(q, "q", q.rows(), joints);
    check_motion(dq, "dq", q.rows(), joints);
    check_motion(ddq, "ddq", q.rows(), joints);
    Y.resize(q.rows(), joints * size);
    const auto values = [](const MatrixXd& matrix) {
      return std::span<const double>(matrix.data(), static_cast<std::size_t>(matrix.size()));
    };
    evaluate(*program, static_cast<std::size_t>(q.rows()),
             {{"q", values(q)}, {"dq", values(dq)}, {"ddq", values(ddq)}},
             {{"Y", std::span<double>(Y.data(), static_cast<std::size_t>(Y.size()))}});
  };
}

/// Its gradient, on request: it costs more to write than the regressor.
void add_regressor_gradient(LinearModel& linear, CodeModel& code) {
  const RobotFunction function =
      write_plain_function(parse_function_name("base_regressor_gradient"), code);
  auto program = std::make_shared<const Program>(lower(function.trace));
  const Index joints = linear.joints(), size = linear.size();
  linear.regressor_gradient = [program, joints, size](const JointMotion& motion,
                                                      const MatrixXd& A) {
    const Index samples = motion.q.rows();
    check_motion(motion.q, "q", samples, joints);
    check_motion(motion.dq, "dq", samples, joints);
    check_motion(motion.ddq, "ddq", samples, joints);
    check_motion(A, "A", samples, joints * size);
    JointMotion gradient;
    for (MatrixXd* part : {&gradient.q, &gradient.dq, &gradient.ddq}) part->resize(samples, joints);
    const auto values = [](const MatrixXd& matrix) {
      return std::span<const double>(matrix.data(), static_cast<std::size_t>(matrix.size()));
    };
    const auto places = [](MatrixXd& matrix) {
      return std::span<double>(matrix.data(), static_cast<std::size_t>(matrix.size()));
    };
    evaluate(*program, static_cast<std::size_t>(samples),
             {{"q", values(motion.q)},
              {"dq", values(motion.dq)},
              {"ddq", values(motion.ddq)},
              {"A", values(A)}},
             {{"g_q", places(gradient.q)},
              {"g_dq", places(gradient.dq)},
              {"g_ddq", places(gradient.ddq)}});
    return gradient;
  };
}

}  // namespace

DescribedRobot describe_robot(const std::string& path, OpenParameters open,
                              const DescribeOptions& options) {
  return describe_robot(read_robot_file(path), open, options);
}

DescribedRobot describe_robot(RobotFile file, OpenParameters open, const DescribeOptions& options) {
  DescribedRobot robot;
  robot.file = std::move(file);
  refuse_unknown_geometry(robot.file);
  robot.model = opened(build_model(robot.file), open);
  robot.standard = standard_values(robot.model);

  const SymbolicRobot symbolic = make_symbolic(robot.model);
  const Regrouping base = regroup(symbolic);
  CodeModel code = make_code_model(
      base, base.parameters, {.parameters = ParameterMode::kRuntime, .weights = options.gradient});
  LinearModel& linear = robot.linear;
  linear.name = robot.model.name;
  linear.joint_names = code.coordinate_names;
  linear.revolute = code.coordinate_revolute;
  robot.grouping = grouping_matrix(symbolic, base.parameters);
  for (std::size_t i = 0; i < base.parameters.size(); ++i) {
    const GroupedParameter& grouped = base.parameters[i];
    LinearParameter parameter;
    parameter.name = grouped.name();
    parameter.unit = code.chi[i].unit;
    parameter.formula = formula_of(code.chi[i].comment, grouped);
    parameter.link = grouped.column.link;
    parameter.kind = kind_of(grouped.column.kind);
    parameter.value = file_value(grouped, symbolic);
    linear.parameters.push_back(std::move(parameter));
  }
  robot.places = choose_places(robot.grouping, base.parameters);
  add_regressor(linear, code);
  if (options.gradient) add_regressor_gradient(linear, code);
  return robot;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/described_robot.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
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
using Eigen::VectorXd;

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

/// The base parameters that are left where the file's zeros tie some of them together: beta =
/// combination * beta(kept).
struct IndependentParameters {
  std::vector<std::size_t> kept;
  MatrixXd combination;  ///< (nb x kept)
};

/// A base parameter whose standard parameters stand in others too, in the same ratio, is no unknown
/// of its own: of a link of which only YY is open, XXR2 = -YY2 and ZZR1 = YY2.
IndependentParameters independent_parameters(const MatrixXd& grouping) {
  constexpr double kDependent = 1e-10;  // of a row's norm; rounding leaves some 1e-16
  IndependentParameters result;
  MatrixXd basis(grouping.cols(), 0);  // orthonormal
  for (Index i = 0; i < grouping.rows(); ++i) {
    VectorXd rest = grouping.row(i).transpose();
    const double norm = rest.norm();
    for (int round = 0; round < 2; ++round) rest -= basis * (basis.transpose() * rest).eval();
    if (rest.norm() <= kDependent * norm) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = rest.normalized();
    result.kept.push_back(static_cast<std::size_t>(i));
  }
  if (result.kept.empty()) return result;
  const MatrixXd own = grouping(result.kept, Eigen::all).transpose();
  result.combination = own.colPivHouseholderQr().solve(grouping.transpose()).transpose();
  for (std::size_t k = 0; k < result.kept.size(); ++k) {
    result.combination.row(static_cast<Index>(result.kept[k])).setZero();
    result.combination(static_cast<Index>(result.kept[k]), static_cast<Index>(k)) = 1;
  }
  result.combination =
      (result.combination.array().abs() > kDependent).select(result.combination, 0.0);
  return result;
}

/// Which standard parameters rather carry base parameters: a first moment or an element of a tensor
/// may have any sign, a mass or a rotor inertia that is negative looks like a mistake.
int reluctance(Index place) {
  const Chi kind = static_cast<Chi>(place % kStandard);
  if (is_of_actuator(kind)) return 2;
  return kind == Chi::kM ? 1 : 0;
}

/// Columns of the grouping that carry the base parameters: a parameter's own place where it is one,
/// else chosen so that the system is well conditioned.
std::vector<Index> choose_places(const MatrixXd& grouping,
                                 const std::vector<GroupedParameter>& parameters) {
  constexpr double kWeak = 1e-3;  // of a pivot beside the largest: other columns say it better
  std::vector<Index> places;
  for (const GroupedParameter& parameter : parameters) {
    places.push_back(static_cast<Index>(index(parameter.column.kind)) +
                     Index{kStandard} * (parameter.column.link - 1));
  }
  if (places.empty() || grouping(Eigen::all, places).isIdentity(1e-12)) return places;
  places.clear();
  MatrixXd rest = grouping;
  for (int most = 0; most <= 3; ++most) {  // at last all columns, weak or not
    MatrixXd allowed = rest;
    for (Index c = 0; c < allowed.cols(); ++c) {
      if (reluctance(c) > most) allowed.col(c).setZero();
    }
    const Eigen::ColPivHouseholderQR<MatrixXd> pivoted(allowed);
    const Eigen::VectorXd pivots = pivoted.matrixQR().diagonal().cwiseAbs();
    const Index wanted = grouping.rows() - static_cast<Index>(places.size());
    Index taken = 0;
    while (taken < wanted && (most == 3 || pivots[taken] > kWeak * grouping.norm())) {
      places.push_back(pivoted.colsPermutation().indices()(taken++));
    }
    const MatrixXd Q = MatrixXd(pivoted.householderQ()).leftCols(taken);
    rest -= Q * (Q.transpose() * rest).eval();
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

/// Columns of the parameters that are left.
std::vector<std::vector<int>> combined(const std::vector<std::vector<int>>& columns,
                                       const MatrixXd& combination) {
  std::vector<std::vector<int>> result(columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (Index c = 0; c < combination.cols(); ++c) {
      const bool seen = std::any_of(columns[j].begin(), columns[j].end(),
                                    [&](int column) { return combination(column, c) != 0; });
      if (seen) result[j].push_back(static_cast<int>(c));
    }
  }
  return result;
}

/// Every joint's block of a matrix (N x n * from) times another one (from x to).
MatrixXd blocks_times(const MatrixXd& blocks, Index joints, const MatrixXd& factor) {
  MatrixXd result(blocks.rows(), joints * factor.cols());
  for (Index j = 0; j < joints; ++j) {
    result.middleCols(j * factor.cols(), factor.cols()) =
        blocks.middleCols(j * factor.rows(), factor.rows()) * factor;
  }
  return result;
}

/// The base regressor as a program that is evaluated over many samples.
/// @param combination  of the program's parameters from those of the model
void add_regressor(LinearModel& linear, CodeModel& code, const MatrixXd& combination) {
  const std::vector<RobotFunction> functions =
      write_functions({parse_function_name("base_regressor")}, code, {.patience = 0, .work = 0});
  auto program = std::make_shared<const Program>(lower(functions.front().trace));
  const Index joints = linear.joints(), size = combination.rows();
  linear.columns =
      combined(visible_columns(*program, linear.joints(), static_cast<int>(size)), combination);
  linear.regressor = [program, joints, size, combination](const MatrixXd& q, const MatrixXd& dq,
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
    if (combination.cols() != size) Y = blocks_times(Y, joints, combination);
  };
}

/// Its gradient, on request: it costs more to write than the regressor.
void add_regressor_gradient(LinearModel& linear, CodeModel& code, const MatrixXd& combination) {
  const RobotFunction function =
      write_plain_function(parse_function_name("base_regressor_gradient"), code);
  auto program = std::make_shared<const Program>(lower(function.trace));
  const Index joints = linear.joints(), size = combination.cols();
  linear.regressor_gradient = [program, joints, size, combination](const JointMotion& motion,
                                                                   const MatrixXd& weights) {
    const Index samples = motion.q.rows();
    check_motion(motion.q, "q", samples, joints);
    check_motion(motion.dq, "dq", samples, joints);
    check_motion(motion.ddq, "ddq", samples, joints);
    check_motion(weights, "A", samples, joints * size);
    const MatrixXd A = combination.rows() == size
                           ? weights
                           : blocks_times(weights, joints, combination.transpose());
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
  const MatrixXd grouping = grouping_matrix(symbolic, base.parameters);
  const IndependentParameters independent = independent_parameters(grouping);
  robot.grouping = grouping(independent.kept, Eigen::all);
  std::vector<GroupedParameter> parameters;
  for (const std::size_t i : independent.kept) {
    const GroupedParameter& grouped = base.parameters[i];
    LinearParameter parameter;
    parameter.name = grouped.name();
    parameter.unit = code.chi[i].unit;
    parameter.formula = formula_of(code.chi[i].comment, grouped);
    parameter.link = grouped.column.link;
    parameter.kind = kind_of(grouped.column.kind);
    parameter.value = file_value(grouped, symbolic);
    linear.parameters.push_back(std::move(parameter));
    parameters.push_back(grouped);
  }
  robot.places = choose_places(robot.grouping, parameters);
  add_regressor(linear, code, independent.combination);
  if (options.gradient) add_regressor_gradient(linear, code, independent.combination);
  return robot;
}

}  // namespace dyngen::runtime

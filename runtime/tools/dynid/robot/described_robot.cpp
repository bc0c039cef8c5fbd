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
#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"
#include "runtime/tools/dynid/robot/base_grouping.h"
#include "runtime/tools/dynid/robot/joint_words.h"

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

/// @param zeros_are_numbers  of bodies in a description that knows no structure: they are estimated
RobotModel opened(RobotModel model, OpenParameters open, bool zeros_are_numbers) {
  for (JointModel& joint : model.joints) {
    const bool moves = joint.type != JointType::kFixed;
    // what moves has a mass, also where nobody has written it down
    const bool body = zeros_are_numbers && open == OpenParameters::kAbsentRows &&
                      (moves || !joint.chi[index(Chi::kM)].known_zero());
    for (std::size_t k = 0; body && k < kInertialCount; ++k) joint.chi[k].open = true;
    const bool actuator = zeros_are_numbers && open != OpenParameters::kAsWritten && moves;
    for (const Chi kind : {Chi::kIA, Chi::kFV, Chi::kFS}) {
      Quantity& own = joint.chi[index(kind)];
      own.open = actuator && own.line != 0;
    }
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
  Diagnostics diagnostics(file.file_name, file.source_text);
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

/// What a base parameter is: a rotor's inertia also where it is alone in ZZR1.
ParameterKind kind_in(const GroupedParameter& parameter, const Eigen::RowVectorXd& row) {
  bool rotors = true;
  for (Index place = 0; place < row.size(); ++place) {
    rotors = rotors && (row[place] == 0 || static_cast<Chi>(place % kStandard) == Chi::kIA);
  }
  return rotors ? ParameterKind::kRotorInertia : kind_of(parameter.column.kind);
}

/// A base parameter that is one other parameter, as where held numbers or zeros leave IA1 alone in
/// ZZR1: "IA1", "0.25 * M3"; of more terms its own name.
std::string sum_of_few(const GroupedParameter& parameter, const Eigen::RowVectorXd& row) {
  if ((row.array() != 0).count() != 1) return parameter.name();
  Index place = 0;
  row.cwiseAbs().maxCoeff(&place);
  const std::string name =
      chi_name(static_cast<Chi>(place % kStandard), static_cast<int>(place / kStandard) + 1);
  return row[place] == 1 ? name : fmt::format("{:.6g} * {}", row[place], name);
}

/// "ZZ2 + IA2 + ...", or what the parameter is where nothing is grouped into it.
std::string formula_of(const RobotModel& model, const std::string& comment,
                       const GroupedParameter& parameter, const Eigen::RowVectorXd& row) {
  if (comment.starts_with("= ")) return comment.substr(2);
  const int link = parameter.column.link;
  switch (parameter.column.kind) {
    case Chi::kIA:
      return "rotor inertia of " + joint_words(model, link);
    case Chi::kFV:
      return "viscous friction of " + joint_words(model, link);
    case Chi::kFS:
      return "Coulomb friction of " + joint_words(model, link);
    case Chi::kOFF:
      return "torque offset of " + joint_words(model, link);
    default:
      return sum_of_few(parameter, row);
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
  if (combination.rows() == 0) {  // nothing that torque depends on
    linear.columns.resize(static_cast<std::size_t>(linear.joints()));
    linear.regressor = [](const MatrixXd& q, const MatrixXd&, const MatrixXd&, MatrixXd& Y) {
      Y.resize(q.rows(), 0);
    };
    return;
  }
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

/// The model with zeros for what is held, or for everything else.
RobotModel with_zeros(RobotModel model, const HeldNumbers& held, bool of_held) {
  for (std::size_t i = 0; i < held.places.size(); ++i) {
    if (held.places[i] != of_held) continue;
    Quantity& quantity = model.joints[i / kChiCount].chi[i % kChiCount];
    quantity.unknown = false;
    quantity.value = 0;
  }
  return model;
}

/// The linear model of what a robot has besides zeros, its grouping and places.
void add_linear_model(const RobotModel& model, const DescribeOptions& options,
                      DescribedRobot& robot) {
  const SymbolicRobot symbolic = make_symbolic(model);
  const Regrouping base = regroup(symbolic);
  CodeModel code = make_code_model(
      base, base.parameters, {.parameters = ParameterMode::kRuntime, .weights = options.gradient});
  LinearModel& linear = robot.linear;
  linear.name = model.name;
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
    parameter.formula =
        formula_of(model, code.chi[i].comment, grouped, grouping.row(static_cast<Index>(i)));
    parameter.link = grouped.column.link;
    parameter.kind = kind_in(grouped, grouping.row(static_cast<Index>(i)));
    parameter.value = file_value(grouped, symbolic);
    linear.parameters.push_back(std::move(parameter));
    parameters.push_back(grouped);
  }
  robot.places = choose_places(robot.grouping, parameters);
  add_regressor(linear, code, independent.combination);
  if (options.gradient && linear.size() > 0) {
    add_regressor_gradient(linear, code, independent.combination);
  }
}

/// What held numbers do, by a robot of them alone.
std::shared_ptr<const HeldParameters> held_parameters(const DescribedRobot& robot) {
  const std::shared_ptr<const DescribedRobot> alone = robot.held_alone;
  StandardParameters inertial = robot.held_values;
  HeldParameters held;
  held.coulomb = held.viscous = held.rotor = VectorXd::Zero(robot.linear.joints());
  for (Index i = 0; i < inertial.size(); ++i) {
    const Chi kind = static_cast<Chi>(i % kStandard);
    const int joint = robot.model.joint(static_cast<int>(i / kStandard) + 1).coordinate;
    if (!is_of_actuator(kind)) continue;
    if (joint >= 0 && kind == Chi::kFS) held.coulomb[joint] = inertial[i];
    if (joint >= 0 && kind == Chi::kFV) held.viscous[joint] = inertial[i];
    if (joint >= 0 && kind == Chi::kIA) held.rotor[joint] = inertial[i];
    inertial[i] = 0;
  }
  held.torque = [alone, all = VectorXd(alone->grouping * robot.held_values),
                 inertial = VectorXd(alone->grouping * inertial)](
                    const MatrixXd& q, const MatrixXd& dq, const MatrixXd& ddq,
                    bool inertial_only) {
    return alone->linear.torque(q, dq, ddq, inertial_only ? inertial : all);
  };
  return std::make_shared<const HeldParameters>(std::move(held));
}

/// Says at each parameter whose columns some held numbers have too: an error of the number is then
/// an error of the parameter.
void name_aliases(DescribedRobot& robot) {
  constexpr double kAlias = 1e-9;  // of a column's norm
  const SymbolicRobot symbolic = make_symbolic(robot.model);
  const MatrixXd all = grouping_matrix(symbolic, regroup(symbolic).parameters);
  std::vector<Index> open;
  for (Index c = 0; c < all.cols(); ++c) {
    if (!robot.held.places[static_cast<std::size_t>(c)]) open.push_back(c);
  }
  const MatrixXd columns = all(Eigen::all, open);
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(columns);
  std::vector<std::string> beside(static_cast<std::size_t>(robot.grouping.rows()));
  std::size_t name = 0;
  for (std::size_t i = 0; i < robot.held.places.size(); ++i) {
    if (!robot.held.places[i]) continue;
    const std::string& own = robot.held.names[name++];
    const VectorXd column = all.col(static_cast<Index>(i));
    const VectorXd x = solver.solve(column);
    if (column.isZero(0) || (columns * x - column).norm() > kAlias * column.norm()) continue;
    const VectorXd moved = robot.grouping(Eigen::all, open) * x;
    for (Index b = 0; b < moved.size(); ++b) {
      if (std::abs(moved[b]) > kAlias * (1 + moved.norm())) {
        beside[static_cast<std::size_t>(b)] += " " + own;
      }
    }
  }
  for (std::size_t b = 0; b < beside.size(); ++b) {
    if (!beside[b].empty()) robot.linear.parameters[b].formula += "; beside held" + beside[b];
  }
}

}  // namespace

DescribedRobot describe_robot(const RobotSource& source, OpenParameters open,
                              const DescribeOptions& options) {
  return describe_robot(read_robot_file(source), open, options);
}

DescribedRobot describe_robot(RobotFile file, OpenParameters open, const DescribeOptions& options) {
  DescribedRobot robot;
  robot.file = std::move(file);
  refuse_unknown_geometry(robot.file);
  const RobotModel written = build_model(robot.file);
  robot.model = opened(written, open, !robot.file.made_of.empty());
  robot.standard = standard_values(robot.model);
  robot.held = held_numbers(written, options.hold);
  robot.held_values = StandardParameters::Zero(robot.standard.size());
  if (!robot.held.any()) {
    add_linear_model(robot.model, options, robot);
    return robot;
  }
  for (Index i = 0; i < robot.standard.size(); ++i) {
    if (robot.held.places[static_cast<std::size_t>(i)]) robot.held_values[i] = robot.standard[i];
  }
  add_linear_model(with_zeros(robot.model, robot.held, true), options, robot);
  DescribedRobot alone;
  add_linear_model(with_zeros(written, robot.held, false), {}, alone);
  robot.held_alone = std::make_shared<const DescribedRobot>(std::move(alone));
  robot.linear.held = held_parameters(robot);
  name_aliases(robot);
  return robot;
}

void refuse_without_parameters(const DescribedRobot& robot) {
  if (robot.linear.size() > 0) return;
  throw ModelError(fmt::format(
      "{}: error: no dynamic parameter is left to estimate: {}\n", robot.file.file_name,
      robot.held.any() ? "all others are zero, or are seen in no torque. Hold fewer numbers: "
                         "--hold links=1,2 leaves IA, Fs, Fv and off open"
                       : "all are zero, or are seen in no torque. Write '*' for those that are "
                         "unknown"));
}

}  // namespace dyngen::runtime

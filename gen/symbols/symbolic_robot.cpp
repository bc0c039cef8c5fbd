// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/symbols/symbolic_robot.h"

#include <algorithm>
#include <utility>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;
using Inertial = std::array<ex, kInertialCount>;
using Matrix = std::array<std::array<ex, 3>, 3>;
using Vector = std::array<ex, 3>;

Matrix tensor(const Inertial& p) {
  return {{{p[0], p[1], p[2]}, {p[1], p[3], p[4]}, {p[2], p[4], p[5]}}};
}

/// Rx(alpha) Rz(theta), columns are the child's axes in the parent's frame.
Matrix rotation(const ex& alpha, const ex& theta) {
  const ex ca = exact_cos(alpha), sa = exact_sin(alpha);
  const ex c = exact_cos(theta), s = exact_sin(theta);
  return {{{c, -s, 0}, {ca * s, ca * c, -sa}, {sa * s, sa * c, ca}}};
}

ex length_symbol(const Quantity& quantity, const std::string& name, const std::string& unit,
                 SymbolicRobot& robot) {
  if (!quantity.unknown) return rational_or_float(quantity.value);
  FileSymbol entry;
  entry.symbol = GiNaC::symbol(name);
  entry.name = name;
  entry.unit = unit;
  entry.line = quantity.line;
  robot.geometry.push_back(entry);
  return entry.symbol;
}

std::array<ex, kChiCount> parameter_symbols(const JointModel& joint, int j, SymbolicRobot& robot) {
  std::array<ex, kChiCount> chi;
  chi.fill(0);
  for (std::size_t k = 0; k < kChiCount; ++k) {
    const Quantity& quantity = joint.chi[k];
    if (quantity.known_zero()) continue;
    const Chi kind = static_cast<Chi>(k);
    FileSymbol entry;
    entry.name = chi_name(kind, j);
    entry.symbol = GiNaC::symbol(entry.name);
    entry.unit = chi_unit(kind, joint.type != JointType::kPrismatic);
    entry.known = !quantity.unknown;
    entry.value = rational_or_float(quantity.value);
    entry.line = quantity.line;
    chi[k] = entry.symbol;
    robot.parameters.push_back(std::move(entry));
  }
  return chi;
}

/// Rows of a standard table become modified rows: alpha and d come from the row of the parent.
void reframe(SymbolicRobot& robot) {
  const std::vector<SymbolicLink> standard = robot.links;
  for (SymbolicLink& link : robot.links) {
    Inertial distal;
    std::copy_n(link.chi.begin(), kInertialCount, distal.begin());
    const Inertial moved = move_to_parent(distal, link.alpha, link.d, 0, 0);
    std::copy(moved.begin(), moved.end(), link.chi.begin());
    link.tip_alpha = link.alpha;
    link.tip_d = link.d;
    link.tip_line = link.d_line;
  }
  for (SymbolicLink& link : robot.links) {
    const bool on_base = link.parent == 0;
    const std::size_t parent = static_cast<std::size_t>(on_base ? 0 : link.parent - 1);
    link.alpha = on_base ? ex(0) : standard[parent].alpha;
    link.d = on_base ? ex(0) : standard[parent].d;
    link.d_line = on_base ? 0 : standard[parent].d_line;
  }
}

}  // namespace

Inertial move_to_parent(const Inertial& inertial, const ex& alpha, const ex& d, const ex& theta,
                        const ex& r) {
  const Matrix R = rotation(alpha, theta);
  const Vector p = {d, -r * exact_sin(alpha), r * exact_cos(alpha)};
  const Matrix J = tensor(inertial);
  const ex& mass = inertial[index(Chi::kM)];
  Vector s;  // first moments in the axes of the parent, about the child's origin
  for (std::size_t i = 0; i < 3; ++i) {
    s[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) s[i] += R[i][k] * inertial[index(Chi::kMX) + k];
  }
  ex sp = 0, pp = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sp += s[i] * p[i];
    pp += p[i] * p[i];
  }
  // J' = R J R^T + 2 (s.p) 1 - s p^T - p s^T + M (p.p 1 - p p^T)
  const auto element = [&](std::size_t i, std::size_t k) {
    ex sum = -s[i] * p[k] - p[i] * s[k] - mass * p[i] * p[k];
    if (i == k) sum += 2 * sp + mass * pp;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) sum += R[i][a] * J[a][b] * R[k][b];
    }
    return drop_rounding(sum);
  };
  Inertial result = {element(0, 0), element(0, 1), element(0, 2),
                     element(1, 1), element(1, 2), element(2, 2)};
  for (std::size_t i = 0; i < 3; ++i) {
    result[index(Chi::kMX) + i] = drop_rounding(s[i] + mass * p[i]);
  }
  result[index(Chi::kM)] = mass;
  return result;
}

SymbolicRobot make_symbolic(const RobotModel& model) {
  SymbolicRobot robot;
  robot.name = model.name;
  robot.file_name = model.file_name;
  robot.coordinate_count = model.coordinate_count;
  for (int j = 1; j <= model.size(); ++j) {
    const JointModel& joint = model.joint(j);
    SymbolicLink link;
    link.type = joint.type;
    link.parent = joint.parent;
    link.alpha = joint.alpha;
    link.theta = joint.theta;
    link.d = length_symbol(joint.d, "d" + std::to_string(j), "m", robot);
    link.r = length_symbol(joint.r, "r" + std::to_string(j), "m", robot);
    link.d_line = joint.d.line;
    link.r_line = joint.r.line;
    link.chi = parameter_symbols(joint, j, robot);
    link.name = joint.name;
    link.coordinate = joint.coordinate;
    robot.links.push_back(std::move(link));
  }
  const std::array<std::string, 3> names = {"gx", "gy", "gz"};
  for (std::size_t k = 0; k < 3; ++k) {
    robot.gravity[k] = length_symbol(model.gravity[k], names[k], "m/s^2", robot);
    robot.gravity_lines[k] = model.gravity[k].line;
  }
  if (model.convention == DhConvention::kStandard) reframe(robot);
  return robot;
}

ex with_known_values(const ex& expression, const SymbolicRobot& robot) {
  GiNaC::exmap values;
  for (const FileSymbol& entry : robot.parameters) {
    if (entry.known) values[entry.symbol] = entry.value;
  }
  return drop_rounding(expression.subs(values, GiNaC::subs_options::no_pattern));
}

}  // namespace dyngen

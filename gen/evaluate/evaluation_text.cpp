// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/evaluate/evaluation_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

constexpr std::size_t kLabelWidth = 14;   // columns
constexpr std::size_t kColumnWidth = 13;  // of a number with six digits, a sign and an exponent
constexpr std::size_t kTableColumns = 5;  // with the label in 80 columns
// What is this much smaller than the largest number of its table is rounding of 15 digits.
constexpr double kRoundingShare = 1e-14;

/// A row of a table of joints: one value per moving joint.
struct TableRow {
  std::string label;
  std::vector<double> values;
};

std::string cut_name(const std::string& name, std::size_t width) {
  return name.size() <= width ? name : name.substr(0, width - 1) + "~";
}

double largest_of(const std::vector<TableRow>& rows) {
  double largest = 0;
  for (const TableRow& row : rows) {
    for (const double value : row.values) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// Columns are joints, so many in one table as there is room for.
std::string joint_table(const std::vector<std::string>& names, const std::vector<TableRow>& rows,
                        bool hide_rounding) {
  const double rounding = hide_rounding ? kRoundingShare * largest_of(rows) : 0;
  std::string text;
  for (std::size_t first = 0; first < names.size(); first += kTableColumns) {
    const std::size_t end = std::min(first + kTableColumns, names.size());
    if (first > 0) text += "\n";
    text += fmt::format("{:<{}}", "", kLabelWidth);
    for (std::size_t k = first; k < end; ++k) {
      text += fmt::format("{:>{}}", cut_name(names[k], kColumnWidth - 1), kColumnWidth);
    }
    text += "\n";
    for (const TableRow& row : rows) {
      text += fmt::format("{:<{}}", cut_name(row.label, kLabelWidth - 1), kLabelWidth);
      for (std::size_t k = first; k < end; ++k) {
        const double value = std::abs(row.values[k]) <= rounding ? 0.0 : row.values[k];
        text += fmt::format("{:>{}.6g}", value, kColumnWidth);
      }
      text += "\n";
    }
  }
  return text;
}

/// " (N m, N where a joint slides)"
std::string mixed_unit(const CodeModel& code, const std::string& revolute,
                       const std::string& prismatic) {
  const auto& turns = code.coordinate_revolute;
  const bool any_turns = std::find(turns.begin(), turns.end(), true) != turns.end();
  const bool any_slides = std::find(turns.begin(), turns.end(), false) != turns.end();
  if (!any_slides) return revolute;
  if (!any_turns) return prismatic;
  return fmt::format("{}; {} where a joint slides", revolute, prismatic);
}

/// Fixed rotations about x, y, z of frame 0, in this order: the angles of URDF.
std::array<double, 3> roll_pitch_yaw(const std::vector<double>& T) {
  const double across = std::hypot(T[0], T[4]);
  // where x points along z of frame 0 only the sum of roll and yaw is known: roll takes it
  constexpr double kAlongZ = 1e-9;
  if (across < kAlongZ) return {std::atan2(-T[6], T[5]), std::atan2(-T[8], across), 0.0};
  return {std::atan2(T[9], T[10]), std::atan2(-T[8], across), std::atan2(T[4], T[0])};
}

/// In a table of fixed digits -0 would stand for what rounds to 0.
double without_minus_zero(double value, int digits) {
  const double unit = std::pow(10.0, -digits);
  return std::abs(value) < 0.5 * unit ? 0.0 : value;
}

std::string pose_table(RobotNumbers& robot, const MotionArrays& motion) {
  constexpr int kDigits = 6, kMatrixDigits = 9;
  std::string text = fmt::format(
      "\nFrames of the links in frame 0 (m; fixed angles about x, y, z in rad)\n"
      "{:<14}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n",
      "", "x", "y", "z", "roll", "pitch", "yaw");
  std::vector<double> last;
  for (int j = 1; j <= robot.model().size(); ++j) {
    last = robot.run(fmt::format("fk_{}", j), motion);
    text +=
        fmt::format("{:<14}", cut_name(fmt::format("{} {}", j, robot.model().joint(j).name), 13));
    for (const std::size_t k : {3U, 7U, 11U}) {
      text += fmt::format("{:>11.6f}", without_minus_zero(last[k], kDigits));
    }
    for (const double angle : roll_pitch_yaw(last)) {
      text += fmt::format("{:>11.6f}", without_minus_zero(angle, kDigits));
    }
    text += "\n";
  }
  text += "\nPose of the last frame\n";
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      text += fmt::format("{:>15.9f}", without_minus_zero(last[4 * row + column], kMatrixDigits));
    }
    text += "\n";
  }
  return text;
}

struct TorqueParts {
  std::vector<TableRow> rows;  ///< the total first
};

TorqueParts torque_parts(RobotNumbers& robot, const StateRequest& state, const MotionArrays& motion,
                         const std::vector<double>& M) {
  const std::size_t n = robot.joints();
  const std::vector<double> zero(n, 0.0);
  TorqueParts parts;
  parts.rows = {{"torque", robot.run("id", motion)},
                {"rigid inertia", zero},
                {"Coriolis", robot.run("coriolis", motion)},
                {"gravity", robot.run("gravity", motion)},
                {"rotor inertia", zero},
                {"viscous", zero},
                {"Coulomb", zero},
                {"offset", zero}};
  enum : std::size_t { kInertia = 1, kRotor = 4, kViscous, kCoulomb, kOffset };
  for (int j = 1; j <= robot.model().size(); ++j) {
    const int coordinate = robot.model().joint(j).coordinate;
    if (coordinate < 0) continue;
    const auto i = static_cast<std::size_t>(coordinate);
    const double rotor = robot.parameter(j, Chi::kIA);
    double inertia = 0;
    for (std::size_t k = 0; k < n; ++k) {
      inertia += (M[i * n + k] - (i == k ? rotor : 0)) * state.ddq[k];
    }
    parts.rows[kInertia].values[i] = inertia;
    parts.rows[kRotor].values[i] = rotor * state.ddq[i];
    parts.rows[kViscous].values[i] = robot.parameter(j, Chi::kFV) * state.dq[i];
    const double sign = state.dq[i] > 0 ? 1 : state.dq[i] < 0 ? -1 : 0;
    parts.rows[kCoulomb].values[i] = robot.parameter(j, Chi::kFS) * sign;
    parts.rows[kOffset].values[i] = robot.parameter(j, Chi::kOFF);
  }
  if (robot.has("effects")) parts.rows.push_back({"effects", robot.run("effects", motion)});
  return parts;
}

/// "joint 2 shoulder: q = 3.2 is above qmax = 2.1"
void add_limit(std::string& text, const RobotModel& model, int j, const std::string& quantity,
               double value, const std::string& limit, double bound, bool above) {
  text += fmt::format("  joint {} {}: {} = {:.6g} is {} {} = {:.6g}\n", j, model.joint(j).name,
                      quantity, value, above ? "above" : "below", limit, bound);
}

std::string limits_text(const RobotModel& model, const RobotFile& file, const StateRequest& state,
                        const std::vector<double>& torque) {
  std::string text;
  for (int j = 1; j <= model.size(); ++j) {
    const JointModel& joint = model.joint(j);
    if (joint.coordinate < 0) continue;
    const auto i = static_cast<std::size_t>(joint.coordinate);
    const auto magnitude = [&](const std::string& quantity, double value, RowKey key) {
      const Row& row = file.row(key);
      if (!row.present || row.values.size() < static_cast<std::size_t>(j)) return;
      const double bound = to_double(row.values[static_cast<std::size_t>(j - 1)].value);
      if (std::abs(value) <= bound) return;
      add_limit(text, model, j, fmt::format("|{}|", quantity), std::abs(value),
                std::string(row_keyword(key)), bound, true);
    };
    if (joint.qmax && state.q[i] > to_double(*joint.qmax)) {
      add_limit(text, model, j, "q", state.q[i], "qmax", to_double(*joint.qmax), true);
    }
    if (joint.qmin && state.q[i] < to_double(*joint.qmin)) {
      add_limit(text, model, j, "q", state.q[i], "qmin", to_double(*joint.qmin), false);
    }
    magnitude("dq", state.dq[i], RowKey::kVmax);
    magnitude("ddq", state.ddq[i], RowKey::kAmax);
    magnitude("torque", torque[i], RowKey::kTaumax);
  }
  return text.empty() ? text : "\nBeyond the limits of the file\n" + text;
}

}  // namespace

std::string evaluation_text(RobotNumbers& robot, const RobotFile& file, const StateRequest& state) {
  const CodeModel& code = robot.code();
  const MotionArrays motion = {1, state.q, state.dq, state.ddq};
  const std::vector<double> M = robot.run("mass_matrix", motion);
  const TorqueParts parts = torque_parts(robot, state, motion, M);
  const std::vector<std::string>& names = code.coordinate_names;
  const std::size_t n = robot.joints();

  std::string text = fmt::format("{}: state ({})\n", robot.model().name,
                                 mixed_unit(code, "rad, rad/s, rad/s^2", "m, m/s, m/s^2"));
  text += joint_table(names, {{"q", state.q}, {"dq", state.dq}, {"ddq", state.ddq}}, false);
  text += fmt::format("\nTorque and its parts ({})\n", mixed_unit(code, "N m", "N"));
  text += joint_table(names, parts.rows, true);
  if (!code.memory.empty()) text += "Effects with states are taken as they start.\n";
  text += limits_text(robot.model(), file, state, parts.rows[0].values);
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = M.begin() + static_cast<std::ptrdiff_t>(i * n);
    rows.push_back({names[i], {row, row + static_cast<std::ptrdiff_t>(n)}});
  }
  text += fmt::format("\nMass matrix with rotor inertia ({})\n",
                      mixed_unit(code, "kg m^2", "kg m, kg"));
  text += joint_table(names, rows, true);
  return text + pose_table(robot, motion);
}

}  // namespace dyngen

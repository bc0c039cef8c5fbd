// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/identified_file.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "gen/diagnostic/diagnostic.h"
#include "gen/robot_file/keywords.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/tools/dynid/robot/robot_text.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

/// Keyword rows in the order in which they are written, and their places in chi.
struct ParameterRow {
  RowKey key;
  Chi kind;
};
constexpr std::array<ParameterRow, kChiCount> kRows = {{{RowKey::kM, Chi::kM},
                                                        {RowKey::kMX, Chi::kMX},
                                                        {RowKey::kMY, Chi::kMY},
                                                        {RowKey::kMZ, Chi::kMZ},
                                                        {RowKey::kXX, Chi::kXX},
                                                        {RowKey::kXY, Chi::kXY},
                                                        {RowKey::kXZ, Chi::kXZ},
                                                        {RowKey::kYY, Chi::kYY},
                                                        {RowKey::kYZ, Chi::kYZ},
                                                        {RowKey::kZZ, Chi::kZZ},
                                                        {RowKey::kIA, Chi::kIA},
                                                        {RowKey::kFs, Chi::kFS},
                                                        {RowKey::kFv, Chi::kFV},
                                                        {RowKey::kOff, Chi::kOFF}}};

std::string row_text(const ParameterRow& row, const StandardParameters& standard, int links) {
  std::string text = fmt::format("{:<10}", row_keyword(row.key));
  for (int link = 1; link <= links; ++link) {
    const double value =
        standard[static_cast<Index>(index(row.kind)) + static_cast<Index>(kChiCount) * (link - 1)];
    text += fmt::format(" {:>16}", value == 0 ? "0" : fmt::format("{}", value));
  }
  return text;
}

bool is_zero(const ParameterRow& row, const StandardParameters& standard, int links) {
  for (int link = 1; link <= links; ++link) {
    if (standard[static_cast<Index>(index(row.kind)) +
                 static_cast<Index>(kChiCount) * (link - 1)] != 0) {
      return false;
    }
  }
  return true;
}

/// CAD rows too: their numbers are in the others.
bool is_dynamic(RowKey key) {
  return is_cad_row(key) || std::any_of(kRows.begin(), kRows.end(),
                                        [&](const ParameterRow& row) { return row.key == key; });
}

}  // namespace

StandardParameters carried(const DescribedRobot& robot, const Eigen::VectorXd& beta) {
  const Eigen::MatrixXd own = robot.grouping(Eigen::all, robot.places);
  const Eigen::VectorXd values = own.isIdentity(1e-12) ? beta : own.fullPivLu().solve(beta).eval();
  StandardParameters standard = StandardParameters::Zero(robot.grouping.cols());
  for (std::size_t i = 0; i < robot.places.size(); ++i) {
    standard[robot.places[i]] = values[static_cast<Index>(i)];
  }
  return standard + robot.held_values;
}

std::vector<Index> joined_rotors(const DescribedRobot& robot) {
  std::vector<Index> places;
  for (int j = 1; j <= robot.model.size(); ++j) {
    const JointModel& joint = robot.model.joint(j);
    if (joint.coordinate < 0 || joint.chi[index(Chi::kIA)].unknown) continue;
    if (parameter_of(robot.linear, joint.coordinate, ParameterKind::kRotorInertia) >= 0) continue;
    const Index place =
        static_cast<Index>(index(Chi::kIA)) + static_cast<Index>(kChiCount) * (j - 1);
    const bool held = robot.held.any() && robot.held.places[static_cast<std::size_t>(place)];
    if (!held) places.push_back(place);
  }
  return places;
}

StandardParameters carried_beside_rotors(const DescribedRobot& robot, const Eigen::VectorXd& beta) {
  StandardParameters standard = StandardParameters::Zero(robot.grouping.cols());
  for (const Index place : joined_rotors(robot)) standard[place] = robot.standard[place];
  return standard + carried(robot, beta - robot.grouping * standard);
}

StandardParameters nearest_standard(const DescribedRobot& robot, const Eigen::VectorXd& beta) {
  if (!robot.standard.allFinite()) return carried_beside_rotors(robot, beta);
  if (beta.size() == 0) return robot.standard;
  Eigen::MatrixXd free = robot.grouping;
  for (const Index place : joined_rotors(robot)) free.col(place).setZero();
  // the grouping has nothing of what is held, which stays the file's
  const Eigen::VectorXd rest = beta - robot.grouping * robot.standard;
  return robot.standard + Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(free).solve(rest);
}

std::string identified_text(const DescribedRobot& robot, const StandardParameters& standard,
                            const IdentifiedRows& rows) {
  const int links = robot.model.size();
  RobotTextChange change;
  change.removed = [](const RowText& row) {
    return row.statement == Statement::kParameters ||
           (row.statement == Statement::kValues && is_dynamic(row.key));
  };
  change.effects = rows.effects;
  for (const std::string& line : rows.comment) {
    change.added.push_back(line.empty() ? "#" : "# " + line);
  }
  if (rows.meaning == ParameterMeaning::kBase) change.added.emplace_back("parameters base");
  for (const ParameterRow& row : kRows) {
    if (robot.file.row(row.key).present || !is_zero(row, standard, links)) {
      change.added.push_back(row_text(row, standard, links));
    }
  }
  change.added.insert(change.added.end(), rows.added.begin(), rows.added.end());
  return changed_text(robot.file, change);
}

std::string text_with_rows(const RobotFile& file, const std::vector<std::string>& rows) {
  RobotTextChange change;
  change.added = rows;
  return changed_text(file, change);
}

void write_robot_files(const std::vector<OutputFile>& files) {
  for (const OutputFile& file : files) {
    try {
      build_model(parse_robot_file(file.content, file.path));
    } catch (const ModelError& error) {
      throw std::logic_error(
          fmt::format("the robot file that was to be written cannot be read:\n{}", error.what()));
    }
  }
  write_files(files);
}

}  // namespace dyngen::runtime

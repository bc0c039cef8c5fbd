// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/robot/identified_file.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cctype>
#include <map>
#include <sstream>

#include "runtime/effects/effect_recordings.h"

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

std::string row_text(const ParameterRow& row, const StandardParameters& standard, int links,
                     bool exact) {
  std::string text = fmt::format("{:<10}", row_keyword(row.key));
  for (int link = 1; link <= links; ++link) {
    const double value =
        standard[static_cast<Index>(index(row.kind)) + static_cast<Index>(kChiCount) * (link - 1)];
    const std::string number = exact ? fmt::format("{}", value) : fmt::format("{:.12g}", value);
    text += fmt::format(" {:>16}", value == 0 ? "0" : number);
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

/// The keyword of a line, in small letters.
std::string keyword_of(const std::string& line) {
  std::istringstream words(line);
  std::string first;
  words >> first;
  for (char& c : first) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return first;
}

}  // namespace

StandardParameters carried(const DescribedRobot& robot, const Eigen::VectorXd& beta) {
  const Eigen::MatrixXd own = robot.grouping(Eigen::all, robot.places);
  const Eigen::VectorXd values = own.isIdentity(1e-12) ? beta : own.fullPivLu().solve(beta).eval();
  StandardParameters standard = StandardParameters::Zero(robot.grouping.cols());
  for (std::size_t i = 0; i < robot.places.size(); ++i) {
    standard[robot.places[i]] = values[static_cast<Index>(i)];
  }
  return standard;
}

std::vector<Index> joined_rotors(const DescribedRobot& robot) {
  std::vector<Index> places;
  for (int j = 1; j <= robot.model.size(); ++j) {
    const JointModel& joint = robot.model.joint(j);
    if (joint.coordinate < 0 || joint.chi[index(Chi::kIA)].unknown) continue;
    if (parameter_of(robot.linear, joint.coordinate, ParameterKind::kRotorInertia) >= 0) continue;
    places.push_back(static_cast<Index>(index(Chi::kIA)) + static_cast<Index>(kChiCount) * (j - 1));
  }
  return places;
}

StandardParameters nearest_standard(const DescribedRobot& robot, const Eigen::VectorXd& beta) {
  const std::vector<Index> rotors = joined_rotors(robot);
  if (!robot.standard.allFinite()) {
    StandardParameters standard = StandardParameters::Zero(robot.grouping.cols());
    for (const Index place : rotors) standard[place] = robot.standard[place];
    return standard + carried(robot, beta - robot.grouping * standard);
  }
  Eigen::MatrixXd free = robot.grouping;
  for (const Index place : rotors) free.col(place).setZero();
  const Eigen::VectorXd rest = beta - robot.grouping * robot.standard;
  return robot.standard + Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(free).solve(rest);
}

std::string identified_text(const DescribedRobot& robot, const StandardParameters& standard,
                            const IdentifiedRows& rows) {
  const int links = robot.model.size();
  std::map<int, bool> old_rows;  // lines of the original that are left out
  int last = 0;
  for (const ParameterRow& row : kRows) {
    const Row& original = robot.file.row(row.key);
    if (!original.present) continue;
    old_rows[original.keyword.line] = true;
    last = std::max(last, original.keyword.line);
  }
  std::map<int, std::string> new_rows;  // lines of effects
  for (std::size_t i = 0; i < rows.effects.size(); ++i) {
    new_rows[robot.file.effects[i].position.line] = rows.effects[i];
  }
  std::string parameters;
  for (const std::string& line : rows.comment)
    parameters += line.empty() ? "#\n" : "# " + line + "\n";
  for (const ParameterRow& row : kRows) {
    if (robot.file.row(row.key).present || !is_zero(row, standard, links)) {
      parameters += row_text(row, standard, links, rows.exact) + "\n";
    }
  }
  for (const std::string& row : rows.added) parameters += row + "\n";
  std::istringstream original(robot.file.text);
  std::string text;
  bool written = false;
  int number = 0;
  for (std::string line; std::getline(original, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!written && (keyword_of(line) == "stop" || (last != 0 && number > last))) {
      text += parameters;
      written = true;
    }
    if (old_rows.contains(number)) continue;
    const auto effect = new_rows.find(number);
    text += (effect != new_rows.end() ? effect->second : line) + "\n";
  }
  if (!written) text += parameters;
  return text;
}

std::string text_with_rows(const RobotFile& file, const std::vector<std::string>& rows) {
  std::string added;
  for (const std::string& row : rows) added += row + "\n";
  std::istringstream original(file.text);
  std::string text;
  bool written = false;
  for (std::string line; std::getline(original, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!written && keyword_of(line) == "stop") {
      text += added;
      written = true;
    }
    text += line + "\n";
  }
  return written ? text : text + added;
}

}  // namespace dyngen::runtime

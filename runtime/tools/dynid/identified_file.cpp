// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/identified_file.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <map>
#include <sstream>

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
    text += fmt::format(" {:>16}", value == 0 ? "0" : fmt::format("{:.12g}", value));
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

std::string identified_text(const DescribedRobot& robot, const StandardParameters& standard,
                            const std::vector<std::string>& comment,
                            const std::vector<std::string>& effects) {
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
  for (std::size_t i = 0; i < effects.size(); ++i) {
    new_rows[robot.file.effects[i].position.line] = effects[i];
  }
  std::string parameters;
  for (const std::string& line : comment) parameters += line.empty() ? "#\n" : "# " + line + "\n";
  for (const ParameterRow& row : kRows) {
    if (robot.file.row(row.key).present || !is_zero(row, standard, links)) {
      parameters += row_text(row, standard, links) + "\n";
    }
  }
  std::istringstream original(robot.file.text);
  std::string text;
  bool written = false;
  int number = 0;
  for (std::string line; std::getline(original, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::istringstream words(line);
    std::string first;
    words >> first;
    for (char& c : first) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!written && (first == "stop" || (last != 0 && number > last))) {
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

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "tests/blind/real/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::stringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  if (!words.empty() && !words.back().empty() && words.back().back() == '\r') {
    words.back().pop_back();
  }
  return words;
}

}  // namespace

Table Table::read(const std::string& path) {
  std::ifstream file(path);
  Table table;
  table.path_ = path;
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path + ": cannot be read, or is empty");
  table.names_ = split(line);
  while (std::getline(file, line)) {
    table.cells_.push_back(split(line));
    if (table.cells_.back().size() != table.names_.size()) {
      throw std::runtime_error(fmt::format("{}:{}: found {} values, expected {}", path,
                                           table.cells_.size() + 1, table.cells_.back().size(),
                                           table.names_.size()));
    }
  }
  if (table.joints() == 0) throw std::runtime_error(path + ": there is no column tau1");
  return table;
}

void Table::write(const std::string& path) const {
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished);
  file << fmt::format("{}\n", fmt::join(names_, ","));
  for (const auto& row : cells_) file << fmt::format("{}\n", fmt::join(row, ","));
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  std::filesystem::rename(unfinished, path);
}

int Table::joints() const {
  int count = 0;
  while (std::find(names_.begin(), names_.end(), fmt::format("tau{}", count + 1)) != names_.end()) {
    ++count;
  }
  return count;
}

std::size_t Table::place(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) throw std::runtime_error(path_ + ": there is no column " + name);
  return static_cast<std::size_t>(found - names_.begin());
}

VectorXd Table::column(const std::string& name) const {
  const std::size_t at = place(name);
  VectorXd values(rows());
  for (Index k = 0; k < rows(); ++k) {
    const std::string& cell = cells_[static_cast<std::size_t>(k)][at];
    try {
      values[k] = std::stod(cell);
    } catch (const std::exception&) {
      throw std::runtime_error(
          fmt::format("{}:{}: '{}' in column {} is no number", path_, k + 2, cell, name));
    }
  }
  return values;
}

MatrixXd Table::by_joint(const std::string& name) const {
  MatrixXd values(rows(), joints());
  for (int j = 0; j < joints(); ++j) values.col(j) = column(fmt::format("{}{}", name, j + 1));
  return values;
}

void Table::set_by_joint(const std::string& name, const MatrixXd& values) {
  const MatrixXd before = by_joint(name);
  for (int j = 0; j < joints(); ++j) {
    const std::size_t at = place(fmt::format("{}{}", name, j + 1));
    for (Index k = 0; k < rows(); ++k) {
      std::string text = fmt::format("{:.7g}", values(k, j));
      if (text == fmt::format("{:.7g}", before(k, j))) continue;
      cells_[static_cast<std::size_t>(k)][at] = std::move(text);
    }
  }
}

}  // namespace blind

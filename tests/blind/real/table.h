// SPDX-License-Identifier: MIT
// A recording of a real robot as text: what is not changed keeps its letters.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace blind {

class Table {
 public:
  /// A CSV with a line of names. @throws std::runtime_error  naming the file and the line
  static Table read(const std::string& path);
  void write(const std::string& path) const;

  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(cells_.size()); }
  /// How many columns tau1, tau2, ... there are.
  [[nodiscard]] int joints() const;
  /// @throws std::runtime_error  if there is no such column
  [[nodiscard]] Eigen::VectorXd column(const std::string& name) const;
  /// name1, name2, ... side by side, (rows x joints).
  [[nodiscard]] Eigen::MatrixXd by_joint(const std::string& name) const;
  /// Values that are what they were to seven digits keep their letters.
  void set_by_joint(const std::string& name, const Eigen::MatrixXd& values);

 private:
  [[nodiscard]] std::size_t place(const std::string& name) const;
  std::string path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> cells_;
};

}  // namespace blind

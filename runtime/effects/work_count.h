// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>

namespace dyngen::runtime {

/// Work that was done on recordings: multiplications, as far as large matrices and signals ask for
/// them. It depends on what was computed and on nothing else, so that a bound on it cuts the same
/// work off on every machine. Several threads may add to it.
class WorkCount {
 public:
  /// @param rows, columns  of a matrix  @param each  multiplications for an element
  void add(Eigen::Index rows, Eigen::Index columns, Eigen::Index each) {
    multiplications_ += static_cast<std::int64_t>(rows) * columns * each;
  }
  /// In 1e9 multiplications.
  [[nodiscard]] double done() const { return 1e-9 * static_cast<double>(multiplications_.load()); }

 private:
  std::atomic<std::int64_t> multiplications_ = 0;
};

}  // namespace dyngen::runtime

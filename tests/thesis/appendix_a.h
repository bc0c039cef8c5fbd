// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

namespace dyngen::test {

/// A column of the 3-DOF Puma's regressor as Appendix A of the thesis prints it: the coefficient of
/// one base parameter in the torques of joints 1, 2, 3.
///
/// Symbols: S2 C2 S3 C3 sines and cosines of theta 2 and 3, w1 w2 w3 velocities, a1 a2 a3
/// accelerations, L, g.
struct PrintedColumn {
  std::string parameter;               ///< "XY3": in the order of the appendix
  std::array<std::string, 3> printed;  ///< as printed; "?" where the scan is unreadable
  std::array<std::string, 3> correct;  ///< empty where the print is right
};

/// The fifteen columns. Corrections: tests/data/oracles/ORACLES.md, section 3.
const std::vector<PrintedColumn>& appendix_a();

}  // namespace dyngen::test

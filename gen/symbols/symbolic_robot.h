// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"

namespace dyngen {

/// A quantity of the file that has a symbol: unknown ('*'), or a number whose symbol stands for it.
struct FileSymbol {
  GiNaC::symbol symbol;
  std::string name;  ///< "XX2", "d3", "gz"
  std::string unit;
  bool known = false;
  GiNaC::ex value = 0;  ///< exact, if known
  int line = 0;
};

/// A link in modified (Khalil, Craig) frames: T = Rx(alpha) Tx(d) Rz(theta + q) Tz(r).
struct SymbolicLink {
  JointType type = JointType::kRevolute;
  int parent = 0;
  GiNaC::ex alpha = 0;  ///< exact, rad
  GiNaC::ex theta = 0;  ///< exact, rad
  GiNaC::ex d = 0;      ///< m: exact, or a length symbol
  GiNaC::ex r = 0;
  /// From this frame to the file's frame of the link: Rx(tip_alpha) Tx(tip_d). 0 unless the file is
  /// in standard frames.
  GiNaC::ex tip_alpha = 0;
  GiNaC::ex tip_d = 0;
  int tip_line = 0;  ///< of the robot file
  int d_line = 0;    ///< of the robot file
  int r_line = 0;
  std::array<GiNaC::ex, kChiCount> chi;  ///< 0, or expressions in the file's symbols
  std::string name;
  int coordinate = -1;
};

/// The robot in modified frames with one symbol for every present quantity of the file.
///
/// Inertial parameters, rotor inertia, friction and offsets are symbols even where the file gives
/// a number: structure (what is zero) is kept apart from values. Known lengths and gravity are
/// numbers.
struct SymbolicRobot {
  std::string name;
  std::string file_name;
  std::vector<SymbolicLink> links;   ///< links[j - 1] is link j
  std::array<GiNaC::ex, 3> gravity;  ///< acceleration of the base in frame 0
  std::array<int, 3> gravity_lines{};
  std::vector<FileSymbol> parameters;  ///< of chi, in link order, chi order
  std::vector<FileSymbol> geometry;    ///< unknown lengths and gravity components
  int coordinate_count = 0;

  [[nodiscard]] int size() const { return static_cast<int>(links.size()); }
  [[nodiscard]] const SymbolicLink& link(int j) const {
    return links[static_cast<std::size_t>(j - 1)];
  }
  [[nodiscard]] SymbolicLink& link(int j) { return links[static_cast<std::size_t>(j - 1)]; }
};

/// Makes the symbols, in file order, and re-frames a standard DH table to modified frames.
///
/// Source of the re-framing: the standard row i carries (theta, r) of modified row i and (d, alpha)
/// of the rows that hang on it; inertial parameters move from the distal frame by Rx(alpha) Tx(d).
SymbolicRobot make_symbolic(const RobotModel& model);

/// Inertial parameters (XX XY XZ YY YZ ZZ MX MY MZ M) of a body given in a frame, expressed in the
/// frame that sees it at Rx(alpha) Tx(d) Rz(theta) Tz(r). The result is expanded.
std::array<GiNaC::ex, kInertialCount> move_to_parent(
    const std::array<GiNaC::ex, kInertialCount>& inertial, const GiNaC::ex& alpha,
    const GiNaC::ex& d, const GiNaC::ex& theta, const GiNaC::ex& r);

/// Numbers for the known symbols of an expression; the unknown ones stay.
GiNaC::ex with_known_values(const GiNaC::ex& expression, const SymbolicRobot& robot);

}  // namespace dyngen

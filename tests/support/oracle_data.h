// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/numeric_robot.h"

/// Reads the stored values in tests/data/oracles (see ORACLES.md there). All throw
/// std::runtime_error, naming the file, if it is missing or not as expected.
namespace dyngen::test {

/// One state: tau = M ddq + c + g + IA ddq + Fs sign(dq) + Fv dq; M, c, g without IA.
struct OracleState {
  std::vector<double> q, dq, ddq;
  std::vector<double> tau;         ///< all of it
  std::vector<double> tau_nofric;  ///< without Fs, Fv
  std::vector<double> tau_rb;      ///< also without IA
  std::vector<double> g, c;
  std::vector<double> M;  ///< row-major
};

struct Oracle {
  NumericRobot robot;                    ///< in the file's main frames
  std::optional<NumericRobot> standard;  ///< the same arm in standard frames, where stored
  std::vector<OracleState> states;
};

/// Reads NAME.json: planar2r, rp, scara_rrpr, stanford, rx90, ur10e, panda7, puma560_akb_mdh,
/// puma560_corke_std.
Oracle load_oracle(const std::string& name);

/// The names that load_oracle() knows.
const std::vector<std::string>& oracle_names();

/// Sarcos GRLA, standard frames, first moments of the thesis's listing (sarcos_listing.json).
NumericRobot load_sarcos();

/// The three-joint PUMA with the 15 base parameters of the thesis's Table 7.1 (puma3_table71.json).
NumericRobot load_puma3();

/// A comma-separated file with a header.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  /// Entries first .. first + count - 1 of a row.
  [[nodiscard]] std::vector<double> slice(std::size_t row, const std::string& first,
                                          std::size_t count) const;
};

/// q1..q7, g1..g7.
Table load_sarcos_gravity();

/// q1..q3, qd1..qd3, qdd1..qdd3, then Yk_NAME: k = 1..3, NAME in the order of Table 7.1.
Table load_puma3_regressor();

/// ZZ1 MX2 ...: names and values of Table 7.1, in its order.
struct NamedValues {
  std::vector<std::string> names;
  std::vector<double> values;
};
NamedValues load_table_7_1();

/// Place of "XX" .. "M" in NumericJoint::inertial.
std::size_t inertial_place(const std::string& name);

}  // namespace dyngen::test

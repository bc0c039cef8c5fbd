// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dyngen::runtime {

/// A recording as it was measured: one row a sample, SI units, joint side.
///
/// Matrices are column-major, one column a joint: the samples of a joint stand together.
struct Recording {
  std::string file_name;
  Eigen::VectorXd time;     ///< (N) s, increasing within a run
  Eigen::MatrixXd q;        ///< (N x n) rad or m
  Eigen::MatrixXd tau;      ///< (N x n) N m or N; 0 x 0 in what a trajectory was read from
  Eigen::MatrixXd dq;       ///< (N x n) rad/s or m/s; 0 x 0 if not recorded
  Eigen::MatrixXd ddq;      ///< (N x n); 0 x 0 if not recorded
  Eigen::MatrixXd tau_sim;  ///< (N x n) what another simulator says; 0 x 0 if absent
  /// (N x n) behind the gear, where q is the motor's; NaN throughout of joints without a second
  /// encoder; 0 x 0 if no joint has one
  Eigen::MatrixXd q_link;
  Eigen::MatrixXd temperature;  ///< (N x any); 0 x 0 if absent
  /// First row of every run; the first is 0. Rows of different runs do not follow each other in
  /// time, so no filter crosses from one to the next.
  std::vector<Eigen::Index> run_starts;
  /// (N) line (message, row) of the file that each row stood in; empty if no row stands for one
  std::vector<std::uint32_t> lines;
  std::string place_word = "line";  ///< what `lines` count
  /// (n) line and byte column of the name of each joint's ql in the file; 0, 0 where there is none
  std::vector<std::pair<std::size_t, std::size_t>> link_places;

  [[nodiscard]] Eigen::Index samples() const { return time.size(); }
  [[nodiscard]] int joints() const { return static_cast<int>(q.cols()); }
  /// Whether a joint has two encoders: q before its gear, q_link behind it.
  [[nodiscard]] bool has_link(Eigen::Index joint) const {
    return joint < q_link.cols() && q_link.rows() > 0 && !std::isnan(q_link(0, joint));
  }
};

/// The matrices of a recording, in the order of its values.
inline constexpr std::array<Eigen::MatrixXd Recording::*, 7> kRecordingParts = {
    &Recording::q,       &Recording::tau,    &Recording::dq,         &Recording::ddq,
    &Recording::tau_sim, &Recording::q_link, &Recording::temperature};

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/recordings/link_encoders.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMoves = 0.01;      // rad or m: below, a twist of the gear can be all the motion
constexpr double kFollows = 0.9;     // correlation with q
constexpr double kSameRatio = 0.02;  // of ql over q
constexpr double kSameZero = 0.1;    // rad or m, of the mean difference
constexpr double kWholeTurn = 0.01;  // rad, by which whole turns may be off

bool near_ratio(double ratio, double expected) {
  return std::abs(ratio / expected - 1) < kSameRatio;
}

/// What a ratio of ql over q says of the column, and what to do.
std::string words_of_ratio(double ratio, const std::string& link, const std::string& motor) {
  const double degrees = 180 / std::numbers::pi;
  if (near_ratio(ratio, degrees)) {
    return fmt::format("its values look like degrees beside {}: name the unit, '{} [deg]'", motor,
                       link);
  }
  if (near_ratio(ratio, 1 / degrees)) {
    return fmt::format("{} looks like degrees beside it: name the unit, '{} [deg]'", motor, motor);
  }
  if (near_ratio(ratio, 1e3) || near_ratio(ratio, 1e-3)) {
    return fmt::format("one of {} and {} looks like mm or mrad: name the unit, '{} [mm]'", motor,
                       link, link);
  }
  return fmt::format(
      "their gear ratios are apart by a factor of {:.5g}: both are positions of the "
      "joint, so set 'gears' and 'side' of 'position' and 'link_position' in a map",
      1 / std::abs(ratio));
}

class LinkCheck {
 public:
  LinkCheck(Recording& recording, std::vector<Notice>& notices)
      : recording_(recording), notices_(notices) {}

  void joint(Index j) {
    const std::string link = fmt::format("ql{}", j + 1), motor = fmt::format("q{}", j + 1);
    const VectorXd q = recording_.q.col(j);
    auto ql = recording_.q_link.col(j);
    const bool moves = q.maxCoeff() - q.minCoeff() > kMoves;
    if (moves && ql.maxCoeff() == ql.minCoeff()) {
      tell(j, fmt::format("{} is {:.6g} throughout while {} moves: the joint has no second "
                          "encoder; left out",
                          link, ql(0), motor));
      ql.setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    if (moves) compare_motion(j, q, ql, link, motor);
    compare_zeros(j, q, link, motor);
  }

 private:
  void compare_motion(Index j, const VectorXd& q, const VectorXd& ql, const std::string& link,
                      const std::string& motor) const {
    const VectorXd x = q.array() - q.mean(), y = ql.array() - ql.mean();
    const double ratio = x.dot(y) / x.squaredNorm();
    const double correlation = x.dot(y) / std::sqrt(x.squaredNorm() * y.squaredNorm());
    if (std::abs(correlation) < kFollows) {
      refuse(j, fmt::format("found {} that does not follow {} (correlation {:.2f}), expected the "
                            "position of the same joint behind its gear",
                            link, motor, correlation));
    }
    if (near_ratio(ratio, 1)) return;
    if (ratio < 0) {
      refuse(j,
             fmt::format(
                 "found {} that runs against {} (it moves by {:.5g} of it), expected the "
                 "same sign: turn one of them, by 'sign: -1' in a map{}",
                 link, motor, ratio,
                 near_ratio(-ratio, 1) ? "" : "; besides, " + words_of_ratio(-ratio, link, motor)));
    }
    refuse(j, fmt::format("found {} that moves by {:.5g} of {}, expected 1: {}", link, ratio, motor,
                          words_of_ratio(ratio, link, motor)));
  }

  void compare_zeros(Index j, const VectorXd& q, const std::string& link,
                     const std::string& motor) {
    const double turn = 2 * std::numbers::pi;
    auto ql = recording_.q_link.col(j);
    const double off = (q - ql).mean();
    const double turns = std::round(off / turn);
    if (turns != 0 && std::abs(off - turns * turn) < kWholeTurn) {
      ql.array() += turns * turn;
      tell(j, fmt::format("{} is {:.0f} whole turn{} away from {}; taken off", link,
                          std::abs(turns), std::abs(turns) == 1 ? "" : "s", motor));
      return;
    }
    if (std::abs(off) <= kSameZero) return;
    refuse(j, fmt::format("found {} with a zero {:.5g} away from that of {}, expected at most {}: "
                          "set 'offset' of 'link_position' or 'position' in a map",
                          link, off, motor, kSameZero));
  }

  [[nodiscard]] std::pair<std::size_t, std::size_t> place(Index j) const {
    const auto joint = static_cast<std::size_t>(j);
    return joint < recording_.link_places.size() ? recording_.link_places[joint]
                                                 : std::pair<std::size_t, std::size_t>{0, 0};
  }

  [[noreturn]] void refuse(Index j, const std::string& message) const {
    const auto [line, column] = place(j);
    throw recording_error(recording_.file_name, line, column, message);
  }

  void tell(Index j, const std::string& message) {
    const auto [line, column] = place(j);
    notices_.push_back({recording_.file_name, line, column, message});
  }

  Recording& recording_;
  std::vector<Notice>& notices_;
};

}  // namespace

void check_link_encoders(Recording& recording, std::vector<Notice>& notices) {
  LinkCheck check(recording, notices);
  for (Index j = 0; j < recording.q_link.cols(); ++j) {
    if (recording.has_link(j)) check.joint(j);
  }
  if (recording.q_link.size() != 0 && recording.q_link.array().isNaN().all()) {
    recording.q_link.resize(0, 0);
  }
}

}  // namespace dyngen::runtime

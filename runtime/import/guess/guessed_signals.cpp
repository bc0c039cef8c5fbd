// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "runtime/import/guess/column_words.h"
#include "runtime/import/guess/map_guess.h"
#include "runtime/import/signal_units.h"
#include "runtime/import/signed_numbers.h"
#include "runtime/import/spelling.h"
#include "runtime/plausibility/derivative_remarks.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Joints that turn farther are rare.
constexpr double kMostRadians = 3 * std::numbers::pi;

/// A unit that values themselves suggest; an empty one: people are asked.
struct UnitGuess {
  std::string unit, why;
  int sure = kPlausible;  ///< per cent
};

/// Whether positions times a factor are within the robot's limits, and a little beyond.
bool are_within(const MatrixXd& positions, double factor, const GuessRobot& robot) {
  if (robot.lowest.size() != positions.cols()) return false;
  constexpr double kSlack = 0.05;
  for (Index j = 0; j < positions.cols(); ++j) {
    if (!std::isfinite(robot.lowest[j]) || !std::isfinite(robot.highest[j])) return false;
    const double slack = kSlack * (robot.highest[j] - robot.lowest[j]);
    if (factor * positions.col(j).minCoeff() < robot.lowest[j] - slack) return false;
    if (factor * positions.col(j).maxCoeff() > robot.highest[j] + slack) return false;
  }
  return true;
}

UnitGuess position_unit(const MatrixXd& values, const GuessRobot& robot) {
  constexpr double kDegree = std::numbers::pi / 180;
  constexpr double kFewestCounts = 1000, kMostDegrees = 720;
  const double most = values.cwiseAbs().maxCoeff();
  const bool whole = (values.array() == values.array().round()).all();
  if (whole && most > kFewestCounts) {
    return {"counts", fmt::format("whole numbers up to {:.0f}", most), kLikely};
  }
  if (most <= kMostRadians) {
    const bool within = are_within(values, 1, robot);
    return {"rad",
            fmt::format("values up to {:.4g}{}", most,
                        within ? ", within the robot's limits" : ": degrees would hardly move"),
            within ? kSure : kLikely};
  }
  const bool within = are_within(values, kDegree, robot);
  if (within || most <= kMostDegrees) {
    return {"deg",
            fmt::format("values up to {:.4g}{}", most,
                        within ? ", within the robot's limits in degrees"
                               : ": as radians they would turn several times"),
            within ? kSure : kLikely};
  }
  return {"", fmt::format("values up to {:.4g} are beyond any joint in degrees: are they the "
                          "motors', or counts",
                          most)};
}

/// @param words  of the columns' names
UnitGuess torque_unit(const MatrixXd& values, const std::vector<std::string>& words,
                      const GuessRobot& robot) {
  if (robot.gravity_torque.size() != values.cols()) {
    if (std::find(words.begin(), words.end(), "effort") != words.end()) {
      return {"N m", "ROS gives effort in N m; some drivers give currents or percent", kLikely};
    }
    return {"N m", fmt::format("values up to {:.4g}", values.cwiseAbs().maxCoeff()), kPlausible};
  }
  Index j = 0;  // the joint that carries most
  const double weight = robot.gravity_torque.maxCoeff(&j);
  const double most = values.col(j).cwiseAbs().maxCoeff(), ratio = most / weight;
  constexpr double kNear = 10, kMilli = 1000;
  if (ratio > 1 / kNear && ratio < kNear) {
    return {"N m",
            fmt::format("the robot's weight takes up to {:.4g} N m of joint {}, as here", weight,
                        j + 1),
            kSure};
  }
  if (ratio > kMilli / kNear && ratio < kMilli * kNear) {
    return {"mN m", fmt::format("a thousand times the robot's weight ({:.4g} N m)", weight),
            kLikely};
  }
  return {"", fmt::format("joint {} reaches {:.4g}, its weight takes {:.4g} N m: the motor's side, "
                          "percent, or another unit",
                          j + 1, most, weight)};
}

}  // namespace

void MapGuess::guess_position() {
  const SignalCandidate* chosen = choose(ColumnRole::kPosition, "position");
  if (chosen == nullptr) {
    if (lines_.empty() || lines_.back().find("position:") == std::string::npos) {
      question("which columns are the positions of the joints?");
      line("position: {columns: \"?\", unit: \"?\"}");
    }
    return;
  }
  used_.push_back(chosen);
  const MatrixXd values = values_of(*chosen);
  UnitGuess guess{chosen->unit, why_unit(*chosen), sure_of_unit(*chosen)};
  if (guess.unit.empty()) guess = position_unit(values, robot_);
  if (guess.unit.empty()) {
    question(fmt::format("in which unit are the positions ({})?", guess.why));
    line(fmt::format("position: {{{}, unit: \"?\"}}", columns_of(*chosen)));
    return;
  }
  reason(guess.sure, fmt::format("{} by name; unit {}: {}",
                                 chosen->family.pattern.empty() ? "the first columns are positions"
                                                                : chosen->family.pattern,
                                 guess.unit, guess.why));
  position_unit_ = guess.unit;
  if (guess.unit == "counts") {
    question("how many counts make one turn?");
    line(fmt::format("position: {{{}, unit: counts, counts_per_rev: \"?\"}}", columns_of(*chosen)));
    return;
  }
  line(fmt::format("position: {{{}, unit: {}}}", columns_of(*chosen), guess.unit));
  const auto conversion = unit_conversion(guess.unit, ColumnQuantity::kPosition);
  if (!conversion || values.rows() != recording_.time.size()) return;
  recording_.q = values.unaryExpr([&](double value) { return (*conversion)(value); });
  recording_.run_starts = {0};
}

void MapGuess::guess_velocity() {
  const SignalCandidate* chosen = choose(ColumnRole::kVelocity, "velocity");
  if (chosen == nullptr) return;
  used_.push_back(chosen);
  const MatrixXd values = values_of(*chosen);
  const std::vector<DerivativeFit> all = fits(values);
  std::vector<double> slopes;
  double lag = 0;
  for (const DerivativeFit& fit : all) {
    constexpr double kGoes = 0.8;
    if (!fit.judged || std::abs(fit.correlation) < kGoes) continue;
    slopes.push_back(fit.slope);
    if (std::abs(fit.lag) > std::abs(lag)) lag = fit.lag;
  }
  std::string unit = chosen->unit, why = why_unit(*chosen);
  std::vector<double> signs;
  if (slopes.empty()) {
    if (unit.empty()) {
      question("in which unit are the velocities (they do not go with the positions)?");
      unit = "\"?\"";
    } else {
      reason(sure_of_unit(*chosen),
             fmt::format("{} by name; unit {}: {}", chosen->family.pattern, unit, why));
    }
    line(fmt::format("velocity: {{{}, unit: {}}}", columns_of(*chosen), unit));
    return;
  }
  constexpr double kDegrees = 180 / std::numbers::pi, kMinutes = 30 / std::numbers::pi;
  constexpr std::array<std::pair<const char*, double>, 3> kUnits = {
      {{"rad/s", 1}, {"deg/s", kDegrees}, {"rpm", kMinutes}}};
  constexpr double kAlike = 0.1;
  const auto all_are = [&](double factor) {
    return std::all_of(slopes.begin(), slopes.end(), [&](double slope) {
      return std::abs(std::abs(slope) / factor - 1) < kAlike;
    });
  };
  int sure = sure_of_unit(*chosen);
  if (unit.empty()) {
    for (const auto& [word, factor] : kUnits) {
      if (!all_are(factor)) continue;
      unit = word;
      sure = kSure;
      why = fmt::format("they are {:.4g} times the slope of the positions", slopes.front());
      break;
    }
  }
  if (unit.empty()) {
    question(
        fmt::format("velocities are {} times the slopes of the positions: which unit or gear "
                    "is it?",
                    yaml_numbers(slopes)));
    line(fmt::format("velocity: {{{}, unit: \"?\"}}", columns_of(*chosen)));
    return;
  }
  for (const DerivativeFit& fit : all) signs.push_back(fit.judged && fit.slope < 0 ? -1 : 1);
  reason(sure,
         fmt::format("{} by name; unit {}: {}",
                     chosen->family.pattern.empty() ? "the second block" : chosen->family.pattern,
                     unit, why));
  if (std::abs(lag) > step_) {
    remark(fmt::format("it {} the positions by {:.3g} ms: 'delay' takes that off",
                       lag > 0 ? "lags behind" : "is ahead of", 1e3 * std::abs(lag)));
  }
  const bool turned = std::any_of(signs.begin(), signs.end(), [](double s) { return s < 0; });
  line(fmt::format("velocity: {{{}, unit: {}{}}}", columns_of(*chosen), unit,
                   turned ? ", sign: " + yaml_numbers(signs) : ""));
}

/// By which torque follows accelerations, from the correlation of their changes.
void MapGuess::note_torque_lag(const MatrixXd& torque) {
  if (recording_.q.size() == 0 || torque.rows() != recording_.samples()) return;
  constexpr Index kHalf = 5, kMost = 30;
  double best_all = 0, lag_all = 0;
  for (Index j = 0; j < torque.cols(); ++j) {
    const Index n = torque.rows() - 4 * kHalf;
    if (n < 8 * kMost) return;
    VectorXd acceleration(n), change(n);
    for (Index k = 0; k < n; ++k) {
      const Index m = k + 2 * kHalf;
      const auto& q = recording_.q;
      acceleration[k] = q(m + 2 * kHalf, j) - 2 * q(m, j) + q(m - 2 * kHalf, j);
      change[k] = torque.block(m - kHalf, j, 2 * kHalf + 1, 1).mean() -
                  (torque(m - 2 * kHalf, j) + torque(m + 2 * kHalf, j)) / 2;
    }
    // both without what is slow: a window's bend
    const Index count = n - 2 * kMost;
    double most = 0, none = 0;
    Index lag = 0;
    for (Index shift = -kMost; shift <= kMost; ++shift) {
      const auto a = acceleration.segment(kMost, count);
      const auto b = change.segment(kMost + shift, count);
      const double scale = a.norm() * b.norm();
      const double value = scale > 0 ? std::abs(a.dot(b)) / scale : 0;
      if (shift == 0) none = value;
      if (value > most) {
        most = value;
        lag = shift;
      }
    }
    constexpr double kClear = 0.05;
    if (most - none > kClear && most > std::abs(best_all)) {
      best_all = most;
      lag_all = static_cast<double>(lag) * step_;
    }
  }
  constexpr double kTrusted = 0.6;
  if (best_all > kTrusted && std::abs(lag_all) > step_) {
    remark(
        fmt::format("torque seems to {} the motion by some {:.2g} ms (correlation {:.2f}); "
                    "'dynid check' and 'dynid fit' say it better",
                    lag_all > 0 ? "lag behind" : "be ahead of", 1e3 * std::abs(lag_all), best_all));
  }
}

/// Where no column is a torque.
void MapGuess::guess_torque_of_motors() {
  if (const SignalCandidate* current = choose(ColumnRole::kCurrent, "torque")) {
    used_.push_back(current);
    const std::string unit = current->unit.empty() ? "A" : current->unit;
    reason(current->unit.empty() ? kPlausible : sure_of_unit(*current),
           fmt::format("no torque is recorded; {} are currents", current->family.pattern));
    question("which torque at the joint does one ampere make (N m/A, gear included)?");
    line(fmt::format("torque: {{{}, unit: {}, constant: \"?\"}}", columns_of(*current), unit));
    return;
  }
  if (!lines_.empty() && lines_.back().starts_with("torque:")) return;
  if (const SignalCandidate* duty = choose(ColumnRole::kDuty, "torque")) {
    used_.push_back(duty);
    reason(kPlausible,
           fmt::format("no torque is recorded; {} is a duty cycle", duty->family.pattern));
    question(
        "which value is full voltage, which voltage, resistance (ohm) and torque constant "
        "(N m/A) has the servo?");
    const int bits = bits_of(*duty);
    line(fmt::format(
        "torque: {{duty: {}, full: \"?\", voltage: \"?\", resistance: \"?\", "
        "constant: \"?\"{}}}",
        yaml_text(duty->family.pattern), bits > 0 ? fmt::format(", bits: {}", bits) : ""));
    return;
  }
  question("which columns are the torques of the joints?");
  line("torque: {columns: \"?\", unit: \"?\"}");
}

void MapGuess::guess_torque() {
  const SignalCandidate* chosen = choose(ColumnRole::kTorque, "torque");
  const bool asked = !lines_.empty() && lines_.back().starts_with("torque:");
  if (asked) return;
  if (chosen == nullptr) {
    guess_torque_of_motors();
    return;
  }
  used_.push_back(chosen);
  const MatrixXd values = values_of(*chosen);
  UnitGuess guess{chosen->unit, why_unit(*chosen), sure_of_unit(*chosen)};
  if (guess.unit.empty()) guess = torque_unit(values, chosen->family.words, robot_);
  if (guess.unit.empty()) {
    question(fmt::format("in which unit are the torques ({})?", guess.why));
    line(fmt::format("torque: {{{}, unit: \"?\"}}", columns_of(*chosen)));
    return;
  }
  reason(guess.sure,
         fmt::format("{} by name; unit {}: {}",
                     chosen->family.pattern.empty() ? "the last block" : chosen->family.pattern,
                     guess.unit, guess.why));
  if (robot_.gravity_torque.size() != values.cols()) {
    remark(
        "taken as torque at the joints; what is measured at the motors needs 'side: motor' and "
        "'gears'");
  }
  note_torque_lag(values);
  line(fmt::format("torque: {{{}, unit: {}}}", columns_of(*chosen), guess.unit));
}

void MapGuess::guess_temperature() {
  for (const SignalCandidate& candidate : candidates_) {
    if (candidate.role != ColumnRole::kTemperature || !candidate.commanded.empty()) continue;
    used_.push_back(&candidate);
    reason(kLikely, fmt::format("{} by name", candidate.family.pattern));
    line(fmt::format("temperature: {{{}}}", columns_of(candidate)));
    return;
  }
}

void MapGuess::note_others() {
  std::vector<std::string> commanded, flags;
  for (const SignalCandidate& candidate : candidates_) {
    if (std::find(used_.begin(), used_.end(), &candidate) != used_.end()) continue;
    if (!candidate.commanded.empty()) {
      commanded.push_back(candidate.family.pattern);
    } else if (candidate.role == ColumnRole::kFlag) {
      flags.push_back(candidate.family.pattern);
    }
  }
  if (!commanded.empty()) {
    remark("not measured, by their names, and left out: " + listed(commanded));
  }
  if (!flags.empty()) {
    remark("flags, with which rows can be left out: runs: {keep: " + listed(flags) + "}");
  }
}

}  // namespace dyngen::runtime

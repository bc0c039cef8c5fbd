// SPDX-License-Identifier: MIT
#include "runtime/import/guess/guessed_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "runtime/import/guess/column_words.h"
#include "runtime/import/signal_units.h"
#include "runtime/import/spelling.h"
#include "runtime/plausibility/derivative_remarks.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSure = 95, kLikely = 80, kPlausible = 70;  // per cent
constexpr double kMostRadians = 3 * std::numbers::pi;     // joints that turn farther are rare

/// Columns that may be one signal.
struct Candidate {
  std::size_t table = 0;
  ColumnFamily family;
  ColumnRole role = ColumnRole::kPosition;
  std::string unit;       ///< that the log says
  std::string commanded;  ///< the word by which it is no measurement
};

std::optional<ColumnRole> role_of_unit(const std::string& unit) {
  if (unit.empty()) return std::nullopt;
  constexpr std::array<std::pair<ColumnQuantity, ColumnRole>, 5> kRoles = {
      {{ColumnQuantity::kVelocity, ColumnRole::kVelocity},
       {ColumnQuantity::kAcceleration, ColumnRole::kAcceleration},
       {ColumnQuantity::kTorque, ColumnRole::kTorque},
       {ColumnQuantity::kPosition, ColumnRole::kPosition},
       {ColumnQuantity::kTemperature, ColumnRole::kTemperature}}};
  for (const auto& [quantity, role] : kRoles) {
    const auto known = signal_unit(unit, quantity);
    if (known && known->kind == RawKind::kCurrent) return ColumnRole::kCurrent;
    if (known) return role;
  }
  return std::nullopt;
}

/// A text fit for YAML's double quotes.
std::string yaml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string yaml_numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", value);
  return "[" + text + "]";
}

class MapGuess {
 public:
  MapGuess(const SampledLog& logs, const GuessRobot& robot) : logs_(logs), robot_(robot) {}

  GuessedMap make();

 private:
  void choose_names();
  void find_candidates();
  void name_headerless();
  void count_joints();
  void guess_time();
  std::string time_unit(const std::string& name, double step, std::string& reason);
  const Candidate* choose(ColumnRole role, const char* key);
  void guess_position();
  void guess_velocity();
  void guess_torque();
  void guess_temperature();
  void note_others();
  void note_torque_lag(const MatrixXd& torque);
  [[nodiscard]] MatrixXd values_of(const Candidate& candidate) const;
  [[nodiscard]] std::string columns_of(const Candidate& candidate) const;
  [[nodiscard]] std::vector<DerivativeFit> fits(const MatrixXd& upper) const;

  void reason(int sure, const std::string& text) {
    lines_.push_back(fmt::format("# {} (confidence {} %)", text, sure));
  }
  void remark(const std::string& text) { lines_.push_back("# " + text); }
  void question(const std::string& text) {
    lines_.push_back("# QUESTION: " + text + "; put the answer in place of \"?\"");
    ++questions_;
  }
  void line(const std::string& text) { lines_.push_back(text); }

  const SampledLog& logs_;
  const GuessRobot& robot_;
  std::vector<std::string> names_;  ///< of joints, as the log has them
  std::vector<Candidate> candidates_;
  std::vector<const Candidate*> used_;
  std::vector<std::string> lines_;
  std::size_t joints_ = 0;
  int questions_ = 0;
  double step_ = 0;      ///< s; 0: not known
  Recording recording_;  ///< time and positions of the first rows, in SI units as guessed
  std::vector<double> gears_;
  std::string position_unit_;
};

MatrixXd MapGuess::values_of(const Candidate& candidate) const {
  const MatrixXd& all = logs_.tables[candidate.table].values;
  MatrixXd values(all.rows(), static_cast<Index>(candidate.family.columns.size()));
  for (Index j = 0; j < values.cols(); ++j) {
    values.col(j) =
        all.col(static_cast<Index>(candidate.family.columns[static_cast<std::size_t>(j)]));
  }
  // a value that is missing is that before it
  for (Index j = 0; j < values.cols(); ++j) {
    double last = 0;
    for (Index k = 0; k < values.rows(); ++k) {
      if (std::isfinite(values(k, j))) last = values(k, j);
      values(k, j) = last;
    }
  }
  return values;
}

std::string MapGuess::columns_of(const Candidate& candidate) const {
  std::string text = "columns: " + yaml_text(candidate.family.pattern);
  if (candidate.family.columns.size() > 1 && !is_column_pattern(candidate.family.pattern)) {
    text = "columns: [";
    for (const std::size_t c : candidate.family.columns) {
      text += (text.back() == '[' ? "" : ", ") +
              yaml_text(logs_.tables[candidate.table].table.columns[c]);
    }
    text += "]";
  }
  const SampledTable& own = logs_.tables[candidate.table];
  const bool several =
      std::any_of(logs_.tables.begin(), logs_.tables.end(), [&](const SampledTable& other) {
        return &other != &own && other.log == own.log && !other.table.name.empty();
      });
  if (several && !own.table.name.empty() && own.table.columns.size() > 1) {
    text += ", table: " + yaml_text(own.table.name);
  }
  if (logs_.paths.size() > 1) text += fmt::format(", file: file{}", own.log + 1);
  return text;
}

std::vector<DerivativeFit> MapGuess::fits(const MatrixXd& upper) const {
  if (!(step_ > 0) || upper.rows() != recording_.samples()) return {};
  return derivative_fits(recording_, recording_.q, upper, step_);
}

/// The robot's names of joints if the log has them, else those of the log.
void MapGuess::choose_names() {
  std::vector<std::string> of_log;
  for (const SampledTable& own : logs_.tables) {
    if (of_log.empty()) of_log = bracketed_names(own.table.columns);
  }
  const std::vector<std::string>& of_robot = robot_.joints.names;
  const bool robot_has_them =
      !of_robot.empty() && std::all_of(of_robot.begin(), of_robot.end(), [&](const auto& name) {
        return of_log.empty() || std::find(of_log.begin(), of_log.end(), name) != of_log.end();
      });
  names_ = robot_has_them ? of_robot : of_log;
}

void MapGuess::find_candidates() {
  for (std::size_t t = 0; t < logs_.tables.size(); ++t) {
    const LogTable& table = logs_.tables[t].table;
    for (ColumnFamily& family : column_families(table.columns, names_)) {
      Candidate candidate;
      candidate.table = t;
      const std::size_t first = family.columns.front();
      if (first < table.units.size()) candidate.unit = table.units[first];
      if (candidate.unit.empty()) {
        candidate.unit = std::string(name_and_unit(table.columns[first]).unit);
        if (!role_of_unit(candidate.unit) &&
            !unit_conversion(candidate.unit, ColumnQuantity::kTime)) {
          candidate.unit.clear();
        }
      }
      std::vector<std::string> words = family.words;
      // a variable of its own is called like its table
      if (table.columns.size() == family.columns.size() && !table.name.empty()) {
        const std::vector<std::string> more = words_of(table.name);
        words.insert(words.end(), more.begin(), more.end());
      }
      std::optional<ColumnRole> role = role_of_words(words);
      const std::optional<ColumnRole> by_unit = role_of_unit(candidate.unit);
      if (by_unit && (!role || *role == ColumnRole::kTime || family.words.size() < 2))
        role = by_unit;
      if (by_unit == ColumnRole::kCurrent) role = by_unit;
      if (!role) continue;
      candidate.commanded = commanded_word(words);
      candidate.role = *role;
      candidate.family = std::move(family);
      candidates_.push_back(std::move(candidate));
    }
  }
}

/// Columns without names: the first that only rises is the time; blocks of as many as there are
/// joints are positions, velocities if they are their slopes, and torques.
void MapGuess::name_headerless() {
  const auto numbered = [](const std::string& name) {
    return !name.empty() &&
           std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  if (logs_.tables.size() != 1) return;
  const SampledTable& own = logs_.tables.front();
  const std::vector<std::string>& names = own.table.columns;
  if (!std::all_of(names.begin(), names.end(), numbered)) return;
  candidates_.clear();
  Index time = -1;
  for (Index c = 0; c < own.values.cols() && time < 0; ++c) {
    const VectorXd steps = own.values.col(c).tail(own.values.rows() - 1) -
                           own.values.col(c).head(own.values.rows() - 1);
    if (steps.minCoeff() > 0) time = c;
  }
  std::size_t next = 0;
  if (time >= 0) {
    candidates_.push_back(
        {0,
         {names[static_cast<std::size_t>(time)], {static_cast<std::size_t>(time)}, {}},
         ColumnRole::kTime,
         "",
         ""});
    next = time == 0 ? 1 : 0;
  }
  const std::size_t left = names.size() - (time >= 0 ? 1 : 0);
  const auto told = static_cast<std::size_t>(robot_.joints.joints);
  const std::size_t joints = told > 0 ? told : left / 2;
  if (joints == 0) return;
  constexpr std::array<ColumnRole, 3> kTwo = {ColumnRole::kPosition, ColumnRole::kTorque,
                                              ColumnRole::kTorque};
  constexpr std::array<ColumnRole, 3> kThree = {ColumnRole::kPosition, ColumnRole::kVelocity,
                                                ColumnRole::kTorque};
  const std::size_t blocks = left / joints;
  for (std::size_t block = 0; block < std::min<std::size_t>(blocks, 3); ++block) {
    Candidate candidate;
    candidate.role = blocks >= 3 ? kThree[block] : kTwo[block];
    for (std::size_t j = 0; j < joints; ++j) {
      if (static_cast<Index>(next) == time) ++next;
      candidate.family.columns.push_back(next++);
    }
    candidates_.push_back(std::move(candidate));
  }
}

void MapGuess::count_joints() {
  joints_ = static_cast<std::size_t>(robot_.joints.joints);
  if (joints_ > 0) return;
  for (const Candidate& candidate : candidates_) {
    if (candidate.role != ColumnRole::kPosition || !candidate.commanded.empty()) continue;
    joints_ = std::max(joints_, candidate.family.columns.size());
  }
  if (joints_ == 0) {
    std::vector<std::string> names;
    for (const SampledTable& own : logs_.tables) {
      names.insert(names.end(), own.table.columns.begin(), own.table.columns.end());
    }
    throw ImportError(
        fmt::format("{}: error: no column looks like a position; it has {}. Write the map by hand "
                    "(docs/import.md)",
                    logs_.paths.front(), listed(names)));
  }
}

/// One that is measured and has a column for each joint; null and a question where several do.
const Candidate* MapGuess::choose(ColumnRole role, const char* key) {
  std::vector<const Candidate*> fitting;
  for (const Candidate& candidate : candidates_) {
    if (candidate.role == role && candidate.commanded.empty() &&
        candidate.family.columns.size() == joints_) {
      fitting.push_back(&candidate);
    }
  }
  const auto prefer = [&](const auto& is_better) {
    std::vector<const Candidate*> better;
    std::copy_if(fitting.begin(), fitting.end(), std::back_inserter(better), is_better);
    if (!better.empty()) fitting = better;
  };
  const auto has = [](const Candidate* one, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* word) {
      return std::find(one->family.words.begin(), one->family.words.end(), word) !=
             one->family.words.end();
    });
  };
  if (fitting.size() > 1) {
    prefer([&](const Candidate* one) {
      return has(one, {"actual", "act", "ist", "measured", "meas", "msr"});
    });
  }
  if (fitting.empty()) return nullptr;
  if (fitting.size() == 1) return fitting.front();
  std::vector<std::string> patterns;
  for (const Candidate* one : fitting) patterns.push_back(one->family.pattern);
  question(fmt::format("which columns are the {}: {}?", key, listed(patterns)));
  line(fmt::format("{}: {{columns: \"?\"}}", key));
  for (const Candidate* one : fitting) used_.push_back(one);
  return nullptr;
}

/// From the log, the name's end, or the size of a step.
std::string MapGuess::time_unit(const std::string& name, double step, std::string& reason) {
  const std::vector<std::string> words = words_of(name);
  for (const char* unit : {"ns", "us", "ms", "nsec", "usec", "msec"}) {
    if (std::find(words.begin(), words.end(), unit) == words.end()) continue;
    reason = fmt::format("'{}' is in its name", unit);
    return unit;
  }
  // samples of a controller are 0.2 ms to 0.2 s apart
  constexpr double kQuickest = 2e-4, kSlowest = 0.2;
  constexpr std::array<std::pair<const char*, double>, 4> kUnits = {
      {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  for (const auto& [unit, factor] : kUnits) {
    if (step * factor < kQuickest || step * factor > kSlowest) continue;
    reason = fmt::format("a step of {:.6g} is {:.4g} ms then", step, 1e3 * step * factor);
    return unit;
  }
  return {};
}

void MapGuess::guess_time() {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates_) {
    if (candidate.role != ColumnRole::kTime) continue;
    const VectorXd times = values_of(candidate).col(0);
    if (times.size() < 3) continue;
    const VectorXd steps = times.tail(times.size() - 1) - times.head(times.size() - 1);
    const auto rising = static_cast<double>((steps.array() > 0).count());
    constexpr double kMostRising = 0.9;
    if (rising < kMostRising * static_cast<double>(steps.size())) continue;
    const auto is_stamp = [](const Candidate& one) {
      return std::find(one.family.words.begin(), one.family.words.end(), "stamp") !=
             one.family.words.end();
    };
    if (best == nullptr || (is_stamp(candidate) && !is_stamp(*best))) best = &candidate;
  }
  if (best == nullptr) {
    question("no column is a time: at which rate were the rows taken (such as 1000 Hz)?");
    line("time: {rate: \"?\"}");
    return;
  }
  used_.push_back(best);
  VectorXd times = values_of(*best).col(0);
  std::vector<double> steps(static_cast<std::size_t>(times.size() - 1));
  for (std::size_t k = 0; k < steps.size(); ++k) {
    steps[k] = times[static_cast<Index>(k) + 1] - times[static_cast<Index>(k)];
  }
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  const double step = steps[steps.size() / 2];
  std::string why = "the log says so", unit = best->unit;
  if (unit.empty() || !unit_conversion(unit, ColumnQuantity::kTime)) {
    unit = time_unit(best->family.pattern, step, why);
  }
  const std::string column = yaml_text(best->family.pattern);
  if (unit.empty()) {
    question(fmt::format("in which unit is the time, of which a step is {:.6g}?", step));
    line(fmt::format("time: {{column: {}, unit: \"?\"}}", column));
    return;
  }
  const UnitConversion seconds = *unit_conversion(unit, ColumnQuantity::kTime);
  step_ = seconds(step);
  reason(why == "the log says so" ? 99 : kSure,
         fmt::format("{} rises from row to row; unit {}: {}; {:.6g} Hz", best->family.pattern, unit,
                     why, 1 / step_));
  line(fmt::format("time: {{column: {}, unit: {}}}", column, unit));
  recording_.time.resize(times.size());
  for (Index k = 0; k < times.size(); ++k) recording_.time[k] = seconds(times[k] - times[0]);
}

void MapGuess::guess_position() {
  const Candidate* chosen = choose(ColumnRole::kPosition, "position");
  if (chosen == nullptr) {
    if (lines_.empty() || lines_.back().find("position:") == std::string::npos) {
      question("which columns are the positions of the joints?");
      line("position: {columns: \"?\", unit: \"?\"}");
    }
    return;
  }
  used_.push_back(chosen);
  const MatrixXd values = values_of(*chosen);
  const double most = values.cwiseAbs().maxCoeff();
  std::string unit = chosen->unit, why = "the log says so";
  int sure = 99;
  bool asks = false;
  const bool limits = robot_.lowest.size() == values.cols();
  const auto within = [&](double factor) {
    if (!limits) return false;
    constexpr double kSlack = 0.05;
    for (Index j = 0; j < values.cols(); ++j) {
      if (!std::isfinite(robot_.lowest[j]) || !std::isfinite(robot_.highest[j])) return false;
      const double slack = kSlack * (robot_.highest[j] - robot_.lowest[j]);
      if (factor * values.col(j).minCoeff() < robot_.lowest[j] - slack) return false;
      if (factor * values.col(j).maxCoeff() > robot_.highest[j] + slack) return false;
    }
    return true;
  };
  constexpr double kDegree = std::numbers::pi / 180;
  if (unit.empty()) {
    const bool whole = (values.array() == values.array().round()).all();
    if (whole && most > 1000) {
      unit = "counts";
      sure = kLikely;
      why = fmt::format("whole numbers up to {:.0f}", most);
    } else if (most <= kMostRadians) {
      unit = "rad";
      sure = within(1) ? kSure : kLikely;
      why = fmt::format("values up to {:.4g}{}", most,
                        within(1) ? ", within the robot's limits" : ": degrees would hardly move");
    } else if (within(kDegree) || most <= 720) {
      unit = "deg";
      sure = within(kDegree) ? kSure : kLikely;
      why = fmt::format("values up to {:.4g}{}", most,
                        within(kDegree) ? ", within the robot's limits in degrees"
                                        : ": as radians they would turn several times");
    } else {
      asks = true;
      why = fmt::format(
          "values up to {:.4g} are beyond any joint in degrees: are they the motors', "
          "or counts",
          most);
    }
  }
  if (asks) {
    question(fmt::format("in which unit are the positions ({})?", why));
    line(fmt::format("position: {{{}, unit: \"?\"}}", columns_of(*chosen)));
    return;
  }
  reason(sure, fmt::format("{} by name; unit {}: {}",
                           chosen->family.pattern.empty() ? "the first columns are positions"
                                                          : chosen->family.pattern,
                           unit, why));
  position_unit_ = unit;
  if (unit == "counts") {
    question("how many counts make one turn?");
    line(fmt::format("position: {{{}, unit: counts, counts_per_rev: \"?\"}}", columns_of(*chosen)));
    return;
  }
  line(fmt::format("position: {{{}, unit: {}}}", columns_of(*chosen), unit));
  const auto conversion = unit_conversion(unit, ColumnQuantity::kPosition);
  if (!conversion || values.rows() != recording_.time.size()) return;
  recording_.q = values.unaryExpr([&](double value) { return (*conversion)(value); });
  recording_.run_starts = {0};
}

void MapGuess::guess_velocity() {
  const Candidate* chosen = choose(ColumnRole::kVelocity, "velocity");
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
  std::string unit = chosen->unit, why = "the log says so";
  std::vector<double> signs;
  if (slopes.empty()) {
    if (unit.empty()) {
      question("in which unit are the velocities (they do not go with the positions)?");
      unit = "\"?\"";
    } else {
      reason(99, fmt::format("{} by name; unit {}: {}", chosen->family.pattern, unit, why));
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
  int sure = 99;
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

void MapGuess::guess_torque() {
  const Candidate* chosen = choose(ColumnRole::kTorque, "torque");
  const bool asked = !lines_.empty() && lines_.back().starts_with("torque:");
  if (asked) return;
  if (chosen == nullptr) {
    if (const Candidate* current = choose(ColumnRole::kCurrent, "torque")) {
      used_.push_back(current);
      const std::string unit = current->unit.empty() ? "A" : current->unit;
      reason(current->unit.empty() ? kPlausible : 99,
             fmt::format("no torque is recorded; {} are currents", current->family.pattern));
      question("which torque at the joint does one ampere make (N m/A, gear included)?");
      line(fmt::format("torque: {{{}, unit: {}, constant: \"?\"}}", columns_of(*current), unit));
      return;
    }
    if (!lines_.empty() && lines_.back().starts_with("torque:")) return;
    if (const Candidate* duty = choose(ColumnRole::kDuty, "torque")) {
      used_.push_back(duty);
      reason(kPlausible,
             fmt::format("no torque is recorded; {} is a duty cycle", duty->family.pattern));
      question(
          "which value is full voltage, which voltage, resistance (ohm) and torque constant "
          "(N m/A) has the servo?");
      line(
          fmt::format("torque: {{duty: {}, full: \"?\", voltage: \"?\", resistance: \"?\", "
                      "constant: \"?\"}}",
                      yaml_text(duty->family.pattern)));
      return;
    }
    question("which columns are the torques of the joints?");
    line("torque: {columns: \"?\", unit: \"?\"}");
    return;
  }
  used_.push_back(chosen);
  const MatrixXd values = values_of(*chosen);
  std::string unit = chosen->unit, why = "the log says so";
  int sure = 99;
  const auto& words = chosen->family.words;
  const bool ros = std::find(words.begin(), words.end(), "effort") != words.end();
  bool asks = false;
  if (unit.empty()) {
    const double most = values.cwiseAbs().maxCoeff();
    unit = "N m";
    sure = ros ? kLikely : kPlausible;
    why = ros ? std::string("ROS gives effort in N m; some drivers give currents or percent")
              : fmt::format("values up to {:.4g}", most);
    if (robot_.gravity_torque.size() == values.cols()) {
      // the joint that carries most
      Index j = 0;
      const double weight = robot_.gravity_torque.maxCoeff(&j);
      const double ratio = values.col(j).cwiseAbs().maxCoeff() / weight;
      constexpr double kNear = 10;
      if (ratio > 1 / kNear && ratio < kNear) {
        sure = kSure;
        why = fmt::format("the robot's weight takes up to {:.4g} N m of joint {}, as here", weight,
                          j + 1);
      } else if (ratio > 1000 / kNear && ratio < 1000 * kNear) {
        unit = "mN m";
        sure = kLikely;
        why = fmt::format("a thousand times the robot's weight ({:.4g} N m)", weight);
      } else {
        asks = true;
        why = fmt::format(
            "joint {} reaches {:.4g}, its weight takes {:.4g} N m: the motor's side, "
            "percent, or another unit",
            j + 1, values.col(j).cwiseAbs().maxCoeff(), weight);
      }
    }
  }
  if (asks) {
    question(fmt::format("in which unit are the torques ({})?", why));
    line(fmt::format("torque: {{{}, unit: \"?\"}}", columns_of(*chosen)));
    return;
  }
  reason(sure,
         fmt::format("{} by name; unit {}: {}",
                     chosen->family.pattern.empty() ? "the last block" : chosen->family.pattern,
                     unit, why));
  note_torque_lag(values);
  line(fmt::format("torque: {{{}, unit: {}}}", columns_of(*chosen), unit));
}

void MapGuess::guess_temperature() {
  for (const Candidate& candidate : candidates_) {
    if (candidate.role != ColumnRole::kTemperature || !candidate.commanded.empty()) continue;
    used_.push_back(&candidate);
    reason(kLikely, fmt::format("{} by name", candidate.family.pattern));
    line(fmt::format("temperature: {{{}}}", columns_of(candidate)));
    return;
  }
}

void MapGuess::note_others() {
  std::vector<std::string> commanded, flags;
  for (const Candidate& candidate : candidates_) {
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

GuessedMap MapGuess::make() {
  if (logs_.tables.empty()) {
    throw ImportError(fmt::format("{}: error: found no rows, expected a log", logs_.paths.front()));
  }
  choose_names();
  find_candidates();
  name_headerless();
  count_joints();
  line(fmt::format("# Guessed from {}. Each guess has its reason; check them.",
                   fmt::join(logs_.paths, ", ")));
  if (logs_.paths.size() > 1) {
    line("files:");
    for (std::size_t i = 0; i < logs_.paths.size(); ++i) {
      const std::string& path = logs_.paths[i];
      line(fmt::format("  file{}: {}", i + 1, yaml_text(path.substr(path.find_last_of('/') + 1))));
    }
  }
  if (!names_.empty()) {
    const bool by_name =
        std::any_of(candidates_.begin(), candidates_.end(), [](const Candidate& one) {
          return one.family.pattern.find("{joint}") != std::string::npos;
        });
    if (by_name) {
      std::string names;
      for (const std::string& name : names_) {
        names += (names.empty() ? "" : ", ") + yaml_text(name);
      }
      reason(names_ == robot_.joints.names ? kSure : kLikely,
             names_ == robot_.joints.names
                 ? "the robot's joints have these names"
                 : "the log names its joints so, in this order; is it that of the robot file?");
      line("joints: [" + names + "]");
    }
  }
  guess_time();
  guess_position();
  guess_velocity();
  guess_torque();
  guess_temperature();
  note_others();
  GuessedMap map;
  map.questions = questions_;
  if (questions_ > 0) {
    lines_.insert(lines_.begin() + 1, fmt::format("# {} question{} to be answered: look for \"?\".",
                                                  questions_, questions_ == 1 ? " is" : "s are"));
  }
  map.yaml = fmt::format("{}\n", fmt::join(lines_, "\n"));
  return map;
}

}  // namespace

GuessedMap guess_map(const SampledLog& logs, const GuessRobot& robot) {
  return MapGuess(logs, robot).make();
}

}  // namespace dyngen::runtime

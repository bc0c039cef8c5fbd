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
#include "runtime/import/guess/map_guess.h"
#include "runtime/import/guess/name_endings.h"
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
}  // namespace

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
int MapGuess::bits_of(const SignalCandidate& candidate) const {
  int bits = 0;
  for (const std::size_t column : candidate.family.columns) {
    UnsignedWatch watch;
    for (const double value :
         logs_.tables[candidate.table].values.col(static_cast<Index>(column))) {
      watch.look(value);
    }
    bits = std::max(bits, watch.bits());
  }
  return bits;
}

MatrixXd MapGuess::values_of(const SignalCandidate& candidate) const {
  const MatrixXd& all = logs_.tables[candidate.table].values;
  MatrixXd values(all.rows(), static_cast<Index>(candidate.family.columns.size()));
  for (Index j = 0; j < values.cols(); ++j) {
    values.col(j) =
        all.col(static_cast<Index>(candidate.family.columns[static_cast<std::size_t>(j)]));
  }
  const int bits = bits_of(candidate);
  values = values.unaryExpr([bits](double value) { return signed_value(value, bits); }).eval();
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

std::string MapGuess::columns_of(const SignalCandidate& candidate) const {
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
  if (const int bits = bits_of(candidate); bits > 0) text += fmt::format(", bits: {}", bits);
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
  find_name_columns();
}

void MapGuess::find_candidates() {
  for (std::size_t t = 0; t < logs_.tables.size(); ++t) {
    const LogTable& table = logs_.tables[t].table;
    for (ColumnFamily& family : column_families(table.columns, names_)) {
      SignalCandidate candidate;
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
      order_by_names(t, family);
      std::vector<std::string> words = family.words;
      // a variable of its own is called like its table
      if (table.columns.size() == family.columns.size() && !table.name.empty()) {
        const std::vector<std::string> more = words_of(table.name);
        words.insert(words.end(), more.begin(), more.end());
      }
      std::optional<ColumnRole> role = role_of_words(words);
      if (candidate.unit.empty()) {
        if (const auto ending = unit_ending(family.pattern, role)) {
          candidate.unit = ending->unit;
          candidate.unit_ending = ending->ending;
        }
      }
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
    SignalCandidate clock;
    clock.role = ColumnRole::kTime;
    clock.family.pattern = names[static_cast<std::size_t>(time)];
    clock.family.columns = {static_cast<std::size_t>(time)};
    candidates_.push_back(std::move(clock));
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
    SignalCandidate candidate;
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
  for (const SignalCandidate& candidate : candidates_) {
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
                    "(docs/reference/import.md)",
                    logs_.paths.front(), listed(names)));
  }
}

/// One that is measured and has a column for each joint; null and a question where several do.
const SignalCandidate* MapGuess::choose(ColumnRole role, const char* key) {
  std::vector<const SignalCandidate*> fitting;
  for (const SignalCandidate& candidate : candidates_) {
    if (candidate.role == role && candidate.commanded.empty() &&
        candidate.family.columns.size() == joints_) {
      fitting.push_back(&candidate);
    }
  }
  const auto prefer = [&](const auto& is_better) {
    std::vector<const SignalCandidate*> better;
    std::copy_if(fitting.begin(), fitting.end(), std::back_inserter(better), is_better);
    if (!better.empty()) fitting = better;
  };
  const auto has = [](const SignalCandidate* one, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* word) {
      return std::find(one->family.words.begin(), one->family.words.end(), word) !=
             one->family.words.end();
    });
  };
  if (fitting.size() > 1) {
    prefer([&](const SignalCandidate* one) {
      return has(one, {"actual", "act", "ist", "measured", "meas", "msr"});
    });
  }
  if (fitting.empty()) return nullptr;
  if (fitting.size() == 1) return fitting.front();
  std::vector<std::string> patterns;
  for (const SignalCandidate* one : fitting) patterns.push_back(one->family.pattern);
  question(fmt::format("which columns are the {}: {}?", key, listed(patterns)));
  const bool told = std::all_of(fitting.begin(), fitting.end(),
                                [](const SignalCandidate* one) { return !one->unit.empty(); });
  line(fmt::format("{}: {{columns: \"?\"{}}}", key, told ? "" : ", unit: \"?\""));
  for (const SignalCandidate* one : fitting) used_.push_back(one);
  return nullptr;
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
        std::any_of(candidates_.begin(), candidates_.end(), [](const SignalCandidate& one) {
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
  note_name_columns();
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

GuessedMap guess_map(const SampledLog& logs, const GuessRobot& robot) {
  return MapGuess(logs, robot).make();
}

}  // namespace dyngen::runtime

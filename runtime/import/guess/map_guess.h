// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/import/guess/column_words.h"
#include "runtime/import/guess/guessed_map.h"
#include "runtime/plausibility/derivative_remarks.h"
#include "runtime/recordings/recording.h"

/// What guess_map() is made of: guessed_map.cpp has names, joints and time, guessed_signals.cpp
/// positions and what is judged beside them.
namespace dyngen::runtime {

/// How sure a guess is, per cent: for people, who check them.
inline constexpr int kTold = 99, kSure = 95, kLikely = 80, kPlausible = 70;

/// Columns that may be one signal.
struct SignalCandidate {
  std::size_t table = 0;
  ColumnFamily family;
  ColumnRole role = ColumnRole::kPosition;
  std::string unit;         ///< that the log says
  std::string unit_ending;  ///< of the name, if that says the unit: "_deg"; empty: the log does
  std::string commanded;    ///< the word by which it is no measurement
};

/// Columns with the names of the joints to which other columns of the message belong.
struct NameColumns {
  std::size_t table = 0;
  std::string pattern;             ///< "field.name{i}"
  std::string message;             ///< "field.": how names of its columns begin
  std::vector<std::string> names;  ///< as they stand
  std::vector<std::size_t> order;  ///< of the robot's joints: places in names
  bool of_robot = false;           ///< the robot file has these names
};

/// A text fit for YAML's double quotes, in them.
std::string yaml_text(const std::string& text);
/// "[1, 2]"
std::string yaml_numbers(const std::vector<double>& values);

/// Writes a map line by line, each guess with its reason.
class MapGuess {
 public:
  MapGuess(const SampledLog& logs, const GuessRobot& robot) : logs_(logs), robot_(robot) {}

  GuessedMap make();

 private:
  void choose_names();
  void find_name_columns();
  void order_by_names(std::size_t table, ColumnFamily& family) const;
  void note_name_columns();
  void find_candidates();
  void name_headerless();
  void count_joints();
  void guess_time();
  [[nodiscard]] bool counts_rows(const SignalCandidate& candidate) const;
  bool guess_counter();
  std::string time_unit(const std::string& name, double step, std::string& reason);
  const SignalCandidate* choose(ColumnRole role, const char* key);
  void guess_position();
  void guess_velocity();
  void guess_torque();
  void guess_torque_of_motors();
  void guess_temperature();
  void note_others();
  void note_torque_lag(const Eigen::MatrixXd& torque);
  /// Of signed numbers that the log holds as unsigned ones; 0: it does not look so.
  [[nodiscard]] int bits_of(const SignalCandidate& candidate) const;
  [[nodiscard]] Eigen::MatrixXd values_of(const SignalCandidate& candidate) const;
  [[nodiscard]] std::string columns_of(const SignalCandidate& candidate) const;
  [[nodiscard]] std::vector<DerivativeFit> fits(const Eigen::MatrixXd& upper) const;

  /// Why a candidate has its unit, and how sure that is.
  static std::string why_unit(const SignalCandidate& candidate) {
    return candidate.unit_ending.empty()
               ? "the log says so"
               : fmt::format("'{}' is the end of its name", candidate.unit_ending);
  }
  static int sure_of_unit(const SignalCandidate& candidate) {
    return candidate.unit_ending.empty() ? kTold : kSure;
  }
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
  std::vector<NameColumns> name_columns_;
  std::vector<SignalCandidate> candidates_;
  std::vector<const SignalCandidate*> used_;
  std::vector<std::string> lines_;
  std::size_t joints_ = 0;
  int questions_ = 0;
  double step_ = 0;      ///< s; 0: not known
  Recording recording_;  ///< time and positions of the first rows, in SI units as guessed
  std::vector<double> gears_;
  std::string position_unit_;
};

}  // namespace dyngen::runtime

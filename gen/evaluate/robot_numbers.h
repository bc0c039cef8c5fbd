// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gen/evaluate/state_words.h"
#include "gen/generator/generator.h"
#include "gen/program/program.h"

namespace dyngen {

/// Samples of a motion, structure of arrays: q[e * samples + k] is joint e of sample k.
struct MotionArrays {
  std::size_t samples = 1;
  std::vector<double> q, dq, ddq;
};

/// A robot all of whose numbers are known, with its functions as programs: no compiler is needed.
///
/// The functions read the parameters of the file, not base parameters. Effects that have states
/// take them as P_reset() leaves them, and do not move them on.
class RobotNumbers {
 public:
  /// @param options  effects and their catalogue; all else is ignored
  /// @param given    numbers for what the file leaves unknown
  /// @throws ModelError  naming what is still unknown, or a given number that stands for nothing
  ///         unknown
  RobotNumbers(const RobotModel& model, const GeneratorOptions& options,
               const std::vector<GivenValue>& given = {});

  [[nodiscard]] bool has(const std::string& function) const;
  /// The first output of a function of the catalogue ("id", "fk_3"): element e of sample k at
  /// e * samples + k. @throws std::invalid_argument  if has() is false
  [[nodiscard]] std::vector<double> run(const std::string& function, const MotionArrays& motion);
  /// A parameter of a link, from 1.
  [[nodiscard]] double parameter(int link, Chi kind) const;

  [[nodiscard]] const RobotModel& model() const { return model_; }
  [[nodiscard]] const CodeModel& code() const { return *code_; }
  [[nodiscard]] std::size_t joints() const { return code_->coordinate_names.size(); }

 private:
  const Program& program(const std::string& function);

  RobotModel model_;  ///< with the given numbers
  std::unique_ptr<CodeModel> code_;
  std::vector<double> chi_;  ///< parameters of effects that the file leaves open
  std::map<std::string, Program> programs_;
};

}  // namespace dyngen

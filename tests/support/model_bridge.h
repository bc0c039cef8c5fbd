// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gen/generator/generator.h"
#include "gen/model/robot_model.h"
#include "gen/program/program.h"
#include "tests/support/numeric_robot.h"

/// Between the generator's robots and the judge's, and the generator's functions as plain calls.
namespace dyngen::test {

/// The model's numbers for the judge. @throws std::invalid_argument if something is unknown
NumericRobot numeric_robot(const RobotModel& model);

/// A model with the judge's numbers. Angles within 1e-12 of a multiple of pi/12 become exactly
/// that, since the numbers of an oracle cannot say "right angle".
RobotModel robot_model(const NumericRobot& robot, const std::string& name = "robot");

RobotModel read_model(const std::string& path_in_project);
RobotModel parse_model(const std::string& text);

/// Makes every inertial parameter (and rotor inertia and friction of moving joints) unknown.
RobotModel with_unknown_parameters(RobotModel model, bool inertial_only);

/// Gives every unknown quantity a random number; masses and friction are positive.
RobotModel with_random_values(RobotModel model, std::uint64_t seed);

/// Numbers in the code and at run time, each with base parameters and with the standard ones.
/// @param functions  empty: all
std::vector<GeneratorOptions> every_mode(const std::vector<std::string>& functions = {});

/// Coordinates to one entry per joint, as the judge wants them; 0 for fixed joints.
std::vector<double> per_joint(const RobotModel& model, const std::vector<double>& values);

/// The options with a short search for fewer operations: what is tested holds however long it is.
GeneratorOptions with_short_search(GeneratorOptions options);

/// Inputs of one sample, one value per coordinate; what a function does not read may be empty.
struct MotionSample {
  std::vector<double> q, dq, ddq;
  std::vector<double> tau{};
  std::vector<double> gravity{}, wrench{}, payload{};
  std::vector<double> weights{};  ///< A; no random sample has it, since its size is the model's

  /// By the name of the argument. @throws std::invalid_argument
  [[nodiscard]] const std::vector<double>& input(const std::string& name) const;
};
/// Samples in +-3 rad, +-3 rad/s, +-5 rad/s^2, +-20 N m; the first one is at rest in the zero
/// position. Gravity, wrench and payload are random too.
std::vector<MotionSample> random_samples(int coordinates, int count, std::uint64_t seed);

/// What the judge says of a sample, for the coordinates of the model (fixed joints left out).
std::vector<double> judge(const RobotModel& model, const NumericRobot& robot,
                          const std::string& function, const MotionSample& sample);

/// What effects with states remember between two calls: the members of <prefix>_state.
struct EffectState {
  std::vector<double> z, last;
  double step = 0, dt = 0;
};

/// A generated model that runs without a compiler.
class EvaluatedModel {
 public:
  /// @param values  a model with the same structure in which every quantity is known: where chi
  /// comes from; what a row `effect` leaves open is 0.25
  EvaluatedModel(const RobotModel& model, const RobotModel& values,
                 const GeneratorOptions& options);
  /// The model's own numbers.
  EvaluatedModel(const RobotModel& model, const GeneratorOptions& options)
      : EvaluatedModel(model, model, options) {}

  /// The function's first output, or the one of this name.
  [[nodiscard]] std::vector<double> call(const std::string& function, const MotionSample& sample,
                                         const std::string& output = {}) const;
  /// As <prefix>_reset makes it.
  [[nodiscard]] EffectState new_state(double dt) const;
  /// The first output of a function that takes a state, which is moved on.
  std::vector<double> advance(const std::string& function, const MotionSample& sample,
                              EffectState& state) const;
  [[nodiscard]] const CodeModel& code() const { return code_; }
  [[nodiscard]] const std::vector<RobotFunction>& functions() const { return functions_; }
  [[nodiscard]] const std::vector<double>& chi() const { return chi_; }
  [[nodiscard]] OperationCount count(const std::string& function) const;

 private:
  [[nodiscard]] std::size_t place(const std::string& function) const;
  [[nodiscard]] std::vector<double> run(const std::string& function, const MotionSample& sample,
                                        const std::string& output, EffectState* state) const;

  CodeModel code_;
  std::vector<double> chi_;
  std::vector<RobotFunction> functions_;
  std::vector<Program> programs_;
};

}  // namespace dyngen::test

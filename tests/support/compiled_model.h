// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/generator/generator.h"
#include "tests/support/model_bridge.h"
#include "tests/support/shared_object.h"

namespace dyngen::test {

/// A generated model as the compiler sees it: written, compiled to a shared object, loaded.
class CompiledModel {
 public:
  /// @throws std::runtime_error  with the compiler's messages if it does not compile silently
  /// @param flags, compiler  see SharedObject
  CompiledModel(const RobotModel& model, const GeneratorOptions& options,
                const std::string& flags = "-std=c99 -O2 -ffp-contract=off",
                const std::string& compiler = "cc");

  /// @param chi  ignored by models whose functions take none
  /// @return the function's first output, or the one of this name
  [[nodiscard]] std::vector<double> call(const std::string& function, const MotionSample& sample,
                                         const std::vector<double>& chi,
                                         const std::string& output = {}) const;
  /// The same with one array for ddq and tau: the last input of `id` before chi.
  [[nodiscard]] std::vector<double> call_in_place(const std::string& function,
                                                  const MotionSample& sample,
                                                  const std::vector<double>& chi) const;
  /// What <prefix>_reset makes of a state full of other numbers.
  [[nodiscard]] EffectState new_state(double dt) const;
  /// The first output of a function that takes a state, which is moved on.
  std::vector<double> advance(const std::string& function, const MotionSample& sample,
                              const std::vector<double>& chi, EffectState& state) const;
  /// The table of the file's numbers that stands in the code.
  [[nodiscard]] std::vector<double> chi_values() const;

 private:
  [[nodiscard]] void* symbol(const std::string& name) const;

  std::string prefix_;
  SharedObject library_;
  CodeModel code_;
  bool single_ = false;
};

}  // namespace dyngen::test

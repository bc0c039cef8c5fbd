// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gen/effect_file/effect_file.h"

namespace dyngen::test {

/// Value of a variable or parameter of an effect.
using NumericValues = std::function<double(const std::string& name)>;

/// The value of an expression, straight from its tree: sign(0) = 0.
double numeric_value(const EffectExpression& expression, const NumericValues& values);

/// The torque of an effect and the step of its states, without any algebra: derivatives of the
/// rates are central differences.
class EffectJudge {
 public:
  /// @param values  of parameters
  EffectJudge(const EffectFile& effect, NumericValues parameters);

  /// @param now     variables of this call     @param step  s; 0: the states stay
  /// @return        one value, or two of a pair
  std::vector<double> torque(const NumericValues& now, double step);

  [[nodiscard]] const std::vector<double>& states() const { return states_; }

 private:
  [[nodiscard]] double value(const EffectExpression& expression,
                             const NumericValues& variables) const;
  void move_states(const NumericValues& now, double step);

  const EffectFile& effect_;
  NumericValues parameters_;
  std::vector<double> states_;
  std::vector<double> last_;  // of the effect's variables
};

}  // namespace dyngen::test

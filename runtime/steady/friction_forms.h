// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/rules/steady_rules.h"
#include "runtime/steady/steady_levels.h"

namespace dyngen::runtime {

/// What may come to Coulomb and viscous friction.
enum class FrictionTerm {
  kStribeck,   ///< (Fs - Fc) exp(-(|v|/vs)^delta) sign(v), Fs >= Fc
  kPower,      ///< c |v|^p sign(v) instead of Fv v
  kAsymmetry,  ///< dFv |v|: viscous friction that differs between the directions
};
inline constexpr int kFrictionTerms = 3;
/// "stribeck", "power", "asymmetry"
std::string_view term_name(FrictionTerm term);

/// A set of terms.
struct FrictionTerms {
  unsigned bits = 0;
  [[nodiscard]] bool has(FrictionTerm term) const {
    return (bits >> static_cast<unsigned>(term) & 1U) != 0;
  }
  [[nodiscard]] FrictionTerms with(FrictionTerm term) const {
    return {bits | 1U << static_cast<unsigned>(term)};
  }
  [[nodiscard]] FrictionTerms without(FrictionTerm term) const {
    return {bits & ~(1U << static_cast<unsigned>(term))};
  }
  [[nodiscard]] bool holds(FrictionTerms other) const { return (bits | other.bits) == bits; }
  bool operator==(const FrictionTerms&) const = default;
};

/// "Coulomb + viscous + Stribeck"
std::string words_of(FrictionTerms terms);

/// A parameter with its 95 % interval.
struct FrictionNumber {
  std::string name, unit;
  double value = 0, low = 0, high = 0;
};

/// A form of friction, fitted to the levels.
struct FrictionForm {
  FrictionTerms terms;
  bool fitted = false;  ///< there are levels enough
  double chi_square = 0;
  int parameters = 0;  ///< that were fitted, the constant torque of each posture among them
  double vs = 0, delta = 0, power = 1;
  Eigen::VectorXd linear;  ///< constant torques; Fc; Fv or c; Fs - Fc; dFv
};

/// A term that is added to a form, or not.
struct TermTest {
  FrictionTerm term = FrictionTerm::kStribeck;
  FrictionTerms beside;  ///< the form that it would join
  double ratio = 0;      ///< of the chi-square that it takes away to the scatter that is left
  double below = 0;      ///< degrees of the denominator; the numerator has one
  int tried = 1;         ///< shapes
  double chance = 1;     ///< of such a ratio without the term, times the shapes
  bool kept = false;
};

/// The forms that competed on the levels of a joint.
struct FrictionForms {
  bool judged = false;
  std::string why_not;              ///< a sentence where they are not
  std::vector<FrictionForm> forms;  ///< of all sets of terms, by their bits
  FrictionTerms chosen;
  std::vector<TermTest> tests;          ///< the last one of each term
  std::vector<FrictionNumber> numbers;  ///< of the chosen form
  std::vector<FrictionTerms> rivals;    ///< that are not ruled out, of as many parameters at most
  std::vector<double> other_exponents;  ///< of the Stribeck curve that are not ruled out
  double scatter = 1;                   ///< chi-square of the chosen form over its degrees
  int degrees = 1;                      ///< of intervals and of F

  [[nodiscard]] const FrictionForm& form() const { return forms[chosen.bits]; }
};

/// Friction of a form at a speed, without constant torque.
double friction_at(const FrictionForm& form, int postures, double speed);

/// Generalised least squares of every form; terms join one by one while Fisher's F keeps them.
FrictionForms compete_forms(const SteadyLevels& levels, bool revolute, const SteadyRules& rules);

}  // namespace dyngen::runtime

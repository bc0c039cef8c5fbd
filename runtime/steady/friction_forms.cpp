// SPDX-License-Identifier: MIT
#include "runtime/steady/friction_forms.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSure = 0.95;
constexpr std::array<FrictionTerm, kFrictionTerms> kTerms = {
    FrictionTerm::kStribeck, FrictionTerm::kPower, FrictionTerm::kAsymmetry};
// exponents of the Stribeck curve: Bo and Pavelescu 1982 (0.5, 1); Armstrong-Helouvry 1991 (2)
constexpr std::array<double, 3> kExponents = {0.5, 1, 2};

double sign_of(double v) { return v > 0 ? 1 : -1; }

double fall_at(double v, double vs, double delta) {
  return std::exp(-std::pow(std::abs(v) / vs, delta)) * sign_of(v);
}
double power_at(double v, double power) { return std::pow(std::abs(v), power) * sign_of(v); }

/// Shapes that are tried.
struct Shape {
  double vs = 0, delta = 0, power = 1;
};

/// Fits forms to levels that were made independent.
class FormFits {
 public:
  explicit FormFits(const SteadyLevels& levels)
      : postures_(levels.postures), speed_(static_cast<Index>(levels.levels.size())) {
    const Index count = speed_.size();
    VectorXd torque(count);
    MatrixXd constant = MatrixXd::Zero(count, postures_);
    for (Index r = 0; r < count; ++r) {
      const SteadyLevel& own = levels.levels[static_cast<std::size_t>(r)];
      speed_[r] = own.run.speed;
      torque[r] = own.torque;
      constant(r, own.posture) = 1;
    }
    // a recording without any noise has a singular covariance
    constexpr double kLeast = 1e-10;
    const double add =
        std::max(kLeast * levels.covariance.diagonal().mean(), std::numeric_limits<double>::min());
    whiten_.compute(levels.covariance + add * MatrixXd::Identity(count, count));
    y_ = white(torque);
    constant_ = white(constant);
    coulomb_ = white(speed_.unaryExpr(&sign_of));
    viscous_ = white(speed_);
    asymmetric_ = white(speed_.cwiseAbs());
  }

  [[nodiscard]] Index levels() const { return speed_.size(); }

  [[nodiscard]] int parameters(FrictionTerms terms) const {
    int count = postures_ + 2;
    if (terms.has(FrictionTerm::kStribeck)) count += 2;
    if (terms.has(FrictionTerm::kPower)) count += 1;
    if (terms.has(FrictionTerm::kAsymmetry)) count += 1;
    return count;
  }

  /// Speeds of the fall: those that the speeds of the runs can show.
  [[nodiscard]] std::vector<double> falls() const {
    constexpr double kFactor = 1.3, kLeast = 0.5, kMost = 0.5;
    std::vector<double> all;
    const double last = kMost * speed_.cwiseAbs().maxCoeff();
    for (double vs = kLeast * speed_.cwiseAbs().minCoeff(); vs < last; vs *= kFactor) {
      all.push_back(vs);
    }
    return all;
  }

  /// The best of all shapes of a form. @param exponents  of the Stribeck curve
  [[nodiscard]] FrictionForm fit(FrictionTerms terms, const std::vector<double>& exponents) const {
    FrictionForm best;
    best.terms = terms;
    best.parameters = parameters(terms);
    if (levels() < best.parameters + 2) return best;
    best.chi_square = std::numeric_limits<double>::infinity();
    const std::vector<double> none = {0};
    const std::vector<double> speeds = terms.has(FrictionTerm::kStribeck) ? falls() : none;
    const std::vector<double> deltas = terms.has(FrictionTerm::kStribeck) ? exponents : none;
    const std::vector<double> powers =
        terms.has(FrictionTerm::kPower)
            ? std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.2, 1.5, 2, 2.5, 3}
            : std::vector<double>{1};
    for (const double delta : deltas) {
      for (const double vs : speeds) {
        for (const double power : powers) take_better(best, {vs, delta, power});
      }
    }
    refine(best);
    return best;
  }

  /// Derivatives of the whitened levels by all parameters: linear, log vs, p.
  [[nodiscard]] MatrixXd jacobian(const FrictionForm& form) const {
    const MatrixXd X = columns(form.terms, {form.vs, form.delta, form.power});
    const Index stribeck = postures_ + 2;
    MatrixXd J(X.rows(), form.parameters);
    J.leftCols(X.cols()) = X;
    Index next = X.cols();
    if (form.terms.has(FrictionTerm::kStribeck)) {
      const double excess = form.linear[stribeck];
      J.col(next++) = white(speed_.unaryExpr([&](double v) {
        return excess * fall_at(v, form.vs, form.delta) * form.delta *
               std::pow(std::abs(v) / form.vs, form.delta);
      }));
    }
    if (form.terms.has(FrictionTerm::kPower)) {
      const double c = form.linear[postures_ + 1];
      J.col(next++) = white(speed_.unaryExpr(
          [&](double v) { return c * power_at(v, form.power) * std::log(std::abs(v)); }));
    }
    return J;
  }

 private:
  [[nodiscard]] MatrixXd white(const MatrixXd& columns) const {
    return whiten_.matrixL().solve(columns);
  }

  [[nodiscard]] MatrixXd columns(FrictionTerms terms, const Shape& shape) const {
    const bool stribeck = terms.has(FrictionTerm::kStribeck);
    const bool asymmetric = terms.has(FrictionTerm::kAsymmetry);
    MatrixXd X(levels(), postures_ + 2 + (stribeck ? 1 : 0) + (asymmetric ? 1 : 0));
    X.leftCols(postures_) = constant_;
    X.col(postures_) = coulomb_;
    if (terms.has(FrictionTerm::kPower)) {
      X.col(postures_ + 1) =
          white(speed_.unaryExpr([&](double v) { return power_at(v, shape.power); }));
    } else {
      X.col(postures_ + 1) = viscous_;
    }
    if (stribeck) {
      X.col(postures_ + 2) =
          white(speed_.unaryExpr([&](double v) { return fall_at(v, shape.vs, shape.delta); }));
    }
    if (asymmetric) X.rightCols(1) = asymmetric_;
    return X;
  }

  void take_better(FrictionForm& best, const Shape& shape) const {
    const MatrixXd X = columns(best.terms, shape);
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(X);
    if (qr.rank() < X.cols()) return;
    VectorXd linear = qr.solve(y_);
    if (best.terms.has(FrictionTerm::kStribeck) && linear[postures_ + 2] < 0) return;
    const double left = (y_ - X * linear).squaredNorm();
    if (!(left < best.chi_square)) return;
    best.fitted = true;
    best.chi_square = left;
    best.linear = std::move(linear);
    best.vs = shape.vs;
    best.delta = shape.delta;
    best.power = shape.power;
  }

  /// Smaller and smaller steps of vs and p to both sides.
  void refine(FrictionForm& best) const {
    if (!best.fitted) return;
    constexpr int kHalvings = 16;
    double ratio = 1.15, step = 0.05;
    for (int i = 0; i < kHalvings; ++i) {
      bool better = true;
      for (int moves = 0; better && moves < 4; ++moves) {
        const double before = best.chi_square;
        if (best.terms.has(FrictionTerm::kStribeck)) {
          take_better(best, {best.vs * ratio, best.delta, best.power});
          take_better(best, {best.vs / ratio, best.delta, best.power});
        }
        if (best.terms.has(FrictionTerm::kPower)) {
          constexpr double kLeastPower = 0.05;
          take_better(best, {best.vs, best.delta, best.power + step});
          take_better(best, {best.vs, best.delta, std::max(kLeastPower, best.power - step)});
        }
        better = best.chi_square < before;
      }
      ratio = std::sqrt(ratio);
      step /= 2;
    }
  }

  int postures_;
  VectorXd speed_, y_;
  Eigen::LLT<MatrixXd> whiten_;
  MatrixXd constant_, coulomb_, viscous_, asymmetric_;
};

/// Chi-square over degrees, where it is above what noise alone makes.
double scale_of(const FrictionForm& form, Index levels) {
  return std::max(1.0, form.chi_square / static_cast<double>(levels - form.parameters));
}

class FormCompetition {
 public:
  FormCompetition(const SteadyLevels& levels, const SteadyRules& rules)
      : fits_(levels), noise_degrees_(levels.degrees), rules_(rules) {
    const std::vector<double> exponents(kExponents.begin(), kExponents.end());
    for (unsigned bits = 0; bits < 1U << kFrictionTerms; ++bits) {
      result_.forms.push_back(fits_.fit({bits}, exponents));
    }
  }

  FrictionForms run(int postures, bool revolute) {
    result_.judged = true;
    choose();
    const FrictionForm& form = result_.form();
    result_.scatter = form.chi_square / static_cast<double>(fits_.levels() - form.parameters);
    result_.degrees = degrees_of(form);
    for (const FrictionForm& other : result_.forms) {
      if (!other.fitted || other.terms.holds(form.terms)) continue;
      if (other.parameters > form.parameters) continue;
      if (other.chi_square - form.chi_square < rules_.rival * scale_of(form, fits_.levels())) {
        result_.rivals.push_back(other.terms);
      }
    }
    for (const double delta : kExponents) {
      if (!form.terms.has(FrictionTerm::kStribeck) || delta == form.delta) continue;
      const FrictionForm other = fits_.fit(form.terms, {delta});
      if (other.fitted &&
          other.chi_square - form.chi_square < rules_.rival * scale_of(form, fits_.levels())) {
        result_.other_exponents.push_back(delta);
      }
    }
    add_numbers(form, postures, revolute);
    return std::move(result_);
  }

 private:
  [[nodiscard]] int degrees_of(const FrictionForm& form) const {
    return std::max(1,
                    std::min(noise_degrees_, static_cast<int>(fits_.levels()) - form.parameters));
  }

  [[nodiscard]] TermTest test(FrictionTerm term, FrictionTerms beside) const {
    TermTest test{term, beside, 0, 0, 1, 1, false};
    if (term == FrictionTerm::kStribeck) {
      test.tried = static_cast<int>(fits_.falls().size() * kExponents.size());
    }
    const FrictionForm &small = result_.forms[beside.bits],
                       &large = result_.forms[beside.with(term).bits];
    if (!small.fitted || !large.fitted) return test;
    test.ratio =
        std::max(0.0, small.chi_square - large.chi_square) / scale_of(large, fits_.levels());
    test.below = degrees_of(large);
    test.chance = std::min(1.0, test.tried * variance_ratio_tail(test.ratio, 1, test.below));
    return test;
  }

  /// Terms join while their chance is small; one that another makes superfluous goes.
  void choose() {
    FrictionTerms terms;
    for (int step = 0; step < kFrictionTerms; ++step) {
      TermTest best;
      bool any = false;
      for (const FrictionTerm term : kTerms) {
        if (terms.has(term)) continue;
        const TermTest own = test(term, terms);
        if (!any || own.chance < best.chance ||
            (own.chance == best.chance && own.ratio > best.ratio)) {
          best = own;
        }
        any = true;
      }
      if (!any || !(best.chance < rules_.chance)) break;
      terms = terms.with(best.term);
      for (const FrictionTerm term : kTerms) {
        if (term == best.term || !terms.has(term)) continue;
        if (!(test(term, terms.without(term)).chance < rules_.chance)) terms = terms.without(term);
      }
    }
    result_.chosen = terms;
    for (const FrictionTerm term : kTerms) {
      result_.tests.push_back(test(term, terms.without(term)));
      result_.tests.back().kept = terms.has(term);
    }
  }

  void add_numbers(const FrictionForm& form, int postures, bool revolute) {
    const MatrixXd J = fits_.jacobian(form);
    const MatrixXd covariance =
        scale_of(form, fits_.levels()) *
        (J.transpose() * J).completeOrthogonalDecomposition().pseudoInverse();
    const double t = student_interval(kSure, degrees_of(form));
    const std::string torque = revolute ? "N m" : "N", rate = revolute ? "rad/s" : "m/s";
    const auto add = [&](const std::string& name, const std::string& unit, const VectorXd& weights,
                         double value) {
      const double half = t * std::sqrt(std::max(0.0, weights.dot(covariance * weights)));
      result_.numbers.push_back({name, unit, value, value - half, value + half});
    };
    const auto unit = [&](Index place) -> VectorXd {
      return VectorXd::Unit(form.parameters, place);
    };
    const Index coulomb = postures, viscous = postures + 1, stribeck = postures + 2;
    const Index linear = form.linear.size();
    add("Fc", torque, unit(coulomb), form.linear[coulomb]);
    const bool falls = form.terms.has(FrictionTerm::kStribeck);
    if (falls) {
      add("Fs", torque, unit(coulomb) + unit(stribeck),
          form.linear[coulomb] + form.linear[stribeck]);
      const double half = t * std::sqrt(covariance(linear, linear));
      result_.numbers.push_back(
          {"vs", rate, form.vs, form.vs * std::exp(-half), form.vs * std::exp(half)});
      result_.numbers.push_back({"delta", "1", form.delta, form.delta, form.delta});
    }
    if (form.terms.has(FrictionTerm::kPower)) {
      add("c", torque + "/(" + rate + ")^p", unit(viscous), form.linear[viscous]);
      add("p", "1", unit(linear + (falls ? 1 : 0)), form.power);
    } else {
      add("Fv", torque + "/(" + rate + ")", unit(viscous), form.linear[viscous]);
    }
    if (form.terms.has(FrictionTerm::kAsymmetry)) {
      add("dFv", torque + "/(" + rate + ")", unit(linear - 1), form.linear[linear - 1]);
    }
  }

  FormFits fits_;
  int noise_degrees_;
  const SteadyRules& rules_;
  FrictionForms result_;
};

/// Why nothing can be said; empty: it can.
std::string reason_against(const SteadyLevels& levels) {
  constexpr std::size_t kFewest = 6;
  constexpr double kWidth = 1.5;  // of the fastest to the slowest speed
  if (levels.levels.size() < kFewest) {
    return fmt::format("It has {} runs of constant speed; {} are needed for a form of friction.",
                       levels.levels.size(), kFewest);
  }
  double slow = std::numeric_limits<double>::infinity(), fast = 0;
  std::vector<int> directions(static_cast<std::size_t>(levels.postures), 0);
  for (const SteadyLevel& own : levels.levels) {
    slow = std::min(slow, std::abs(own.run.speed));
    fast = std::max(fast, std::abs(own.run.speed));
    directions[static_cast<std::size_t>(own.posture)] |= own.run.speed > 0 ? 1 : 2;
  }
  if (std::find(directions.begin(), directions.end(), 3) == directions.end()) {
    return "No posture has runs in both directions, and a constant torque cannot be told from "
           "Coulomb friction. Record both directions.";
  }
  if (fast < kWidth * slow) {
    return fmt::format(
        "Its speeds are all near {:.3g}; record some that are apart by a factor of {:.1f} or more.",
        fast, kWidth);
  }
  return {};
}

}  // namespace

std::string_view term_name(FrictionTerm term) {
  switch (term) {
    case FrictionTerm::kStribeck:
      return "stribeck";
    case FrictionTerm::kPower:
      return "power";
    case FrictionTerm::kAsymmetry:
      return "asymmetry";
  }
  return "";
}

std::string words_of(FrictionTerms terms) {
  std::string words =
      terms.has(FrictionTerm::kPower) ? "Coulomb + power of the speed" : "Coulomb + viscous";
  if (terms.has(FrictionTerm::kStribeck)) words += " + Stribeck";
  if (terms.has(FrictionTerm::kAsymmetry)) words += " + viscous asymmetry";
  return words;
}

double friction_at(const FrictionForm& form, int postures, double speed) {
  const Index first = postures;
  double sum =
      form.linear[first] * sign_of(speed) + form.linear[first + 1] * power_at(speed, form.power);
  if (form.terms.has(FrictionTerm::kStribeck)) {
    sum += form.linear[first + 2] * fall_at(speed, form.vs, form.delta);
  }
  if (form.terms.has(FrictionTerm::kAsymmetry)) {
    sum += form.linear[form.linear.size() - 1] * std::abs(speed);
  }
  return sum;
}

FrictionForms compete_forms(const SteadyLevels& levels, bool revolute, const SteadyRules& rules) {
  FrictionForms refused;
  refused.why_not = reason_against(levels);
  if (!refused.why_not.empty()) return refused;
  FormCompetition competition(levels, rules);
  FrictionForms result = competition.run(levels.postures, revolute);
  return result;
}

}  // namespace dyngen::runtime

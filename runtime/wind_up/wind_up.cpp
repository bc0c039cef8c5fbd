// SPDX-License-Identifier: MIT
#include "runtime/wind_up/wind_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "runtime/estimation/distributions.h"
#include "runtime/wind_up/wind_up_fit.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kIntervalOfNumbers = 0.95;

double rms_of(const VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(std::max<Index>(1, values.size())));
}

void check(const WindUpData& data) {
  const Index n = data.wind_up.size();
  for (const VectorXd* own : {&data.q, &data.dq, &data.ddq, &data.load}) {
    if (own->size() == n) continue;
    throw std::invalid_argument(fmt::format(
        "analyse_wind_up(): found {} samples beside {} of the wind-up, expected as many",
        own->size(), n));
  }
  if (!(data.sample_time > 0) || data.run_starts.empty() || data.run_starts.front() != 0) {
    throw std::invalid_argument(
        "analyse_wind_up(): expected a positive sample_time and run_starts from 0 on");
  }
}

/// What a fit says, with intervals.
class WindUpAnswer {
 public:
  explicit WindUpAnswer(const WindUpFit& joint)
      : joint_(joint), data_(joint.data()), rules_(joint.rules()), fit_(joint.fit()) {}

  WindUpResult run();

 private:
  /// With what the load's model does not know. @param D  of the fit
  void add_model_noise(RobustRegression& fit, const MatrixXd& D) const {
    if (!data_.load_products) return;
    const LoadProducts products = data_.load_products(D);
    const MatrixXd gain = -fit.beta[WindUpFit::kLoad] * fit.inverse * products.with_columns;
    fit.covariance += gain * data_.load_covariance * gain.transpose();
  }

  [[nodiscard]] WindUpNumber number(double value, double deviation, double chance) const {
    WindUpNumber own;
    const double half = student_interval(kIntervalOfNumbers, fit_.degrees) * deviation;
    own.value = value;
    own.low = value - half;
    own.high = value + half;
    own.chance = chance;
    own.seen = chance <= rules_.chance;
    own.below = std::abs(value) + half;
    return own;
  }
  [[nodiscard]] WindUpNumber number(const RobustRegression& fit, Index place, double factor) const {
    return number(factor * fit.beta[place], std::abs(factor) * fit.deviation(place),
                  fit.chance(place));
  }

  void answer_load(const MatrixXd& D, const MatrixXd& noise_alone);
  void answer_slow();
  void answer_term(WindUpTerm::Kind kind, WindUpNumber& number);
  void answer_lines();
  void answer_rotor();
  void show(const MatrixXd& D);

  const WindUpFit& joint_;
  const WindUpData& data_;
  const WindUpRules& rules_;
  RobustRegression fit_;  ///< with what the load's model does not know
  WindUpResult result_;
};

WindUpResult WindUpAnswer::run() {
  const MatrixXd D = joint_.columns(joint_.terms());
  const MatrixXd noise_alone = fit_.covariance;
  add_model_noise(fit_, D);
  result_.judged = true;
  result_.least_order = joint_.orders().least;
  result_.most_order = joint_.orders().most;
  result_.lines_below = joint_.orders().below;
  result_.degrees = fit_.degrees;
  result_.residual = rms_of(fit_.residual);
  result_.delay = number(fit_, WindUpFit::kDelay, 1);
  answer_load(D, noise_alone);
  answer_slow();
  answer_term(WindUpTerm::Kind::kHysteresis, result_.hysteresis);
  answer_term(WindUpTerm::Kind::kBacklash, result_.backlash);
  answer_term(WindUpTerm::Kind::kHardening, result_.hardening);
  result_.backlash_decided = joint_.reverses(joint_.net_load());
  answer_lines();
  answer_rotor();
  show(D);
  return std::move(result_);
}

void WindUpAnswer::answer_load(const MatrixXd& D, const MatrixXd& noise_alone) {
  // the load less what the other columns explain
  MatrixXd others(D.rows(), D.cols() - 1);
  others << D.leftCols(WindUpFit::kLoad), D.rightCols(D.cols() - WindUpFit::kLoad - 1);
  const RobustRegression beside = robust_regression(others, D.col(WindUpFit::kLoad), 1);
  const VectorXd centred = D.col(WindUpFit::kLoad).array() - D.col(WindUpFit::kLoad).mean();
  result_.load_own = rms_of(beside.residual);
  const double whole = rms_of(centred);
  result_.load_explained = whole > 0 ? 1 - std::pow(result_.load_own / whole, 2) : 1;
  const double variance = fit_.covariance(WindUpFit::kLoad, WindUpFit::kLoad);
  result_.model_share =
      variance > 0 ? 1 - noise_alone(WindUpFit::kLoad, WindUpFit::kLoad) / variance : 0;
  if (data_.load_products) {
    // errors of the load are errors in a variable: they make the compliance smaller
    const LoadProducts products = data_.load_products(others);
    const MatrixXd left =
        products.own - products.with_columns.transpose() * beside.inverse * products.with_columns;
    const double errors = (data_.load_covariance * left).trace();
    result_.attenuation = std::clamp(errors / beside.residual.squaredNorm(), 0.0, 1.0);
  }
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!(result_.load_own > rules_.least_own * whole)) {
    result_.compliance = {0, -kInfinite, kInfinite, 1, false, kInfinite};
    result_.stiffness = {0, 0, kInfinite, 1, false, 0};
    result_.remarks.push_back(
        "Speed, position and acceleration of the joint explain its whole load, so the stiffness "
        "is not determined. Move other joints too, or carry another payload.");
    return;
  }
  WindUpNumber& c = result_.compliance;
  c = number(fit_, WindUpFit::kLoad, 1);
  if (result_.attenuation < 1) {
    if (c.high > 0) c.high /= 1 - result_.attenuation;
  } else {
    c.high = kInfinite;
  }
  c.below = std::max(c.below, c.high);
  WindUpNumber& k = result_.stiffness;
  k.chance = c.chance;
  k.seen = c.seen && c.value > 0;
  k.value = c.value != 0 ? 1 / c.value : kInfinite;
  k.low = c.high > 0 ? 1 / c.high : kInfinite;
  k.high = c.low > 0 ? 1 / c.low : kInfinite;
  k.below = k.low;  // a bound from below: stiffer than that
  constexpr double kMostExplained = 0.9, kWide = 1.5;
  if (!k.seen) {
    std::string why =
        c.value < 0 && c.seen
            ? "The wind-up runs against the torque: the sign of tau, or which encoder is q, may be "
              "wrong."
            : fmt::format(
                  "The stiffness is not determined, but for its least value: {:.3g} {} of the load "
                  "({:.0f} %) vary apart from speed{} of the joint.",
                  result_.load_own, data_.revolute ? "N m" : "N",
                  100 * (1 - result_.load_explained), data_.rotor_open ? " and acceleration" : "");
    result_.remarks.push_back(std::move(why));
  } else if (result_.load_explained > kMostExplained && k.high > kWide * k.low) {
    result_.remarks.push_back(fmt::format(
        "Speed, position{} explain {:.0f} % of the load; what is left makes the interval wide.",
        data_.rotor_open ? " and acceleration" : "", 100 * result_.load_explained));
  }
}

void WindUpAnswer::answer_slow() {
  const Index degree = joint_.slow().cols();
  const VectorXd beta = fit_.beta.segment(WindUpFit::kSlow, degree);
  const VectorXd course = joint_.slow() * beta;
  Index high = 0, low = 0;
  course.maxCoeff(&high);
  course.minCoeff(&low);
  const VectorXd between = (joint_.slow().row(high) - joint_.slow().row(low)).transpose();
  const double variance = between.dot(
      fit_.covariance.block(WindUpFit::kSlow, WindUpFit::kSlow, degree, degree) * between);
  result_.slow_error = number(between.dot(beta), std::sqrt(std::max(0.0, variance)),
                              fit_.chance(WindUpFit::kSlow, degree));
}

/// Of a kind that is in the fit, or of its best form beside it.
void WindUpAnswer::answer_term(WindUpTerm::Kind kind, WindUpNumber& own) {
  RobustRegression with = fit_;
  std::vector<WindUpTerm> terms = joint_.terms();
  if (!joint_.has(kind)) {
    std::optional<WindUpTerm> best = joint_.best_form(kind);
    if (!best) return;
    terms.push_back(std::move(*best));
    with = joint_.fit_of(terms);
    add_model_noise(with, joint_.columns(terms));
  }
  Index place = joint_.base_columns();
  for (const WindUpTerm& term : terms) {
    if (term.kind == kind) {
      const double factor = kind == WindUpTerm::Kind::kHysteresis  ? 2
                            : kind == WindUpTerm::Kind::kHardening ? 1 / std::pow(term.shape, 3)
                                                                   : 1;
      own = number(with, place, factor);
      own.chance = term.chance;
      own.seen = joint_.has(kind);
      if (kind == WindUpTerm::Kind::kHysteresis) {
        result_.hysteresis_driver = term.driver;
        result_.hysteresis_reach = term.shape;
      }
      return;
    }
    place += term.columns.cols();
  }
}

void WindUpAnswer::answer_lines() {
  Index place = joint_.base_columns();
  for (const WindUpTerm& term : joint_.terms()) {
    if (term.kind == WindUpTerm::Kind::kLine) {
      const double a = fit_.beta[place], b = fit_.beta[place + 1];
      const double amplitude = std::hypot(a, b);
      const Eigen::Vector2d slope(a / amplitude, b / amplitude);
      const double variance = slope.dot(fit_.covariance.block<2, 2>(place, place) * slope);
      GearErrorLine line;
      line.order = term.shape;
      line.of_motor = data_.gear_ratio != 0 ? term.shape / std::abs(data_.gear_ratio) : 0;
      line.amplitude = number(amplitude, std::sqrt(std::max(0.0, variance)), fit_.chance(place, 2));
      line.phase = std::atan2(b, a);
      line.chance = term.chance;
      result_.lines.push_back(line);
    }
    place += term.columns.cols();
  }
}

/// The torque gives rotor and link together; the twist is of the link alone.
void WindUpAnswer::answer_rotor() {
  if (!data_.rotor_open || !result_.stiffness.seen) return;
  const Index place = joint_.rotor_place();
  const double c = fit_.beta[WindUpFit::kLoad], inertia = -fit_.beta[place] / c;
  Eigen::Vector2d slope(-1 / c, -inertia / c);
  Eigen::Matrix2d covariance;
  covariance << fit_.covariance(place, place), fit_.covariance(place, WindUpFit::kLoad),
      fit_.covariance(WindUpFit::kLoad, place), fit_.covariance(WindUpFit::kLoad, WindUpFit::kLoad);
  result_.rotor =
      number(inertia, std::sqrt(std::max(0.0, slope.dot(covariance * slope))), fit_.chance(place));
  result_.rotor_estimated = true;
}

void WindUpAnswer::show(const MatrixXd& D) {
  constexpr Index kMost = 2000;
  const Index every = std::max<Index>(1, data_.wind_up.size() / kMost),
              count = data_.wind_up.size() / every;
  VectorXd twist = fit_.beta[WindUpFit::kLoad] * D.col(WindUpFit::kLoad);
  if (data_.rotor_open) twist += fit_.beta[joint_.rotor_place()] * D.col(joint_.rotor_place());
  Index place = joint_.base_columns();
  for (const WindUpTerm& term : joint_.terms()) {
    if (term.kind != WindUpTerm::Kind::kLine) {
      twist += term.columns * fit_.beta.segment(place, term.columns.cols());
    }
    place += term.columns.cols();
  }
  const VectorXd load = joint_.net_load();
  result_.shown_load.resize(count);
  result_.shown_wind_up.resize(count);
  result_.shown_fit.resize(count);
  for (Index i = 0; i < count; ++i) {
    const Index k = i * every;
    result_.shown_load[i] = load[k];
    result_.shown_fit[i] = twist[k];
    result_.shown_wind_up[i] = twist[k] + fit_.residual[k];
  }
}

}  // namespace

WindUpResult analyse_wind_up(const WindUpData& data, const WindUpRules& rules) {
  check(data);
  WindUpFit fit(data, rules);
  WindUpResult result;
  result.why_not = fit.why_not();
  if (result.why_not.empty()) {
    fit.run();
    result = WindUpAnswer(fit).run();
  }
  result.revolute = data.revolute;
  return result;
}

}  // namespace dyngen::runtime

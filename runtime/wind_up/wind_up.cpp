// SPDX-License-Identifier: MIT
#include "runtime/wind_up/wind_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "runtime/estimation/distributions.h"
#include "runtime/wind_up/gear_lines.h"
#include "runtime/wind_up/hysteresis_columns.h"
#include "runtime/wind_up/robust_regression.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kIntervalOfNumbers = 0.95;
constexpr Index kOffset = 0, kDelay = 1, kLoad = 2, kSlow = 3;

double travel_of(const VectorXd& values) { return values.maxCoeff() - values.minCoeff(); }

double rms_of(const VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(std::max<Index>(1, values.size())));
}

/// Central differences within runs.
VectorXd rate_of(const VectorXd& values, const std::vector<Index>& starts, double step) {
  VectorXd rate = VectorXd::Zero(values.size());
  for (std::size_t run = 0; run < starts.size(); ++run) {
    const Index first = starts[run];
    const Index end = run + 1 < starts.size() ? starts[run + 1] : values.size();
    for (Index k = first; k < end; ++k) {
      const Index before = std::max(first, k - 1), after = std::min(end - 1, k + 1);
      if (after > before) {
        rate[k] = (values[after] - values[before]) / (static_cast<double>(after - before) * step);
      }
    }
  }
  return rate;
}

/// Something that may be in the wind-up beside the elastic twist.
struct Term {
  enum class Kind { kHysteresis, kBacklash, kHardening, kLine };
  Kind kind = Kind::kHysteresis;
  MatrixXd columns;
  double shape = 0;    ///< reach, load or order
  std::string driver;  ///< of a hysteresis
  double chance = 1;
  double left = 0;  ///< sum of squares with it
};

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

class Analysis {
 public:
  Analysis(const WindUpData& data, const WindUpRules& rules)
      : data_(data),
        rules_(rules),
        load_rate_(rate_of(data.load, data.run_starts, data.sample_time)),
        load_second_(rate_of(load_rate_, data.run_starts, data.sample_time)),
        jerk_(rate_of(data.ddq, data.run_starts, data.sample_time)),
        snap_(rate_of(jerk_, data.run_starts, data.sample_time)) {
    result_.revolute = data.revolute;
  }

  WindUpResult run() {
    if (!can_be_judged()) return std::move(result_);
    make_slow();
    settle();
    make_slow();  // at the delay that is known now
    settle();
    choose_terms();
    choose_lines();
    choose_terms();
    answer();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Index samples() const { return data_.wind_up.size(); }
  [[nodiscard]] const char* unit() const { return data_.revolute ? "rad" : "m"; }

  [[nodiscard]] double independent_rows() const {
    constexpr double kWithout = 0.1;  // of the samples, where no cut-off is known
    const double share =
        data_.bandwidth > 0 ? std::min(1.0, 2 * data_.bandwidth * data_.sample_time) : kWithout;
    return share * static_cast<double>(samples());
  }

  bool can_be_judged() {
    const auto refuse = [&](std::string why) {
      result_.why_not = std::move(why);
      return false;
    };
    if (samples() == 0 || independent_rows() < rules_.least_rows) {
      return refuse(fmt::format(
          "The recording has {:.0f} independent rows at its cut-off; {:.0f} are needed. Record a "
          "longer motion.",
          independent_rows(), rules_.least_rows.value));
    }
    if (!(travel_of(data_.q) > 0)) {
      return refuse("The joint stands, so nothing is known of its gear. Move it under load.");
    }
    if (!data_.wind_up.allFinite() || !data_.load.allFinite()) {
      return refuse("The load of the joint is not known, so its stiffness is not either.");
    }
    return true;
  }

  /// Gear error that is never taken for elasticity.
  void make_slow() {
    const auto degree = static_cast<Index>(rules_.slow_degree.value);
    const VectorXd q = late_position();
    const double middle = (q.maxCoeff() + q.minCoeff()) / 2;
    const VectorXd s = (q.array() - middle) / (travel_of(q) / 2);
    constexpr double kMostOfTurn = 0.75;
    const bool turns = data_.revolute && travel_of(data_.q) > kMostOfTurn * 2 * std::numbers::pi;
    slow_.resize(samples(), degree + (turns ? 2 : 0));
    VectorXd before = VectorXd::Ones(samples()), now = s;
    for (Index i = 0; i < degree; ++i) {
      slow_.col(i) = now;
      VectorXd next = 2 * s.cwiseProduct(now) - before;
      before = std::exchange(now, std::move(next));
    }
    if (!turns) return;
    slow_.col(degree) = q.array().cos();
    slow_.col(degree + 1) = q.array().sin();
  }

  [[nodiscard]] Index rotor_place() const { return kSlow + slow_.cols(); }
  [[nodiscard]] Index base_columns() const { return rotor_place() + (data_.rotor_open ? 1 : 0); }

  /// A signal delay_ ago, by its derivatives.
  [[nodiscard]] VectorXd late(const VectorXd& now, const VectorXd& rate,
                              const VectorXd& second) const {
    return now - delay_ * rate + delay_ * delay_ / 2 * second;
  }
  /// Half a sample later, so that steps between samples have the signs of the rates at samples.
  [[nodiscard]] VectorXd ahead(const VectorXd& now, const VectorXd& rate) const {
    return now + data_.sample_time / 2 * rate;
  }
  [[nodiscard]] VectorXd late_position() const { return late(data_.q, data_.dq, data_.ddq); }
  [[nodiscard]] VectorXd late_load() const { return late(data_.load, load_rate_, load_second_); }

  [[nodiscard]] MatrixXd columns(const std::vector<Term>& terms) const {
    Index count = base_columns();
    for (const Term& term : terms) count += term.columns.cols();
    MatrixXd D(samples(), count);
    D.col(kOffset).setOnes();
    // q(t) - q(t - d) = d (dq - d/2 ddq + d^2/6 dddq), but for the fourth power
    D.col(kDelay) = data_.dq - delay_ / 2 * data_.ddq + delay_ * delay_ / 6 * jerk_;
    D.col(kLoad) = late_load();
    D.middleCols(kSlow, slow_.cols()) = slow_;
    if (data_.rotor_open) D.col(rotor_place()) = late(data_.ddq, jerk_, snap_);
    Index at = base_columns();
    for (const Term& term : terms) {
      D.middleCols(at, term.columns.cols()) = term.columns;
      at += term.columns.cols();
    }
    return D;
  }

  /// With what the load's model does not know. @param D  of the fit
  void add_model_noise(RobustRegression& fit, const MatrixXd& D) const {
    if (!data_.load_products) return;
    const LoadProducts products = data_.load_products(D);
    const MatrixXd gain = -fit.beta[kLoad] * fit.inverse * products.with_columns;
    fit.covariance += gain * data_.load_covariance * gain.transpose();
  }

  [[nodiscard]] RobustRegression fit(const std::vector<Term>& terms) const {
    return robust_regression(columns(terms), data_.wind_up,
                             cosines_for(independent_rows(), rules_.cosines));
  }

  /// The delay at which the columns are taken is the one that is found.
  void settle() {
    constexpr int kRepeats = 3;  // the third changes it by the third power of the delay
    for (int round = 0; round < kRepeats; ++round) {
      fit_ = fit(terms_);
      delay_ = fit_.beta[kDelay];
    }
    fit_ = fit(terms_);
  }

  /// Load without the rotor's part, if that is known by now.
  [[nodiscard]] VectorXd net_load() const {
    VectorXd load = late_load();
    if (!data_.rotor_open || fit_.chance(rotor_place()) > rules_.chance ||
        fit_.chance(kLoad) > rules_.chance) {
      return load;
    }
    return load + fit_.beta[rotor_place()] / fit_.beta[kLoad] * data_.ddq;
  }

  /// All forms of a kind, with what each leaves beside `terms_`.
  [[nodiscard]] std::vector<Term> forms_of(Term::Kind kind) const {
    std::vector<Term> forms;
    const MatrixXd D = columns(terms_);
    const double whole = fit_.residual.squaredNorm();
    const VectorXd load = net_load();
    const double most = load.cwiseAbs().maxCoeff();
    const auto add = [&](MatrixXd own, double shape, std::string driver) {
      Term term{kind, std::move(own), shape, std::move(driver), 1, 0};
      const VectorXd column = term.columns.col(0);
      const VectorXd on_columns = D.transpose() * column;
      const double beside = column.squaredNorm() - on_columns.dot(fit_.inverse * on_columns);
      const double part = column.dot(fit_.residual);
      term.left = whole - (beside > 1e-9 * column.squaredNorm() ? part * part / beside : 0);
      forms.push_back(std::move(term));
    };
    if (kind == Term::Kind::kHysteresis) {
      for (const double part : {1e-4, 1e-3, 1e-2}) {
        const double reach = part * travel_of(data_.q);
        add(hysteresis_column(ahead(late_position(), data_.dq), data_.run_starts, reach), reach,
            "motion");
      }
      for (const double part : {0.01, 0.03, 0.1}) {
        const double reach = part * travel_of(load);
        if (reach > 0)
          add(hysteresis_column(ahead(load, load_rate_), data_.run_starts, reach), reach, "load");
      }
    }
    if (kind == Term::Kind::kBacklash && reverses(load)) {
      for (const double part : {0.01, 0.03, 0.1}) {
        add((load / (part * most)).array().tanh().matrix() / 2, part * most, {});
      }
    }
    if (kind == Term::Kind::kHardening && most > 0) {
      add((load / most).array().cube().matrix(), most, {});
    }
    return forms;
  }

  [[nodiscard]] bool reverses(const VectorXd& load) const {
    const double edge = 0.03 * load.cwiseAbs().maxCoeff();
    const double least = rules_.load_reversals * static_cast<double>(samples());
    return static_cast<double>((load.array() > edge).count()) > least &&
           static_cast<double>((load.array() < -edge).count()) > least;
  }

  [[nodiscard]] bool has(Term::Kind kind) const {
    return std::any_of(terms_.begin(), terms_.end(),
                       [&](const Term& term) { return term.kind == kind; });
  }

  /// The form that leaves least; its chance counts all of them.
  [[nodiscard]] std::optional<Term> best_form(Term::Kind kind) const {
    std::vector<Term> forms = forms_of(kind);
    if (forms.empty()) return std::nullopt;
    const auto best = std::min_element(
        forms.begin(), forms.end(), [](const Term& a, const Term& b) { return a.left < b.left; });
    std::vector<Term> all = terms_;
    all.push_back(*best);
    const RobustRegression with = fit(all);
    const Index count = best->columns.cols();
    best->chance = std::min(
        1.0, with.chance(with.beta.size() - count, count) * static_cast<double>(forms.size()));
    // a gap or a hysteresis of a negative size is another thing: damping of the gear, for example;
    // one of less than two encoder steps is not resolved
    const bool has_sign = kind != Term::Kind::kHardening;
    const double least = rules_.least_steps * data_.position_step;
    if (has_sign && with.beta[with.beta.size() - count] < least) best->chance = 1;
    return std::move(*best);
  }

  /// The term with the least chance joins, as long as one pays for itself.
  void choose_terms() {
    for (;;) {
      std::optional<Term> best;
      for (const auto kind :
           {Term::Kind::kHysteresis, Term::Kind::kBacklash, Term::Kind::kHardening}) {
        if (has(kind)) continue;
        std::optional<Term> own = best_form(kind);
        if (own && (!best || own->chance < best->chance)) best = std::move(own);
      }
      if (!best || best->chance > rules_.chance) return;
      terms_.push_back(std::move(*best));
      settle();
    }
  }

  void choose_lines() {
    if (!data_.revolute) return;
    const OrderRange orders = orders_seen(data_.q, data_.dq, data_.sample_time, rules_.line_cycles);
    if (orders.empty()) return;
    const auto neighbours = static_cast<int>(rules_.line_neighbours.value);
    for (int round = 0;; ++round) {
      std::vector<double> known;
      for (const Term& term : terms_) {
        if (term.kind == Term::Kind::kLine) known.push_back(term.shape);
      }
      const std::optional<GearLine> line =
          strongest_line(late_position(), fit_.residual, orders, neighbours, known);
      if (!line) return;
      result_.least_order = orders.least;
      result_.most_order = orders.most;
      Term term{Term::Kind::kLine, MatrixXd(samples(), 2), line->order, {}, line->chance, 0};
      const VectorXd angle = line->order * late_position();
      term.columns.col(0) = angle.array().cos();
      term.columns.col(1) = angle.array().sin();
      std::vector<Term> with = terms_;
      with.push_back(term);
      const RobustRegression tried = fit(with);
      const double own = tried.chance(tried.beta.size() - 2, 2);
      if (line->chance > rules_.chance || own > rules_.chance || round >= rules_.most_lines) {
        constexpr double kBound = 1.645;  // 95 % of one side
        result_.lines_below = 2 / static_cast<double>(samples()) *
                              (std::sqrt(line->power) +
                               kBound * std::sqrt(line->power / std::max(1.0, line->ratio) / 2));
        return;
      }
      terms_.push_back(std::move(term));
      settle();
    }
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

  void answer();
  void answer_load(const MatrixXd& D, const MatrixXd& noise_alone);
  void answer_slow();
  void answer_term(Term::Kind kind, WindUpNumber& number);
  void answer_lines();
  void answer_rotor();
  void show(const MatrixXd& D);

  const WindUpData& data_;
  const WindUpRules& rules_;
  VectorXd load_rate_, load_second_, jerk_, snap_;
  MatrixXd slow_;
  double delay_ = 0;
  std::vector<Term> terms_;
  RobustRegression fit_;
  WindUpResult result_;
};

void Analysis::answer() {
  const MatrixXd D = columns(terms_);
  const MatrixXd noise_alone = fit_.covariance;
  add_model_noise(fit_, D);
  result_.judged = true;
  result_.degrees = fit_.degrees;
  result_.residual = rms_of(fit_.residual);
  result_.delay = number(fit_, kDelay, 1);
  answer_load(D, noise_alone);
  answer_slow();
  answer_term(Term::Kind::kHysteresis, result_.hysteresis);
  answer_term(Term::Kind::kBacklash, result_.backlash);
  answer_term(Term::Kind::kHardening, result_.hardening);
  result_.backlash_decided = reverses(net_load());
  answer_lines();
  answer_rotor();
  show(D);
}

void Analysis::answer_load(const MatrixXd& D, const MatrixXd& noise_alone) {
  // the load less what the other columns explain
  MatrixXd others(D.rows(), D.cols() - 1);
  others << D.leftCols(kLoad), D.rightCols(D.cols() - kLoad - 1);
  const RobustRegression beside = robust_regression(others, D.col(kLoad), 1);
  const VectorXd centred = D.col(kLoad).array() - D.col(kLoad).mean();
  result_.load_own = rms_of(beside.residual);
  const double whole = rms_of(centred);
  result_.load_explained = whole > 0 ? 1 - std::pow(result_.load_own / whole, 2) : 1;
  const double variance = fit_.covariance(kLoad, kLoad);
  result_.model_share = variance > 0 ? 1 - noise_alone(kLoad, kLoad) / variance : 0;
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
  c = number(fit_, kLoad, 1);
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

void Analysis::answer_slow() {
  const Index degree = slow_.cols();
  const VectorXd beta = fit_.beta.segment(kSlow, degree);
  const VectorXd course = slow_ * beta;
  Index high = 0, low = 0;
  course.maxCoeff(&high);
  course.minCoeff(&low);
  const VectorXd between = (slow_.row(high) - slow_.row(low)).transpose();
  const double variance =
      between.dot(fit_.covariance.block(kSlow, kSlow, degree, degree) * between);
  result_.slow_error =
      number(between.dot(beta), std::sqrt(std::max(0.0, variance)), fit_.chance(kSlow, degree));
}

/// Of a kind that is in the fit, or of its best form beside it.
void Analysis::answer_term(Term::Kind kind, WindUpNumber& own) {
  RobustRegression with = fit_;
  std::vector<Term> terms = terms_;
  if (!has(kind)) {
    std::optional<Term> best = best_form(kind);
    if (!best) return;
    terms.push_back(std::move(*best));
    with = fit(terms);
    add_model_noise(with, columns(terms));
  }
  Index place = base_columns();
  for (const Term& term : terms) {
    if (term.kind == kind) {
      const double factor = kind == Term::Kind::kHysteresis  ? 2
                            : kind == Term::Kind::kHardening ? 1 / std::pow(term.shape, 3)
                                                             : 1;
      own = number(with, place, factor);
      own.chance = term.chance;
      own.seen = has(kind);
      if (kind == Term::Kind::kHysteresis) {
        result_.hysteresis_driver = term.driver;
        result_.hysteresis_reach = term.shape;
      }
      return;
    }
    place += term.columns.cols();
  }
}

void Analysis::answer_lines() {
  Index place = base_columns();
  for (const Term& term : terms_) {
    if (term.kind == Term::Kind::kLine) {
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
void Analysis::answer_rotor() {
  if (!data_.rotor_open || !result_.stiffness.seen) return;
  const Index place = rotor_place();
  const double c = fit_.beta[kLoad], inertia = -fit_.beta[place] / c;
  Eigen::Vector2d slope(-1 / c, -inertia / c);
  Eigen::Matrix2d covariance;
  covariance << fit_.covariance(place, place), fit_.covariance(place, kLoad),
      fit_.covariance(kLoad, place), fit_.covariance(kLoad, kLoad);
  result_.rotor =
      number(inertia, std::sqrt(std::max(0.0, slope.dot(covariance * slope))), fit_.chance(place));
  result_.rotor_estimated = true;
}

void Analysis::show(const MatrixXd& D) {
  constexpr Index kMost = 2000;
  const Index every = std::max<Index>(1, samples() / kMost), count = samples() / every;
  VectorXd twist = fit_.beta[kLoad] * D.col(kLoad);
  if (data_.rotor_open) twist += fit_.beta[rotor_place()] * D.col(rotor_place());
  Index place = base_columns();
  for (const Term& term : terms_) {
    if (term.kind != Term::Kind::kLine) {
      twist += term.columns * fit_.beta.segment(place, term.columns.cols());
    }
    place += term.columns.cols();
  }
  const VectorXd load = net_load();
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
  return Analysis(data, rules).run();
}

}  // namespace dyngen::runtime

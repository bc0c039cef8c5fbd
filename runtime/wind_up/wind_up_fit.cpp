// SPDX-License-Identifier: MIT
#include "runtime/wind_up/wind_up_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "runtime/wind_up/gear_lines.h"
#include "runtime/wind_up/hysteresis_columns.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double travel_of(const VectorXd& values) { return values.maxCoeff() - values.minCoeff(); }

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

}  // namespace

WindUpFit::WindUpFit(const WindUpData& data, const WindUpRules& rules)
    : data_(data),
      rules_(rules),
      load_rate_(rate_of(data.load, data.run_starts, data.sample_time)),
      load_second_(rate_of(load_rate_, data.run_starts, data.sample_time)),
      jerk_(rate_of(data.ddq, data.run_starts, data.sample_time)),
      snap_(rate_of(jerk_, data.run_starts, data.sample_time)) {}

void WindUpFit::run() {
  make_slow();
  settle();
  make_slow();  // at the delay that is known now
  settle();
  choose_terms();
  choose_lines();
  choose_terms();
}

double WindUpFit::independent_rows() const {
  constexpr double kWithout = 0.1;  // of the samples, where no cut-off is known
  const double share =
      data_.bandwidth > 0 ? std::min(1.0, 2 * data_.bandwidth * data_.sample_time) : kWithout;
  return share * static_cast<double>(samples());
}

std::string WindUpFit::why_not() const {
  if (samples() == 0 || independent_rows() < rules_.least_rows) {
    return fmt::format(
        "The recording has {:.0f} independent rows at its cut-off; {:.0f} are needed. Record a "
        "longer motion.",
        independent_rows(), rules_.least_rows.value);
  }
  if (!(travel_of(data_.q) > 0)) {
    return "The joint stands, so nothing is known of its gear. Move it under load.";
  }
  if (!data_.wind_up.allFinite() || !data_.load.allFinite()) {
    return "The load of the joint is not known, so its stiffness is not either.";
  }
  return {};
}

/// Gear error that is never taken for elasticity.
void WindUpFit::make_slow() {
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

VectorXd WindUpFit::late(const VectorXd& now, const VectorXd& rate, const VectorXd& second) const {
  return now - delay_ * rate + delay_ * delay_ / 2 * second;
}

VectorXd WindUpFit::ahead(const VectorXd& now, const VectorXd& rate) const {
  return now + data_.sample_time / 2 * rate;
}

VectorXd WindUpFit::late_position() const { return late(data_.q, data_.dq, data_.ddq); }

VectorXd WindUpFit::late_load() const { return late(data_.load, load_rate_, load_second_); }

MatrixXd WindUpFit::columns(const std::vector<WindUpTerm>& terms) const {
  Index count = base_columns();
  for (const WindUpTerm& term : terms) count += term.columns.cols();
  MatrixXd D(samples(), count);
  D.col(kOffset).setOnes();
  // q(t) - q(t - d) = d (dq - d/2 ddq + d^2/6 dddq), but for the fourth power
  D.col(kDelay) = data_.dq - delay_ / 2 * data_.ddq + delay_ * delay_ / 6 * jerk_;
  D.col(kLoad) = late_load();
  D.middleCols(kSlow, slow_.cols()) = slow_;
  if (data_.rotor_open) D.col(rotor_place()) = late(data_.ddq, jerk_, snap_);
  Index at = base_columns();
  for (const WindUpTerm& term : terms) {
    D.middleCols(at, term.columns.cols()) = term.columns;
    at += term.columns.cols();
  }
  return D;
}

RobustRegression WindUpFit::fit_of(const std::vector<WindUpTerm>& terms) const {
  return robust_regression(columns(terms), data_.wind_up, cosines_for(independent_rows()));
}

/// The delay at which the columns are taken is the one that is found.
void WindUpFit::settle() {
  constexpr int kDelayRounds = 3;  // the third changes it by the third power of the delay
  for (int round = 0; round < kDelayRounds; ++round) {
    fit_ = fit_of(terms_);
    delay_ = fit_.beta[kDelay];
  }
  fit_ = fit_of(terms_);
}

VectorXd WindUpFit::net_load() const {
  VectorXd load = late_load();
  if (!data_.rotor_open || fit_.chance(rotor_place()) > rules_.chance ||
      fit_.chance(kLoad) > rules_.chance) {
    return load;
  }
  return load + fit_.beta[rotor_place()] / fit_.beta[kLoad] * data_.ddq;
}

/// All forms of a kind, with what each leaves beside `terms_`.
std::vector<WindUpTerm> WindUpFit::forms_of(WindUpTerm::Kind kind) const {
  std::vector<WindUpTerm> forms;
  const MatrixXd D = columns(terms_);
  const double whole = fit_.residual.squaredNorm();
  const VectorXd load = net_load();
  const double most = load.cwiseAbs().maxCoeff();
  const auto add = [&](MatrixXd own, double shape, std::string driver) {
    WindUpTerm term{kind, std::move(own), shape, std::move(driver), 1, 0};
    const VectorXd column = term.columns.col(0);
    const VectorXd on_columns = D.transpose() * column;
    const double beside = column.squaredNorm() - on_columns.dot(fit_.inverse * on_columns);
    const double part = column.dot(fit_.residual);
    term.left = whole - (beside > 1e-9 * column.squaredNorm() ? part * part / beside : 0);
    forms.push_back(std::move(term));
  };
  if (kind == WindUpTerm::Kind::kHysteresis) {
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
  if (kind == WindUpTerm::Kind::kBacklash && reverses(load)) {
    for (const double part : {0.01, 0.03, 0.1}) {
      add((load / (part * most)).array().tanh().matrix() / 2, part * most, {});
    }
  }
  if (kind == WindUpTerm::Kind::kHardening && most > 0) {
    add((load / most).array().cube().matrix(), most, {});
  }
  return forms;
}

bool WindUpFit::reverses(const VectorXd& load) const {
  const double edge = 0.03 * load.cwiseAbs().maxCoeff();
  const double least = rules_.load_reversals * static_cast<double>(samples());
  return static_cast<double>((load.array() > edge).count()) > least &&
         static_cast<double>((load.array() < -edge).count()) > least;
}

bool WindUpFit::has(WindUpTerm::Kind kind) const {
  return std::any_of(terms_.begin(), terms_.end(),
                     [&](const WindUpTerm& term) { return term.kind == kind; });
}

std::optional<WindUpTerm> WindUpFit::best_form(WindUpTerm::Kind kind) const {
  std::vector<WindUpTerm> forms = forms_of(kind);
  if (forms.empty()) return std::nullopt;
  const auto best =
      std::min_element(forms.begin(), forms.end(),
                       [](const WindUpTerm& a, const WindUpTerm& b) { return a.left < b.left; });
  std::vector<WindUpTerm> all = terms_;
  all.push_back(*best);
  const RobustRegression with = fit_of(all);
  const Index count = best->columns.cols();
  best->chance = std::min(
      1.0, with.chance(with.beta.size() - count, count) * static_cast<double>(forms.size()));
  // a gap or a hysteresis of a negative size is another thing: damping of the gear, for example;
  // one of less than two encoder steps is not resolved
  const bool has_sign = kind != WindUpTerm::Kind::kHardening;
  const double least = rules_.least_steps * data_.position_step;
  if (has_sign && with.beta[with.beta.size() - count] < least) best->chance = 1;
  return std::move(*best);
}

/// The term with the least chance joins, as long as one pays for itself.
void WindUpFit::choose_terms() {
  for (;;) {
    std::optional<WindUpTerm> best;
    for (const auto kind : {WindUpTerm::Kind::kHysteresis, WindUpTerm::Kind::kBacklash,
                            WindUpTerm::Kind::kHardening}) {
      if (has(kind)) continue;
      std::optional<WindUpTerm> own = best_form(kind);
      if (own && (!best || own->chance < best->chance)) best = std::move(own);
    }
    if (!best || best->chance > rules_.chance) return;
    terms_.push_back(std::move(*best));
    settle();
  }
}

void WindUpFit::choose_lines() {
  if (!data_.revolute) return;
  const OrderRange orders = orders_seen(data_.q, data_.dq, data_.sample_time, rules_.line_cycles);
  if (orders.empty()) return;
  const auto neighbours = static_cast<int>(rules_.line_neighbours.value);
  for (int round = 0;; ++round) {
    std::vector<double> known;
    for (const WindUpTerm& term : terms_) {
      if (term.kind == WindUpTerm::Kind::kLine) known.push_back(term.shape);
    }
    const std::optional<GearLine> line =
        strongest_line(late_position(), fit_.residual, orders, neighbours, known);
    if (!line) return;
    orders_.least = orders.least;
    orders_.most = orders.most;
    WindUpTerm term{
        WindUpTerm::Kind::kLine, MatrixXd(samples(), 2), line->order, {}, line->chance, 0};
    const VectorXd angle = line->order * late_position();
    term.columns.col(0) = angle.array().cos();
    term.columns.col(1) = angle.array().sin();
    std::vector<WindUpTerm> with = terms_;
    with.push_back(term);
    const RobustRegression tried = fit_of(with);
    const double own = tried.chance(tried.beta.size() - 2, 2);
    if (line->chance > rules_.chance || own > rules_.chance || round >= rules_.most_lines) {
      constexpr double kBound = 1.645;  // 95 % of one side
      orders_.below = 2 / static_cast<double>(samples()) *
                      (std::sqrt(line->power) +
                       kBound * std::sqrt(line->power / std::max(1.0, line->ratio) / 2));
      return;
    }
    terms_.push_back(std::move(term));
    settle();
  }
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/ripple/ripple.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/estimation/distributions.h"
#include "runtime/estimation/robust_regression.h"
#include "runtime/ripple/order_spectrum.h"
#include "runtime/ripple/rivals.h"
#include "runtime/ripple/white_residual.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWaveInterval = 0.95;

void check_data(const RippleData& data) {
  for (const VectorXd* own : {&data.dq, &data.ddq, &data.residual}) {
    if (own->size() == data.q.size()) continue;
    throw std::invalid_argument(
        fmt::format("analyse_ripple(): found {} samples beside {} positions, expected as many",
                    own->size(), data.q.size()));
  }
  if (!(data.sample_time > 0) || data.run_starts.empty() || data.run_starts.front() != 0) {
    throw std::invalid_argument(
        "analyse_ripple(): expected a positive sample_time and run_starts from 0 on");
  }
}

/// Weighted mean square about the mean.
double spread_of(const VectorXd& q, const VectorXd& weights) {
  const double sum = weights.sum();
  if (!(sum > 0)) return 0;
  const double mean = weights.dot(q) / sum;
  return (weights.array() * (q.array() - mean).square()).sum() / sum;
}

/// An order with its test.
struct OrderCandidate {
  double order = 0;
  OrderTest test;
  OrderSums sums;
  double stated = 0;
  double log_chance = 0;
};

class RippleAnalysis {
 public:
  RippleAnalysis(const RippleData& data, const RippleRules& rules)
      : data_(data), rules_(rules), white_(data, rules) {}

  RippleResult run() {
    if (!can_be_judged()) return std::move(result_);
    left_ = white_.start();
    const int rounds = 2 * most_lines();  // those that are ruled out as well
    for (int round = 0; round < rounds; ++round) {
      const OrderSpectrum spectrum(white_, left_, reach_, rules_);
      std::optional<OrderCandidate> best = best_stated(spectrum);
      if (!best) best = best_of_all(spectrum);
      if (!best) break;
      result_.cut_off = static_cast<int>(result_.lines.size()) >= most_lines();
      if (result_.cut_off) break;
      take(*best);
    }
    answer();
    return std::move(result_);
  }

 private:
  bool can_be_judged() {
    const auto refuse = [&](std::string why) {
      result_.why_not = std::move(why);
      return false;
    };
    result_.moving = white_.counted();
    if (!data_.residual.allFinite()) {
      return refuse("The torque of the joint is not known.");
    }
    if (static_cast<double>(white_.counted()) < rules_.least_moving) {
      return refuse(fmt::format("The joint moves in {} samples; {:g} are needed.", white_.counted(),
                                rules_.least_moving.value));
    }
    if (!white_.usable()) return refuse("The model leaves no torque of this joint.");
    reach_ = order_reach(white_, rules_);
    const double fewest = 4.0 * rules_.neighbours;  // orders: neighbours on both sides, twice
    if (reach_.empty() || (reach_.most - reach_.least) / reach_.apart < fewest) {
      return refuse(
          "The joint travels too little, or too fast for its sample time, for orders to be told "
          "apart.");
    }
    return true;
  }

  [[nodiscard]] int most_lines() const { return static_cast<int>(rules_.most_lines); }
  [[nodiscard]] double limit() const { return std::log(rules_.chance); }

  [[nodiscard]] std::vector<double> known() const {
    std::vector<double> orders;
    for (const RippleLine& line : result_.lines) orders.push_back(line.order.value);
    for (const RippleLine& line : result_.ruled_out) orders.push_back(line.order.value);
    return orders;
  }

  [[nodiscard]] OrderSums sums_at(double order) const {
    return order_sums(white_, left_, order, rules_.most_per_sample);
  }

  /// The order near `start` with the largest power.
  [[nodiscard]] double refined(double start, bool separate) const {
    const auto power = [&](double order) {
      const OrderSums sums = sums_at(order);
      return separate ? sums.separate() : sums.common();
    };
    constexpr double kGolden = 0.6180339887498949;
    constexpr int kSteps = 14;  // a thousandth of the resolution
    double low = start - reach_.resolution / 2, high = start + reach_.resolution / 2;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double at_a = power(a), at_b = power(b);
    for (int i = 0; i < kSteps; ++i) {
      if (at_a > at_b) {
        high = std::exchange(b, a);
        at_b = at_a;
        at_a = power(a = high - kGolden * (high - low));
      } else {
        low = std::exchange(a, b);
        at_a = at_b;
        at_b = power(b = low + kGolden * (high - low));
      }
    }
    return at_a > at_b ? a : b;
  }

  /// The test of an order against neighbours from which its own side lobes were taken.
  [[nodiscard]] std::optional<OrderCandidate> tested(double order, double tests) const {
    OrderCandidate own;
    own.order = order;
    own.sums = sums_at(order);
    const VectorXd beside =
        left_beside(wave_columns(white_, order, rules_.most_per_sample).columns, left_);
    const OrderSpectrum without(white_, beside, reach_, rules_, order);
    const std::optional<OrderTest> level = without.level_at(order);
    if (!level) return std::nullopt;
    own.test = order_test(own.sums, level->level, level->degrees);
    own.log_chance = own.test.log_tail + std::log(tests);
    return own;
  }

  [[nodiscard]] std::optional<OrderCandidate> best_stated(const OrderSpectrum& spectrum) const {
    const std::vector<double> found = known();
    std::vector<double> open;
    for (const double order : data_.stated) {
      const bool near = std::any_of(found.begin(), found.end(), [&](double own) {
        return std::abs(own - order) < rules_.part_of_line * reach_.resolution;
      });
      if (!near && order >= reach_.least && order <= reach_.most) open.push_back(order);
    }
    std::optional<OrderCandidate> best;
    for (const double order : open) {
      const std::optional<OrderTest> level = spectrum.level_at(order);
      if (!level) continue;
      const double tests = static_cast<double>(open.size());
      const OrderTest quick = order_test(sums_at(order), level->level, level->degrees);
      if (quick.log_tail + std::log(tests) > limit()) continue;
      if (best && quick.log_tail >= best->test.log_tail) continue;
      std::optional<OrderCandidate> own = tested(refined(order, quick.separate), tests);
      if (!own || own->log_chance > limit()) continue;
      if (!is_same(*own, order)) continue;
      own->stated = order;
      best = own;
    }
    return best;
  }

  [[nodiscard]] std::optional<OrderCandidate> best_of_all(const OrderSpectrum& spectrum) const {
    const std::optional<OrderSpectrum::Peak> peak = spectrum.strongest(known());
    if (!peak) return std::nullopt;
    std::optional<OrderCandidate> own =
        tested(refined(peak->order, peak->test.separate), spectrum.tests());
    if (!own || own->log_chance > limit()) return std::nullopt;
    for (const double order : data_.stated) {
      if (is_same(*own, order)) own->stated = order;
    }
    return own;
  }

  /// Whether an order may be a stated one: within its interval of 99.7 %.
  [[nodiscard]] bool is_same(const OrderCandidate& own, double stated) const {
    constexpr double kWider = 1.5;
    return std::abs(own.order - stated) <= kWider * half_interval(own);
  }

  /// Half of the order's interval: from the curvature of its power.
  [[nodiscard]] double half_interval(const OrderCandidate& own) const {
    const VectorXd seen = white_.seen(own.order, rules_.most_per_sample);
    double information = 0;
    if (own.test.separate) {
      for (const std::size_t side : {0U, 1U}) {
        const VectorXd weights = (white_.direction().array() == (side == 0 ? 1.0 : -1.0))
                                     .select(seen, VectorXd::Zero(seen.size()));
        information += 2 * own.sums.power(side) * spread_of(data_.q, weights);
      }
    } else {
      information = 2 * own.sums.common() * spread_of(data_.q, seen);
    }
    if (!(information > 0)) return reach_.resolution;
    return student_interval(kWaveInterval, own.test.degrees) *
           std::sqrt(own.test.level / information);
  }

  void take(const OrderCandidate& own) {
    RippleLine line;
    const double half = half_interval(own);
    line.order = {own.order, own.order - half, own.order + half};
    line.stated = own.stated;
    line.of_motor = data_.gear_ratio != 0 ? own.order / std::abs(data_.gear_ratio) : 0;
    line.chance = std::exp(std::min(0.0, own.log_chance));
    const double power = own.test.separate ? own.sums.separate() : own.sums.common();
    line.lambda = std::max(0.0, 2 * power / own.test.level - (own.test.separate ? 4 : 2));
    const auto frequencies = frequencies_of(own.order);
    line.least_hz = frequencies.first;
    line.most_hz = frequencies.second;
    if (std::optional<OrderRival> rival = rival_of(white_, left_, own.order, own.test, rules_)) {
      line.kind = rival->kind;
      line.rival = rival->value;
      result_.ruled_out.push_back(line);
      // the order's own columns too: it must not be sought again
      left_ =
          left_beside(wave_columns(white_, own.order, rules_.most_per_sample).columns, rival->left);
      base_ = left_ + explained();
      return;
    }
    const PositionTest test = position_test(white_, left_, own.order, own.test, rules_);
    const bool torque = test.torque_beside <= rules_.beside;
    const bool position = test.position_beside <= rules_.beside;
    if (position && !torque) line.kind = RippleKind::kPosition;
    line.open = !position && !torque;
    line.by_speed = position && torque;
    result_.lines.push_back(line);
    refit();
  }

  [[nodiscard]] std::pair<double, double> frequencies_of(double order) const {
    const VectorXd seen = white_.seen(order, rules_.most_per_sample);
    std::vector<double> speeds;
    for (Index k = 0; k < seen.size(); ++k) {
      if (seen[k] != 0) speeds.push_back(std::abs(data_.dq[k]));
    }
    std::sort(speeds.begin(), speeds.end());
    constexpr double kEdge = 0.05;
    const double last = static_cast<double>(speeds.size() - 1);
    return {order / kOrderTurn * speeds[static_cast<std::size_t>(kEdge * last)],
            order / kOrderTurn * speeds[static_cast<std::size_t>((1 - kEdge) * last)]};
  }

  [[nodiscard]] const VectorXd& base() const { return base_.size() > 0 ? base_ : white_.start(); }
  [[nodiscard]] VectorXd explained() const {
    return columns_.cols() > 0 ? VectorXd(columns_ * beta_) : VectorXd::Zero(left_.size());
  }

  /// All orders together. What grows with the speed has columns of its own.
  void refit() {
    std::vector<MatrixXd> parts;
    places_.clear();
    errors_.clear();
    Index count = 0;
    for (const RippleLine& line : result_.lines) {
      places_.push_back(count);
      parts.push_back(wave_columns(white_, line.order.value, rules_.most_per_sample).columns);
      count += parts.back().cols();
    }
    // what grows with the speed is beside the waves, and is not a part of their amplitude
    for (const RippleLine& line : result_.lines) {
      if (line.kind != RippleKind::kPosition && !line.by_speed) {
        errors_.emplace_back(-1, 0);
        continue;
      }
      errors_.push_back({count, 0});
      parts.push_back(position_columns(white_, line.order.value, rules_.most_per_sample));
      errors_.back().second = parts.back().cols();
      if (parts.back().norm() > 0) parts.back() *= parts.front().norm() / parts.back().norm();
      count += parts.back().cols();
    }
    columns_.resize(left_.size(), count);
    Index at = 0;
    for (const MatrixXd& part : parts) {
      columns_.middleCols(at, part.cols()) = part;
      at += part.cols();
    }
    const MatrixXd products = columns_.transpose() * columns_;
    beta_ = products.completeOrthogonalDecomposition().solve(columns_.transpose() * base());
    left_ = base() - columns_ * beta_;
  }

  void answer();
  void answer_waves();
  void answer_spectrum();

  const RippleData& data_;
  const RippleRules& rules_;
  WhiteResidual white_;
  OrderReach reach_;
  VectorXd left_;     ///< white, without what was found
  VectorXd base_;     ///< white, without what was ruled out; empty: nothing was
  MatrixXd columns_;  ///< of all lines
  VectorXd beta_;
  std::vector<Index> places_;  ///< first column of each line
  /// first of the columns that grow with the speed, and how many; -1: none
  std::vector<std::pair<Index, Index>> errors_;
  RippleResult result_;
};

/// The wave a*cos(nq) + b*sin(nq) of two parameters.
RippleWave wave_of(double a, double b, const Eigen::Matrix2d& covariance, int degrees) {
  RippleWave wave;
  wave.known = true;
  const double amplitude = std::hypot(a, b), phase = std::atan2(b, a);
  const double t = student_interval(kWaveInterval, degrees);
  const Eigen::Vector2d along(std::cos(phase), std::sin(phase));
  const Eigen::Vector2d across(-along[1], along[0]);
  const double half = t * std::sqrt(std::max(0.0, along.dot(covariance * along)));
  const double side = t * std::sqrt(std::max(0.0, across.dot(covariance * across)));
  wave.amplitude = {amplitude, std::max(0.0, amplitude - half), amplitude + half};
  const double turn = side < amplitude ? std::asin(side / amplitude) : std::numbers::pi;
  wave.phase = {phase, phase - turn, phase + turn};
  return wave;
}

void RippleAnalysis::answer() {
  result_.judged = true;
  result_.least_order = reach_.least;
  result_.most_order = reach_.most;
  result_.resolution = reach_.resolution;
  result_.noise = white_.innovation();
  answer_waves();
  answer_spectrum();
  std::stable_sort(result_.lines.begin(), result_.lines.end(),
                   [](const RippleLine& a, const RippleLine& b) { return a.lambda > b.lambda; });
}

/// Amplitudes and phases of a line from its columns in a fit, of which the first is `at`.
void set_waves(RippleLine& line, const WaveColumns& waves, const RobustRegression& fit, Index at,
               double beside) {
  const auto own = [&](Index place) {
    return wave_of(fit.beta[place], fit.beta[place + 1], fit.covariance.block<2, 2>(place, place),
                   fit.degrees);
  };
  if (!waves.forward || !waves.backward) {
    (waves.forward ? line.forward : line.backward) = line.both = own(at);
    return;
  }
  line.forward = own(at);
  line.backward = own(at + 2);
  // the weighted mean of both directions, and whether they differ
  const Eigen::Matrix2d here = fit.covariance.block<2, 2>(at, at);
  const Eigen::Matrix2d there = fit.covariance.block<2, 2>(at + 2, at + 2);
  const Eigen::Matrix2d across = fit.covariance.block<2, 2>(at, at + 2);
  const Eigen::Vector2d a = fit.beta.segment<2>(at), b = fit.beta.segment<2>(at + 2);
  const Eigen::Vector2d apart = a - b;
  const Eigen::Matrix2d of_apart = here + there - across - across.transpose();
  const double wald = apart.dot(of_apart.completeOrthogonalDecomposition().solve(apart));
  const double m = 2, degrees = fit.degrees;
  line.differs = variance_ratio_tail((degrees - 1) / degrees * wald / m, m, degrees - 1) <= beside;
  const double part = there.trace() / (here.trace() + there.trace());
  const Eigen::Vector2d mean = part * a + (1 - part) * b;
  const Eigen::Matrix2d of_mean = part * part * here + (1 - part) * (1 - part) * there +
                                  part * (1 - part) * (across + across.transpose());
  line.both = wave_of(mean[0], mean[1], of_mean, fit.degrees);
}

/// Amplitudes and phases of all lines together, with intervals for noise of any correlation. What
/// changes with the speed has those of the mean.
void RippleAnalysis::answer_waves() {
  if (result_.lines.empty()) return;
  std::vector<Index> rows;
  for (Index k = 0; k < left_.size(); ++k) {
    if (white_.direction()[k] != 0) rows.push_back(k);
  }
  constexpr int kMost = 60;  // Student's t has 2.00 there
  const int cosines = std::min(kMost, cosines_for(static_cast<double>(rows.size())));
  const RobustRegression fit =
      robust_regression(columns_(rows, Eigen::all), VectorXd(base()(rows)), cosines);
  for (std::size_t i = 0; i < result_.lines.size(); ++i) {
    RippleLine& line = result_.lines[i];
    const WaveColumns waves = wave_columns(white_, line.order.value, rules_.most_per_sample);
    if (line.kind != RippleKind::kPosition && !line.by_speed) {
      set_waves(line, waves, fit, places_[i], rules_.beside);
      continue;
    }
    const Index count = waves.columns.cols();
    const auto [first, more] = errors_[i];
    const VectorXd own = left_ +
                         columns_.middleCols(places_[i], count) * beta_.segment(places_[i], count) +
                         columns_.middleCols(first, more) * beta_.segment(first, more);
    const RobustRegression alone =
        robust_regression(waves.columns(rows, Eigen::all), VectorXd(own(rows)), cosines);
    set_waves(line, waves, alone, 0, rules_.beside);
  }
}

void RippleAnalysis::answer_spectrum() {
  constexpr Index kMost = 1200;  // values of a chart
  const OrderSpectrum before(white_, white_.start(), reach_, rules_);
  const OrderSpectrum left(white_, left_, reach_, rules_);
  const double log_tail = limit() - std::log(before.tests());
  OrderSpectrum::Shown shown = before.shown(kMost, log_tail);
  result_.shown_order = std::move(shown.order);
  result_.shown_amplitude = std::move(shown.amplitude);
  result_.shown_noise = left.shown(kMost, log_tail).noise;
  std::vector<double> bounds(result_.shown_noise.begin(), result_.shown_noise.end());
  constexpr double kOrders = 0.9, kOneSided = 1.645;  // of the orders; 95 % of one side
  const auto place = bounds.begin() +
                     static_cast<std::ptrdiff_t>(kOrders * static_cast<double>(bounds.size() - 1));
  std::nth_element(bounds.begin(), place, bounds.end());
  // lambda at the limit is 2 F; an order is found 19 times in 20 where its root is 1.645 larger
  const double root = std::sqrt(-2 * log_tail);
  result_.below = *place * (root + kOneSided) / root;
}

}  // namespace

RippleResult analyse_ripple(const RippleData& data, const RippleRules& rules) {
  check_data(data);
  return RippleAnalysis(data, rules).run();
}

}  // namespace dyngen::runtime

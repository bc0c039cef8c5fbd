// SPDX-License-Identifier: MIT
#include "runtime/ripple/order_spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/signals/fourier.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ComplexSums = std::vector<std::complex<double>>;

constexpr int kPerResolution = 4;        // orders looked at per resolution
constexpr double kPiecesPerPeriod = 16;  // pieces of the angle: a wave loses 0.6 % in them
constexpr double kMostPieces = 1 << 22;  // 64 MB of complex numbers

/// Logarithm of P(F > f) of 2 and of 4 degrees to `degrees`: closed forms of the incomplete beta.
double log_tail_of_two(double f, double degrees) {
  return -degrees / 2 * std::log1p(2 * f / degrees);
}
double log_tail_of_four(double f, double degrees) {
  const double x = 1 / (1 + 4 * f / degrees);
  return degrees / 2 * std::log(x) + std::log1p(degrees / 2 * (1 - x));
}

/// Counts of speeds, so that the sum of a filter's gains over samples is one over speeds.
class SpeedCounts {
 public:
  SpeedCounts(const WhiteResidual& white, const VectorXd& seen, int direction) {
    const VectorXd& dq = white.data().dq;
    constexpr Index kClasses = 256;
    fastest_ = dq.cwiseAbs().maxCoeff();
    counts_ = VectorXd::Zero(kClasses);
    for (Index k = 0; k < dq.size(); ++k) {
      if (seen[k] == 0 || white.direction()[k] != direction) continue;
      const double part = std::abs(dq[k]) / fastest_ * kClasses;
      counts_[std::min(kClasses - 1, static_cast<Index>(part))] += 1;
    }
  }
  [[nodiscard]] double gain(const WhiteResidual& white, double order) const {
    const double step = fastest_ / static_cast<double>(counts_.size());
    double sum = 0;
    for (Index i = 0; i < counts_.size(); ++i) {
      if (counts_[i] == 0) continue;
      const double speed = step * (static_cast<double>(i) + 0.5);
      sum += counts_[i] * white.gain(order * speed * white.data().sample_time / kOrderTurn);
    }
    return sum;
  }

 private:
  double fastest_ = 0;
  VectorXd counts_;
};

/// (N) 1 where a sample counts in a direction.
VectorXd of_side(const WhiteResidual& white, const VectorXd& seen, std::size_t side) {
  const double direction = side == 0 ? 1 : -1;
  return (white.direction().array() == direction).select(seen, VectorXd::Zero(seen.size()));
}

}  // namespace

OrderTest order_test(const OrderSums& sums, double level, double degrees) {
  OrderTest test;
  test.level = level;
  test.degrees = degrees;
  test.log_tail = log_tail_of_two(sums.common() / level, degrees);
  if (sums.sides() < 2) return test;
  const double separate = log_tail_of_four(sums.separate() / 2 / level, degrees);
  test.separate = separate < test.log_tail;
  test.log_tail = std::min(test.log_tail, separate) + std::numbers::ln2;  // two tests
  return test;
}

double amplitude_at(const OrderSums& sums, double level, double degrees, double log_tail) {
  const double f = degrees / 2 * std::expm1(-2 * log_tail / degrees);
  const double gain = sums.gain[0] + sums.gain[1];
  return gain > 0 ? 2 * std::sqrt(f * level / gain) : 0;
}

OrderSums order_sums(const WhiteResidual& white, const VectorXd& e, double order, double most) {
  const VectorXd seen = white.seen(order, most);
  const RippleData& data = white.data();
  OrderSums sums;
  for (std::size_t side = 0; side < 2; ++side) {
    const VectorXd own = of_side(white, seen, side);
    if (own.sum() == 0) continue;
    const VectorXd u = white.transposed(e.cwiseProduct(own));
    std::complex<double> sum = 0;
    double gain = 0;
    for (Index k = 0; k < u.size(); ++k) {
      if (u[k] != 0) sum += u[k] * std::polar(1.0, -order * data.q[k]);
    }
    gain = SpeedCounts(white, own, side == 0 ? 1 : -1).gain(white, order);
    sums.sum[side] = sum;
    sums.gain[side] = gain;
  }
  return sums;
}

OrderReach order_reach(const WhiteResidual& white, const RippleRules& rules) {
  OrderReach reach;
  const RippleData& data = white.data();
  const VectorXd counts = white.direction().cwiseAbs();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<double> speeds;
  for (Index k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    low = std::min(low, data.q[k]);
    high = std::max(high, data.q[k]);
    speeds.push_back(std::abs(data.dq[k]));
  }
  if (!(high > low)) return reach;
  constexpr Index kParts = 64;
  VectorXd visits = VectorXd::Zero(kParts);
  for (Index k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    visits[std::min(kParts - 1, static_cast<Index>((data.q[k] - low) / (high - low) * kParts))] +=
        1;
  }
  reach.resolution = kOrderTurn / (high - low);
  reach.apart = reach.resolution * kParts * visits.squaredNorm() / std::pow(visits.sum(), 2);
  constexpr double kCycles = 2.5;  // in the travel: 1.5 are slow structure, and one is a resolution
  reach.least = std::max<double>(rules.least_order, kCycles * reach.resolution);
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(
                                          rules.least_samples * static_cast<double>(speeds.size()));
  std::nth_element(speeds.begin(), place, speeds.end());
  reach.most = std::min<double>(rules.most_order,
                                rules.most_per_sample * kOrderTurn / (*place * data.sample_time));
  reach.most = std::min(reach.most,
                        kMostPieces / (4 * kPiecesPerPeriod * kPerResolution) * reach.resolution);
  return reach;
}

OrderSpectrum::OrderSpectrum(const WhiteResidual& white, const VectorXd& e, const OrderReach& reach,
                             const RippleRules& rules)
    : reach_(reach), rules_(rules) {
  for (double from = reach.least; from < reach.most; from *= 2) {
    bands_.push_back(band(white, e, from, std::min(2 * from, reach.most)));
  }
}

OrderSpectrum::OrderSpectrum(const WhiteResidual& white, const VectorXd& e, const OrderReach& reach,
                             const RippleRules& rules, double order)
    : reach_(reach), rules_(rules) {
  double from = reach.least;
  while (2 * from < std::min(order, reach.most)) from *= 2;
  bands_.push_back(band(white, e, from, std::min(2 * from, reach.most)));
}

OrderSpectrum::Band OrderSpectrum::band(const WhiteResidual& white, const VectorXd& e, double from,
                                        double to) const {
  const RippleData& data = white.data();
  Band own{from, to, 0, {}};
  const double beyond = to + (rules_.nearest + rules_.neighbours) * reach_.apart;
  const double width = kOrderTurn / beyond / kPiecesPerPeriod;
  std::size_t size = 1;
  while (static_cast<double>(size) * width * reach_.resolution / kPerResolution < kOrderTurn)
    size *= 2;
  own.step = kOrderTurn / (width * static_cast<double>(size));
  own.sums.resize(1 + static_cast<std::size_t>(beyond / own.step));
  const VectorXd seen = white.seen(to, rules_.most_per_sample);
  const double first = data.q.minCoeff();
  for (std::size_t side = 0; side < 2; ++side) {
    const VectorXd counted = of_side(white, seen, side);
    if (counted.sum() < rules_.least_samples / 2 * static_cast<double>(white.counted())) continue;
    const VectorXd u = white.transposed(e.cwiseProduct(counted));
    ComplexSums pieces(size, 0);
    for (Index k = 0; k < u.size(); ++k) {
      if (u[k] == 0) continue;
      // pieces beyond the counted travel are those of the filter's memory: some samples
      pieces[static_cast<std::size_t>((data.q[k] - first) / width) % size] += u[k];
    }
    const ComplexSums transform = fourier(pieces);
    const SpeedCounts speeds(white, counted, side == 0 ? 1 : -1);
    for (std::size_t i = 1; i < own.sums.size(); ++i) {
      own.sums[i].sum[side] = transform[i];
    }
    // the gain is smooth: every so many orders, and a line between
    constexpr std::size_t kSmooth = 16;
    double before = speeds.gain(white, 0);
    for (std::size_t i = 0; i < own.sums.size(); i += kSmooth) {
      const double behind = speeds.gain(white, own.step * static_cast<double>(i + kSmooth));
      for (std::size_t k = i; k < std::min(own.sums.size(), i + kSmooth); ++k) {
        own.sums[k].gain[side] =
            before + (behind - before) * static_cast<double>(k - i) / static_cast<double>(kSmooth);
      }
      before = behind;
    }
  }
  return own;
}

std::optional<OrderTest> OrderSpectrum::level_in(const Band& band, Index place) const {
  OrderTest test;
  double sum = 0;
  const auto size = static_cast<Index>(band.sums.size());
  const auto least = static_cast<Index>(reach_.least / 2 / band.step);
  for (int n = 0; n < rules_.neighbours; ++n) {
    const auto away =
        static_cast<Index>(std::lround((rules_.nearest + n) * reach_.apart / band.step));
    for (const Index at : {place - away, place + away}) {
      if (at < least || at >= size) continue;
      const OrderSums& own = band.sums[static_cast<std::size_t>(at)];
      sum += own.separate();
      test.degrees += 2 * own.sides();
    }
  }
  if (test.degrees < 2 * rules_.neighbours || !(sum > 0)) return std::nullopt;
  test.level = 2 * sum / test.degrees;
  return test;
}

std::optional<OrderTest> OrderSpectrum::level_at(double order) const {
  for (const Band& band : bands_) {
    if (order > band.to && &band != &bands_.back()) continue;
    return level_in(band, static_cast<Index>(std::lround(order / band.step)));
  }
  return std::nullopt;
}

std::optional<OrderSpectrum::Peak> OrderSpectrum::strongest(
    const std::vector<double>& known) const {
  std::optional<Peak> best;
  const double part = rules_.part_of_line * reach_.resolution;
  for (const Band& band : bands_) {
    const auto to = static_cast<Index>(band.to / band.step);
    for (auto i = static_cast<Index>(std::ceil(band.from / band.step)); i <= to; ++i) {
      const double order = static_cast<double>(i) * band.step;
      const bool is_known = std::any_of(known.begin(), known.end(),
                                        [&](double own) { return std::abs(own - order) < part; });
      if (is_known) continue;
      const std::optional<OrderTest> level = level_in(band, i);
      if (!level) continue;
      const OrderTest test =
          order_test(band.sums[static_cast<std::size_t>(i)], level->level, level->degrees);
      if (!best || test.log_tail < best->test.log_tail) best = Peak{order, test};
    }
  }
  return best;
}

double OrderSpectrum::tests() const { return 2 * (reach_.most - reach_.least) / reach_.resolution; }

OrderSpectrum::Shown OrderSpectrum::shown(Index count, double log_tail) const {
  Shown all{VectorXd(count), VectorXd::Zero(count), VectorXd::Zero(count)};
  const double step = (reach_.most - reach_.least) / static_cast<double>(count);
  for (Index i = 0; i < count; ++i) {
    const double from = reach_.least + static_cast<double>(i) * step, to = from + step;
    all.order[i] = from + step / 2;
    for (const Band& band : bands_) {
      if (from >= band.to || to < band.from) continue;
      const auto end = static_cast<Index>(std::ceil(to / band.step));
      for (auto k = static_cast<Index>(from / band.step); k <= end; ++k) {
        if (k < 1 || k >= static_cast<Index>(band.sums.size())) continue;
        const OrderSums& sums = band.sums[static_cast<std::size_t>(k)];
        const double gain = sums.gain[0] + sums.gain[1];
        if (!(gain > 0)) continue;
        all.amplitude[i] = std::max(all.amplitude[i], 2 * std::sqrt(sums.common() / gain));
        if (const auto level = level_in(band, k)) {
          all.noise[i] =
              std::max(all.noise[i], amplitude_at(sums, level->level, level->degrees, log_tail));
        }
      }
    }
  }
  return all;
}

}  // namespace dyngen::runtime

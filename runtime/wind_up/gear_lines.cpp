// SPDX-License-Identifier: MIT
#include "runtime/wind_up/gear_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

/// A residual summed over small pieces of the angle, all parts of the travel alike. The weights of
/// the samples have the sum N.
struct AngleBins {
  double first = 0, width = 0;
  VectorXd sums;

  AngleBins(const VectorXd& q, const VectorXd& residual, double most_order) {
    constexpr double kPerPeriod = 16;
    first = q.minCoeff();
    width = kTurn / most_order / kPerPeriod;
    const double travel = q.maxCoeff() - first;
    sums = VectorXd::Zero(1 + static_cast<Index>(travel / width));
    // where a joint is often, each sample counts less: else its neighbours would show every line
    constexpr Index kParts = 32;
    constexpr double kRare = 0.2;  // of the mean: rarer parts do not count more
    const auto part = [&](Index k) {
      return std::min(kParts - 1, static_cast<Index>((q[k] - first) / travel * kParts));
    };
    VectorXd counts = VectorXd::Zero(kParts);
    for (Index k = 0; k < q.size(); ++k) counts[part(k)] += 1;
    const VectorXd weights = counts.cwiseMax(kRare * counts.mean()).cwiseInverse();
    const double scale = static_cast<double>(q.size()) / weights.dot(counts);
    for (Index k = 0; k < q.size(); ++k) {
      sums[static_cast<Index>((q[k] - first) / width)] += scale * weights[part(k)] * residual[k];
    }
  }

  [[nodiscard]] double power(double order) const {
    const std::complex<double> turn = std::polar(1.0, order * width);
    std::complex<double> phase = 1, sum = 0;
    for (const double own : sums) {
      sum += own * phase;
      phase *= turn;
    }
    return std::norm(sum);
  }
};

}  // namespace

OrderRange orders_seen(const VectorXd& q, const VectorXd& dq, double sample_time, double cycles) {
  OrderRange range;
  const double travel = (q.maxCoeff() - q.minCoeff()) / kTurn;
  if (!(travel > 0)) return range;
  range.resolution = 1 / travel;
  range.least = std::max(1.0, cycles) * range.resolution;
  if (travel > 1) range.least = std::max(1.5, cycles * range.resolution);
  std::vector<double> speeds(dq.begin(), dq.end());
  constexpr double kUsual = 0.9;
  const auto usual =
      speeds.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(speeds.size() - 1));
  for (double& speed : speeds) speed = std::abs(speed);
  std::nth_element(speeds.begin(), usual, speeds.end());
  if (*usual > 0) range.most = kTurn / 4 / (*usual * sample_time);
  constexpr double kMost = 2000;  // orders: teeth of a strain wave gear, twice
  range.most = std::min(range.most, kMost);
  return range;
}

std::optional<GearLine> strongest_line(const VectorXd& q, const VectorXd& residual,
                                       const OrderRange& range, int neighbours,
                                       const std::vector<double>& known) {
  if (range.empty()) return std::nullopt;
  constexpr int kFine = 4;  // orders looked at per resolution
  const auto count = static_cast<Index>((range.most - range.least) / range.resolution * kFine);
  const Index half = neighbours / 2;
  if (count < kFine * (neighbours + 4)) return std::nullopt;
  const AngleBins bins(q, residual, range.most);
  VectorXd power(count);
  const auto order = [&](Index i) {
    return range.least + static_cast<double>(i) * range.resolution / kFine;
  };
  for (Index i = 0; i < count; ++i) power[i] = bins.power(order(i));
  constexpr double kPartOfLine = 1.5;  // resolutions
  const auto is_known = [&](double at) {
    return std::any_of(known.begin(), known.end(), [&](double own) {
      return std::abs(own - at) < kPartOfLine * range.resolution;
    });
  };
  std::optional<GearLine> best;
  Index place = 0;
  for (Index i = 0; i < count; ++i) {
    if (is_known(order(i))) continue;
    double sum = 0;
    int used = 0;
    for (Index n = 0; n < half; ++n) {
      const Index away = kFine * (n + 1) + kFine / 2;
      for (const Index at : {i - away, i + away}) {
        if (at < 0 || at >= count) continue;
        sum += power[at];
        ++used;
      }
    }
    if (used < half || !(sum > 0)) continue;
    const double ratio = power[i] / (sum / used);
    if (best && ratio <= best->ratio) continue;
    const double orders = static_cast<double>(count) / kFine;
    // orders between the independent ones are looked at too: twice as many tests
    place = i;
    best = GearLine{0, ratio, std::min(1.0, 2 * orders * variance_ratio_tail(ratio, 2, 2.0 * used)),
                    0};
  }
  if (!best) return best;
  // beside a line the neighbours may be fewer still: the line is where the power is largest
  const Index from = std::max<Index>(0, place - kFine);
  const Index size = std::min(count, place + kFine + 1) - from;
  best->power = power.segment(from, size).maxCoeff(&place);
  best->order = order(from + place);
  return best;
}

}  // namespace dyngen::runtime

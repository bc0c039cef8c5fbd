// SPDX-License-Identifier: MIT
#include "runtime/report/thinning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Least and largest value of a part of a signal, in the order in which they stand.
std::pair<double, double> extremes(const Eigen::Ref<const VectorXd>& y) {
  Index least = -1, most = -1;
  for (Index i = 0; i < y.size(); ++i) {
    if (!std::isfinite(y[i])) continue;
    if (least < 0 || y[i] < y[least]) least = i;
    if (most < 0 || y[i] > y[most]) most = i;
  }
  if (least < 0) return {kNaN, kNaN};
  return {y[std::min(least, most)], y[std::max(least, most)]};
}

double quantile(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

ThinnedSignals thinned_signals(const VectorXd& x, const MatrixXd& y, Index slices) {
  if (x.size() != y.rows() || slices < 1) {
    throw std::invalid_argument(
        fmt::format("thinned_signals(): {} values of x, {} of y and {} slices, expected as many of "
                    "both and at least one slice",
                    x.size(), y.rows(), slices));
  }
  if (x.size() <= 2 * slices) return {x, y};
  ThinnedSignals thin{VectorXd(2 * slices), MatrixXd(2 * slices, y.cols())};
  for (Index slice = 0; slice < slices; ++slice) {
    const Index from = slice * x.size() / slices, to = (slice + 1) * x.size() / slices;
    thin.x[2 * slice] = x[from];
    thin.x[2 * slice + 1] = x[from + (to - from) / 2];
    for (Index j = 0; j < y.cols(); ++j) {
      std::tie(thin.y(2 * slice, j), thin.y(2 * slice + 1, j)) =
          extremes(y.col(j).segment(from, to - from));
    }
  }
  return thin;
}

Bins bins_of(const VectorXd& x, double from, double to, Index most) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return x[a] < x[b]; });
  const double first = x[order.front()], length = std::max(x[order.back()] - first, 1e-300);
  const bool ranged = to > from;
  Bins bins;
  bins.of.resize(order.size());
  std::vector<double> sums, counts;
  Index last = -1;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double value = x[order[i]];
    double part =
        (static_cast<double>(i) / static_cast<double>(order.size()) + (value - first) / length);
    if (ranged) part += std::clamp((value - from) / (to - from), 0.0, 1.0);
    part /= ranged ? 3 : 2;
    const Index bin = std::min(most - 1, static_cast<Index>(part * static_cast<double>(most)));
    const bool tie = i > 0 && value == x[order[i - 1]];
    if (bin != last && !tie) {
      sums.push_back(0);
      counts.push_back(0);
      last = bin;
    }
    bins.of[static_cast<std::size_t>(order[i])] = static_cast<Index>(sums.size()) - 1;
    sums.back() += value;
    counts.back() += 1;
  }
  bins.x.resize(static_cast<Index>(sums.size()));
  for (Index b = 0; b < bins.x.size(); ++b) {
    bins.x[b] = sums[static_cast<std::size_t>(b)] / counts[static_cast<std::size_t>(b)];
  }
  return bins;
}

BinnedValues binned(const Bins& bins, const VectorXd& y, const std::vector<bool>& chosen,
                    Index least) {
  std::vector<std::vector<double>> values(static_cast<std::size_t>(bins.x.size()));
  for (std::size_t i = 0; i < bins.of.size(); ++i) {
    const double value = y[static_cast<Index>(i)];
    if ((!chosen.empty() && !chosen[i]) || !std::isfinite(value)) continue;
    values[static_cast<std::size_t>(bins.of[i])].push_back(value);
  }
  BinnedValues result;
  result.mean = result.low = result.high = VectorXd::Constant(bins.x.size(), kNaN);
  for (Index b = 0; b < bins.x.size(); ++b) {
    std::vector<double>& here = values[static_cast<std::size_t>(b)];
    if (static_cast<Index>(here.size()) < least) continue;
    std::sort(here.begin(), here.end());
    result.mean[b] =
        std::accumulate(here.begin(), here.end(), 0.0) / static_cast<double>(here.size());
    result.low[b] = quantile(here, 0.25);
    result.high[b] = quantile(here, 0.75);
  }
  return result;
}

std::vector<Index> drawn_samples(const VectorXd& y, Index most) {
  std::set<Index> places;
  if (y.size() <= most) {
    for (Index i = 0; i < y.size(); ++i) places.insert(i);
  } else {
    // at random within its slice: a motion that repeats is not sampled at the same phase
    std::mt19937_64 random(1);
    for (Index slice = 0; slice < most; ++slice) {
      const Index from = slice * y.size() / most, to = (slice + 1) * y.size() / most;
      places.insert(from + static_cast<Index>(random() % static_cast<std::uint64_t>(to - from)));
    }
    std::vector<Index> order(static_cast<std::size_t>(y.size()));
    std::iota(order.begin(), order.end(), Index{0});
    const auto extremes = static_cast<std::ptrdiff_t>(std::max<Index>(1, most / 20));
    std::partial_sort(order.begin(), order.begin() + extremes, order.end(), [&](Index a, Index b) {
      const double first = std::abs(y[a]), second = std::abs(y[b]);
      return first != second ? first > second : a < b;
    });
    places.insert(order.begin(), order.begin() + extremes);
  }
  return {places.begin(), places.end()};
}

}  // namespace dyngen::runtime

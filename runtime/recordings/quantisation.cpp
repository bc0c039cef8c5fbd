// SPDX-License-Identifier: MIT
#include "runtime/recordings/quantisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kFewestChanges = 30;
constexpr double kMostSteps = 50;   // a change of more steps tells little
constexpr double kTolerance = 0.1;  // of a step; a fifth of random changes fit by chance
constexpr double kNearlyAll = 0.9;  // of the changes
constexpr std::array<int, 3> kPrimes = {2, 3, 5};
constexpr int kMostDivisors = 6;  // the smallest change may be that many steps

/// Absolute changes between samples that are not rounding, in rising order.
std::vector<double> sorted_changes(const Eigen::Ref<const Eigen::VectorXd>& signal) {
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * signal.cwiseAbs().maxCoeff();
  std::vector<double> changes;
  for (Index k = 1; k < signal.size(); ++k) {
    const double change = std::abs(signal(k) - signal(k - 1));
    if (std::isfinite(change) && change > rounding) changes.push_back(change);
  }
  std::sort(changes.begin(), changes.end());
  return changes;
}

struct Fit {
  double step = 0;
  double fraction = 0;
  std::size_t count = 0;   ///< changes that were looked at
  bool primitive = false;  ///< not nearly all of them are multiples of two, three or five steps
};

/// Least squares of change = k * step over the changes of few steps, k growing as step gets better.
Fit refine(const std::vector<double>& changes, double step) {
  for (const double most : {3.0, 10.0, kMostSteps}) {
    double top = 0, bottom = 0;
    for (const double change : changes) {
      const double k = std::round(change / step);
      if (k > most) break;
      if (k < 1 || std::abs(change / step - k) > 2 * kTolerance) continue;
      top += change * k;
      bottom += k * k;
    }
    if (bottom > 0) step = top / bottom;
  }
  Fit fit{step, 0, 0, false};
  std::size_t whole = 0;
  std::array<std::size_t, 3> not_multiples = {};
  for (const double change : changes) {
    const double k = std::round(change / step);
    if (k > kMostSteps) break;
    ++fit.count;
    if (k < 1 || std::abs(change / step - k) > kTolerance) continue;
    ++whole;
    for (std::size_t i = 0; i < kPrimes.size(); ++i) {
      if (static_cast<int>(k) % kPrimes[i] != 0) ++not_multiples[i];
    }
  }
  if (fit.count > 0) fit.fraction = static_cast<double>(whole) / static_cast<double>(fit.count);
  fit.primitive = std::all_of(not_multiples.begin(), not_multiples.end(), [&](std::size_t some) {
    return static_cast<double>(some) > (1 - kNearlyAll) / 2 * static_cast<double>(whole);
  });
  return fit;
}

/// The step is 10^-k, and most values are multiples of it. (Numbers printed with so many digits
/// have more decimals where they are small.)
bool is_decimal(const Eigen::Ref<const Eigen::VectorXd>& signal, double step) {
  const double unit = std::pow(10.0, std::round(std::log10(step)));
  constexpr double kSame = 1e-3, kClose = 0.02;
  if (std::abs(step - unit) > kSame * unit) return false;
  const auto multiple = [&](double value) {
    return std::abs(value / unit - std::round(value / unit)) <= kClose;
  };
  const auto multiples = std::count_if(signal.begin(), signal.end(), multiple);
  return 2 * multiples >= signal.size();
}

}  // namespace

Quantisation find_quantisation(const Eigen::Ref<const Eigen::VectorXd>& signal) {
  Quantisation found;
  if (signal.size() < 2) return found;
  const std::vector<double> changes = sorted_changes(signal);
  if (changes.size() < kFewestChanges) return found;
  // Of the smallest changes some may be outliers: begin at several.
  for (const std::size_t place : {changes.size() / 200, changes.size() / 50, changes.size() / 10}) {
    for (int divisor = 1; divisor <= kMostDivisors; ++divisor) {
      const Fit fit = refine(changes, changes[place] / divisor);
      if (fit.fraction < kNearlyAll || fit.count < kFewestChanges || !fit.primitive ||
          fit.step <= found.step) {
        continue;
      }
      found.step = fit.step;
      found.fraction = fit.fraction;
      break;
    }
  }
  found.print_resolution = found.step > 0 && is_decimal(signal, found.step);
  return found;
}

}  // namespace dyngen::runtime

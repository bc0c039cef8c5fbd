// SPDX-License-Identifier: MIT
#include "runtime/report/robust_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dyngen::runtime {
namespace {

constexpr double kTail = 0.005;  // of the values on either side that do not decide the range
constexpr double kMargin = 1;    // of the range between the tails, on either side

double value_at(std::vector<double>& values, double part) {
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

}  // namespace

void RobustRange::add(const Eigen::VectorXd& values) {
  std::copy_if(values.begin(), values.end(), std::back_inserter(values_),
               [](double value) { return std::isfinite(value); });
}

void RobustRange::settle() {
  low_ = -std::numeric_limits<double>::infinity();
  high_ = std::numeric_limits<double>::infinity();
  if (values_.empty()) return;
  const double low = value_at(values_, kTail), high = value_at(values_, 1 - kTail);
  if (high > low) {
    low_ = low - kMargin * (high - low);
    high_ = high + kMargin * (high - low);
  }
  values_.clear();
}

Eigen::VectorXd RobustRange::without_outside(Eigen::VectorXd values) {
  for (double& value : values) {
    if (!std::isfinite(value) || (value >= low_ && value <= high_)) continue;
    ++outside_;
    if (std::abs(value) > std::abs(farthest_)) farthest_ = value;
    value = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

Eigen::VectorXd RobustRange::cut(Eigen::VectorXd values) {
  for (double& value : values) {
    if (!std::isfinite(value) || (value >= low_ && value <= high_)) continue;
    ++outside_;
    if (std::abs(value) > std::abs(farthest_)) farthest_ = value;
    value = std::clamp(value, low_, high_);
  }
  return values;
}

std::string RobustRange::words(const std::string& unit) const {
  if (outside_ == 0) return "";
  return fmt::format(" {} value{} outside what is drawn, the farthest at {:.4g} {}.", outside_,
                     outside_ == 1 ? " lies" : "s lie", farthest_, unit);
}

}  // namespace dyngen::runtime

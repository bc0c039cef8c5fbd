// SPDX-License-Identifier: MIT
#include "runtime/ripple/white_residual.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "runtime/estimation/burg.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The speed that 90 % of the samples are below.
double usual_speed(const VectorXd& dq) {
  constexpr double kUsual = 0.9;
  std::vector<double> speeds(dq.begin(), dq.end());
  for (double& speed : speeds) speed = std::abs(speed);
  const auto place =
      speeds.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), place, speeds.end());
  return *place;
}

}  // namespace

Index end_of_run(const RippleData& data, std::size_t i) {
  return i + 1 < data.run_starts.size() ? data.run_starts[i + 1] : data.q.size();
}

WhiteResidual::WhiteResidual(const RippleData& data, const RippleRules& rules)
    : data_(data), direction_(VectorXd::Zero(data.q.size())) {
  if (data.q.size() == 0) return;
  const double slowest = rules.slowest * usual_speed(data.dq);
  if (!(slowest > 0)) return;
  const auto side = [&](Index k) {
    return data.dq[k] > slowest ? 1 : (data.dq[k] < -slowest ? -1 : 0);
  };
  const auto most = static_cast<Index>(rules.most_coefficients);
  std::vector<VectorXd> pieces;
  for (std::size_t run = 0; run < data.run_starts.size(); ++run) {
    const Index end = end_of_run(data, run);
    for (Index k = data.run_starts[run]; k < end;) {
      const Index from = k;
      const int own = side(k);
      while (k < end && side(k) == own) ++k;
      if (own == 0 || k - from <= 2 * most) continue;
      pieces.emplace_back(data.residual.segment(from, k - from));
      // what the filter remembers from before the run is not known
      const Index first = std::max(from, data.run_starts[run] + most);
      if (first >= k) continue;
      stretches_.push_back({first, k, own});
      direction_.segment(first, k - first).setConstant(own);
      counted_ += k - first;
    }
  }
  const AutoregressiveNoise noise = autoregression_of(pieces, most);
  coefficients_ = noise.coefficients;
  innovation_ = noise.innovation;
  if (usable()) start_ = filtered(data.residual).cwiseProduct(direction_.cwiseAbs());
}

VectorXd WhiteResidual::filtered(const VectorXd& signal) const {
  VectorXd result = signal;
  for (std::size_t run = 0; run < data_.run_starts.size(); ++run) {
    const Index first = data_.run_starts[run], count = end_of_run(data_, run) - first;
    for (Index k = 0; k < coefficients_.size(); ++k) {
      const Index rest = count - k - 1;
      if (rest <= 0) break;
      result.segment(first + k + 1, rest) -= coefficients_[k] * signal.segment(first, rest);
    }
  }
  return result / innovation_;
}

VectorXd WhiteResidual::transposed(const VectorXd& white) const {
  VectorXd result = white;
  for (std::size_t run = 0; run < data_.run_starts.size(); ++run) {
    const Index first = data_.run_starts[run], count = end_of_run(data_, run) - first;
    for (Index k = 0; k < coefficients_.size(); ++k) {
      const Index rest = count - k - 1;
      if (rest <= 0) break;
      result.segment(first, rest) -= coefficients_[k] * white.segment(first + k + 1, rest);
    }
  }
  return result / innovation_;
}

double WhiteResidual::gain(double frequency) const {
  std::complex<double> sum = 1;
  const std::complex<double> step = std::polar(1.0, -2 * std::numbers::pi * frequency);
  std::complex<double> phase = 1;
  for (const double own : coefficients_) {
    phase *= step;
    sum -= own * phase;
  }
  return std::norm(sum) / (innovation_ * innovation_);
}

VectorXd WhiteResidual::seen(double order, double most) const {
  const double fastest = most * 2 * std::numbers::pi / (order * data_.sample_time);
  return (data_.dq.array().abs() <= fastest)
      .select(direction_.cwiseAbs(), VectorXd::Zero(direction_.size()));
}

}  // namespace dyngen::runtime

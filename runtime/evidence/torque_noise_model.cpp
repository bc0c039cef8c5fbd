// SPDX-License-Identifier: MIT
#include "runtime/evidence/torque_noise_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/effects/effect_rows.h"
#include "runtime/recordings/periods.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLags = 40;
constexpr double kLeastPart = 0.6;  // of the equations that differences between periods must give

/// Sums of products at all lags, and of how many pairs of samples.
struct LagProducts {
  VectorXd sums = VectorXd::Zero(kLags + 1);
  VectorXd pairs = VectorXd::Zero(kLags + 1);

  /// @param e  0 where `counted` is
  void add(const VectorXd& e, const VectorXd& counted) {
    for (Index lag = 0; lag <= std::min(kLags, e.size() - 1); ++lag) {
      const Index rows = e.size() - lag;
      sums[lag] += e.tail(rows).dot(e.head(rows));
      pairs[lag] += counted.tail(rows).dot(counted.head(rows));
    }
  }

  [[nodiscard]] double samples() const { return pairs[0]; }
  [[nodiscard]] VectorXd covariance() const { return sums.cwiseQuotient(pairs.cwiseMax(1)); }
};

/// (e_t - e_(t - P)) / sqrt(2) of whole runs, and where both count.
void difference_of_periods(const VectorXd& e, const VectorXd& counted, double period,
                           LagProducts& products) {
  const auto whole = static_cast<Index>(std::llround(period));
  if (whole < 1 || 2 * whole > e.size() + whole / 2) return;
  const VectorXd moved = shifted(e, static_cast<double>(whole) - period);
  const Index rows = e.size() - whole;
  VectorXd both = counted.tail(rows).cwiseProduct(counted.head(rows));
  const VectorXd difference = (e.tail(rows) - moved.head(rows)).cwiseProduct(both) / std::sqrt(2.0);
  products.add(difference, both);
}

}  // namespace

std::vector<double> repeats_of(const EffectRecordings& data) {
  std::vector<double> repeats;
  for (const EffectRun& run : data.runs) {
    Recording positions;
    positions.time = run.motion.time;
    positions.q = run.motion.q;
    positions.run_starts = {0};
    const Periods periods = find_periods(positions);
    const double row_time = run.motion.sample_time * static_cast<double>(run.decimator.factor);
    repeats.push_back(periods.count >= 2 ? periods.period / row_time : 0);
  }
  return repeats;
}

TorqueNoiseModel torque_noise_model(const EffectRecordings& data, const RunResiduals& residuals,
                                    const std::vector<double>& repeats, const VectorXd& fitted) {
  TorqueNoiseModel model;
  const int n = data.joints();
  model.worth.resize(n);
  std::vector<LagProducts> repeated(static_cast<std::size_t>(n)), all(static_cast<std::size_t>(n));
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    for (int j = 0; j < n; ++j) {
      const VectorXd e = residuals[run].col(j), counted = data.runs[run].rows.counted.col(j);
      all[static_cast<std::size_t>(j)].add(e, counted);
      if (repeats[run] > 0) {
        difference_of_periods(e, counted, repeats[run], repeated[static_cast<std::size_t>(j)]);
      }
    }
  }
  model.from_periods = true;
  for (std::size_t j = 0; j < all.size(); ++j) {
    model.from_periods = model.from_periods &&
                         repeated[j].samples() >= kLeastPart * all[j].samples() &&
                         all[j].samples() > 0;
  }
  for (std::size_t j = 0; j < all.size(); ++j) {
    const LagProducts& products = model.from_periods ? repeated[j] : all[j];
    const double samples = std::max(products.samples(), 1.0);
    AutoregressiveNoise noise = fit_autoregression(products.covariance(), samples);
    if (!model.from_periods) {
      // the fit takes what lies in its span: as many independent samples as it has parameters
      const double independent = samples / std::max(1.0, noise.correlation_time);
      const double left =
          std::max(0.2, 1 - fitted[static_cast<Index>(j)] / std::max(independent, 1.0));
      noise.innovation /= std::sqrt(left);
      noise.deviation /= std::sqrt(left);
    }
    if (!(noise.innovation > 0)) {
      throw std::invalid_argument(
          fmt::format("the model explains the torque of joint {} exactly: there is no noise to "
                      "judge by; expected a recording of a real measurement",
                      j + 1));
    }
    model.worth[static_cast<Index>(j)] = all[j].samples() / std::max(1.0, noise.correlation_time);
    model.joints.push_back(std::move(noise));
  }
  return model;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/evidence/torque_noise_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "runtime/effects/effect_rows.h"
#include "runtime/effects/equation_stack.h"
#include "runtime/evidence/lasting_noise.h"
#include "runtime/recordings/periods.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLags = 40;
constexpr double kLeastPart = 0.6;  // of the equations that differences between periods must give
constexpr double kLasting = 0.02;   // of the variance, w of lasting_part(): with less, it is none

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

  void add(const LagProducts& other) {
    sums += other.sums;
    pairs += other.pairs;
  }

  [[nodiscard]] double samples() const { return pairs[0]; }
  [[nodiscard]] VectorXd covariance() const { return sums.cwiseQuotient(pairs.cwiseMax(1)); }
};

/// (e_t - e_(t - kP)) / sqrt(2) of whole runs, and where both count.
LagProducts difference_of_periods(const VectorXd& e, const VectorXd& counted, double period,
                                  int apart) {
  LagProducts products;
  const auto whole = static_cast<Index>(std::llround(apart * period));
  const Index rows = e.size() - whole;
  if (whole < 1 || 2 * static_cast<double>(rows) < period) return products;
  const VectorXd moved = shifted(e, static_cast<double>(whole) - apart * period);
  const VectorXd both = counted.tail(rows).cwiseProduct(counted.head(rows));
  const VectorXd difference = (e.tail(rows) - moved.head(rows)).cwiseProduct(both) / std::sqrt(2.0);
  products.add(difference, both);
  return products;
}

/// Differences of one joint over one period, and over several, run by run.
struct JointDifferences {
  LagProducts neighbours;
  std::vector<PeriodDifference> all;

  void add(const VectorXd& e, const VectorXd& counted, double period) {
    const int most = static_cast<int>(static_cast<double>(e.size()) / period);
    for (int apart = 1; apart <= most; ++apart) {
      const LagProducts products = difference_of_periods(e, counted, period, apart);
      if (products.samples() < static_cast<double>(kLags)) return;
      if (apart == 1) neighbours.add(products);
      all.push_back({period, apart, products.covariance(), products.samples()});
    }
  }
};

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

namespace {

constexpr int kRounds = 3;  // of the search for the noise before the fit
constexpr int kDraws = 8;   // of simulated noise in each
constexpr unsigned kSeed = 20261121;

using OfJoints = std::vector<LagProducts>;

OfJoints lag_products(const EffectRecordings& data, const RunResiduals& residuals) {
  OfJoints products(static_cast<std::size_t>(data.joints()));
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    for (int j = 0; j < data.joints(); ++j) {
      products[static_cast<std::size_t>(j)].add(residuals[run].col(j),
                                                data.runs[run].rows.counted.col(j));
    }
  }
  return products;
}

/// Noise of all joints, 0 where equations do not count.
RunResiduals simulated(const EffectRecordings& data, const std::vector<AutoregressiveNoise>& joints,
                       std::mt19937_64& random) {
  constexpr Index kRunIn = 200;
  std::normal_distribution<double> normal;
  RunResiduals noise;
  for (const EffectRun& run : data.runs) {
    const Index rows = run.rows.Y.rows();
    noise.emplace_back(rows, data.joints());
    for (Index j = 0; j < data.joints(); ++j) {
      const AutoregressiveNoise& process = joints[static_cast<std::size_t>(j)];
      const Index order = process.coefficients.size();
      VectorXd x = VectorXd::Zero(kRunIn + rows);
      for (Index t = 0; t < x.size(); ++t) {
        x[t] = process.innovation * normal(random);
        for (Index k = 0; k < std::min(order, t); ++k)
          x[t] += process.coefficients[k] * x[t - 1 - k];
      }
      noise.back().col(j) = x.tail(rows).cwiseProduct(run.rows.counted.col(j));
    }
  }
  return noise;
}

/// What a fit of the model takes of residuals, joints weighted by their noise.
class FittedPart {
 public:
  FittedPart(const EffectRecordings& data, const std::vector<AutoregressiveNoise>& joints)
      : weights_(data.joints()) {
    for (Index j = 0; j < weights_.size(); ++j) {
      weights_[j] = 1 / joints[static_cast<std::size_t>(j)].deviation;
    }
    const Index size = data.model.size();
    MatrixXd W = MatrixXd::Zero(data.equations() * data.joints(), size);
    Index start = 0;
    for (const EffectRun& run : data.runs) {
      for (Index j = 0; j < data.joints(); ++j) {
        for (const int c : data.model.columns[static_cast<std::size_t>(j)]) {
          W.col(c).segment(start, run.rows.Y.rows()) =
              weights_[j] * run.rows.Y.col(j * size + c).cwiseProduct(run.rows.counted.col(j));
        }
        start += run.rows.Y.rows();
      }
    }
    basis_ = orthonormal(W);
  }

  void take_out_of(RunResiduals& residuals) const {
    VectorXd all(basis_.rows());
    each(residuals,
         [&](auto part, double weight, Index at) { all.segment(at, part.size()) = weight * part; });
    all -= basis_ * (basis_.transpose() * all);
    each(residuals,
         [&](auto part, double weight, Index at) { part = all.segment(at, part.size()) / weight; });
  }

 private:
  template <class Visit>
  void each(RunResiduals& residuals, const Visit& visit) const {
    Index at = 0;
    for (MatrixXd& run : residuals) {
      for (Index j = 0; j < run.cols(); ++j) {
        visit(run.col(j), weights_[j], at);
        at += run.rows();
      }
    }
  }

  VectorXd weights_;
  MatrixXd basis_;
};

/// Processes whose noise, behind a fit, has the autocovariances that were observed.
std::vector<AutoregressiveNoise> before_the_fit(const EffectRecordings& data,
                                                const OfJoints& observed,
                                                std::vector<AutoregressiveNoise> joints) {
  const FittedPart fit(data, joints);
  std::mt19937_64 random(kSeed);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<VectorXd> taken(joints.size(), VectorXd::Zero(kLags + 1));
    for (int draw = 0; draw < kDraws; ++draw) {
      RunResiduals noise = simulated(data, joints, random);
      const OfJoints before = lag_products(data, noise);
      fit.take_out_of(noise);
      const OfJoints after = lag_products(data, noise);
      for (std::size_t j = 0; j < joints.size(); ++j) {
        taken[j] += (before[j].covariance() - after[j].covariance()) / kDraws;
      }
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double samples = std::max(1.0, observed[j].samples());
      joints[j] = fit_autoregression(observed[j].covariance() + taken[j], samples);
    }
  }
  return joints;
}

}  // namespace

TorqueNoiseModel torque_noise_model(const EffectRecordings& data, const RunResiduals& residuals,
                                    const std::vector<double>& repeats, bool fitted) {
  TorqueNoiseModel model;
  model.worth.resize(data.joints());
  const OfJoints all = lag_products(data, residuals);
  std::vector<JointDifferences> repeated(all.size());
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    if (!(repeats[run] > 0)) continue;
    for (std::size_t j = 0; j < all.size(); ++j) {
      const auto column = static_cast<Index>(j);
      repeated[j].add(residuals[run].col(column), data.runs[run].rows.counted.col(column),
                      repeats[run]);
    }
  }
  model.from_periods = true;
  // what one joint alone has may be physics that drifts; noise is of all of them
  double lasting = 1;
  for (std::size_t j = 0; j < all.size(); ++j) {
    model.from_periods = model.from_periods && all[j].samples() > 0 &&
                         repeated[j].neighbours.samples() >= kLeastPart * all[j].samples();
    lasting = std::min(lasting, lasting_part(repeated[j].all));
  }
  for (std::size_t j = 0; j < all.size(); ++j) {
    const LagProducts& products = model.from_periods ? repeated[j].neighbours : all[j];
    const double samples = std::max(products.samples(), 1.0);
    VectorXd covariance = products.covariance();
    if (model.from_periods && lasting > kLasting) {
      covariance += lasting_covariance(repeated[j].all, lasting);
    }
    model.joints.push_back(fit_autoregression(covariance, samples));
    if (!(model.joints.back().innovation > 0)) {
      throw std::invalid_argument(
          fmt::format("the model explains the torque of joint {} exactly: there is no noise to "
                      "judge by; expected a recording of a real measurement",
                      j + 1));
    }
  }
  if (!model.from_periods && fitted) {
    model.joints = before_the_fit(data, all, std::move(model.joints));
  }
  for (std::size_t j = 0; j < all.size(); ++j) {
    model.worth[static_cast<Index>(j)] =
        all[j].samples() / std::max(1.0, model.joints[j].correlation_time);
  }
  return model;
}

}  // namespace dyngen::runtime

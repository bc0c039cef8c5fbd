// SPDX-License-Identifier: MIT
#include "runtime/estimation/noise_model.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostOrder = 40;

/// Response of 1 / (1 - sum a_k z^-k) to a pulse, until it is small.
Index response_length(const VectorXd& a) {
  constexpr Index kLongest = 20000;
  constexpr double kSmall = 1e-5;
  VectorXd past = VectorXd::Zero(std::max<Index>(a.size(), 1));
  if (a.size() == 0) return 0;
  past[0] = 1;
  Index quiet = 0;
  for (Index t = 1; t < kLongest; ++t) {
    const double next = a.dot(past.head(a.size()));
    for (Index k = past.size() - 1; k > 0; --k) past[k] = past[k - 1];
    past[0] = next;
    quiet = std::abs(next) < kSmall ? quiet + 1 : 0;
    if (quiet > a.size()) return t;
  }
  return kLongest;
}

/// One joint's rows on their way through the filter; keeps the last outputs between blocks.
class RowFilter {
 public:
  RowFilter(const AutoregressiveNoise& noise, Index columns)
      : a_(noise.coefficients),
        gain_(noise.innovation),
        past_(MatrixXd::Zero(a_.size(), columns)),
        tail_(response_length(a_)) {}

  void reset() { past_.setZero(); }
  [[nodiscard]] Index tail() const { return tail_; }

  /// In place; past_ row k holds the output k + 1 samples ago.
  void run(MatrixXd& rows) {
    const Index order = a_.size();
    rows *= gain_;
    for (Index c = 0; c < rows.cols(); ++c) {
      double* x = rows.col(c).data();
      for (Index t = 0; t < rows.rows(); ++t) {
        double sum = x[t];
        const Index inside = std::min(order, t);
        for (Index k = 0; k < inside; ++k) sum += a_[k] * x[t - 1 - k];
        for (Index k = inside; k < order; ++k) sum += a_[k] * past_(k - t, c);
        x[t] = sum;
      }
    }
    remember(rows);
  }

 private:
  void remember(const MatrixXd& rows) {
    const Index order = a_.size(), count = rows.rows();
    MatrixXd next(order, rows.cols());
    for (Index k = 0; k < order; ++k) {
      if (k < count) {
        next.row(k) = rows.row(count - 1 - k);
      } else {
        next.row(k) = past_.row(k - count);
      }
    }
    past_ = std::move(next);
  }

  VectorXd a_;
  double gain_ = 0;
  MatrixXd past_;
  Index tail_ = 0;
};

/// Triangles of filtered rows, joint by joint.
class FilteredRows {
 public:
  /// @param noise  of each joint: processes that add up
  FilteredRows(const std::vector<std::vector<int>>& columns,
               const std::vector<std::vector<AutoregressiveNoise>>& noise)
      : columns_(columns) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const Index size = static_cast<Index>(columns[j].size());
      filters_.emplace_back();
      for (const AutoregressiveNoise& part : noise[j]) filters_[j].emplace_back(part, size);
      factors_.push_back({MatrixXd::Zero(size, size), 0});
    }
  }

  void add(const RowBlock& block, int parameters) {
    if (!block.continues_run) finish_run();
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      MatrixXd rows(block.Y.rows(), static_cast<Index>(columns_[j].size()));
      for (std::size_t i = 0; i < columns_[j].size(); ++i) {
        rows.col(static_cast<Index>(i)) =
            block.Y.col(static_cast<Index>(j) * parameters + columns_[j][i]);
      }
      for (RowFilter& filter : filters_[j]) absorb_filtered(j, filter, rows);
    }
    running_ = true;
  }

  /// The filters run out: then F'F has all products of samples of the run.
  void finish_run() {
    if (!running_) return;
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      const auto size = static_cast<Index>(columns_[j].size());
      for (RowFilter& filter : filters_[j]) {
        if (filter.tail() > 0) absorb_filtered(j, filter, MatrixXd::Zero(filter.tail(), size));
        filter.reset();
      }
    }
    running_ = false;
  }

  [[nodiscard]] const std::vector<JointFactor>& factors() const { return factors_; }

 private:
  void absorb_filtered(std::size_t joint, RowFilter& filter, MatrixXd rows) {
    filter.run(rows);
    absorb(factors_[joint], rows);
  }

  const std::vector<std::vector<int>>& columns_;
  std::vector<std::vector<RowFilter>> filters_;  // of each joint
  std::vector<JointFactor> factors_;
  bool running_ = false;
};

}  // namespace

AutoregressiveNoise fit_autoregression(const VectorXd& autocovariance, double samples) {
  AutoregressiveNoise best;
  const double variance = autocovariance[0];
  best.deviation = best.innovation = std::sqrt(std::max(variance, 0.0));
  if (!(variance > 0)) return best;
  const Index most = std::min(autocovariance.size() - 1, kMostOrder);
  VectorXd a(0);
  double error = variance;
  double least = samples * std::log(error);
  for (Index p = 1; p <= most; ++p) {
    double reflection = autocovariance[p];
    for (Index k = 0; k < a.size(); ++k) reflection -= a[k] * autocovariance[p - 1 - k];
    reflection /= error;
    if (!(std::abs(reflection) < 1)) break;
    VectorXd next(p);
    for (Index k = 0; k < a.size(); ++k) next[k] = a[k] - reflection * a[a.size() - 1 - k];
    next[p - 1] = reflection;
    a = std::move(next);
    error *= 1 - reflection * reflection;
    const double criterion = samples * std::log(error) + std::log(samples) * static_cast<double>(p);
    if (criterion < least) {
      least = criterion;
      best.coefficients = a;
      best.innovation = std::sqrt(error);
    }
  }
  const double gain = 1 - best.coefficients.sum();
  best.correlation_time = best.innovation * best.innovation / (gain * gain * variance);
  return best;
}

ResidualAutocovariance residual_autocovariance(const RowSource& source, const VectorXd& beta,
                                               Index most_lags) {
  MatrixXd sums, past;  // past: the last residuals of the run
  VectorXd samples;
  source([&](const RowBlock& block) {
    const MatrixXd rest = residual(block, beta);
    if (sums.size() == 0) {
      sums = MatrixXd::Zero(most_lags + 1, rest.cols());
      samples = VectorXd::Zero(rest.cols());
    }
    if (!block.continues_run) past.resize(0, rest.cols());
    MatrixXd joined(past.rows() + rest.rows(), rest.cols());
    joined << past, rest;
    const Index first = past.rows(), last = joined.rows();
    for (Index lag = 0; lag <= most_lags; ++lag) {
      const Index from = std::max(first, lag);
      if (from >= last) continue;
      const Index count = last - from;
      for (Index j = 0; j < rest.cols(); ++j) {
        sums(lag, j) +=
            joined.col(j).segment(from, count).dot(joined.col(j).segment(from - lag, count));
      }
    }
    past = joined.bottomRows(std::min(most_lags, joined.rows()));
    samples += counted_rows(block);
  });
  if (sums.size() > 0) sums *= samples.cwiseMax(1).cwiseInverse().asDiagonal();
  return {sums, samples};
}

NoiseFactor empty_noise(const std::vector<std::vector<int>>& columns) {
  NoiseFactor factor;
  const Index joints = static_cast<Index>(columns.size());
  for (const std::vector<int>& of_joint : columns) {
    const Index size = static_cast<Index>(of_joint.size());
    factor.F.push_back(MatrixXd::Zero(size, size));
  }
  factor.power = factor.correlated_power = VectorXd::Zero(joints);
  return factor;
}

NoiseFactor noise_factor(const RowSource& source, const std::vector<std::vector<int>>& columns,
                         const VectorXd& beta) {
  NoiseFactor factor = empty_noise(columns);
  const auto [covariances, samples] = residual_autocovariance(source, beta, kMostOrder);
  if (covariances.size() == 0) return factor;
  KnownNoise noise;
  noise.correlation_time.resize(covariances.cols());
  for (Index j = 0; j < covariances.cols(); ++j) {
    noise.parts.push_back({fit_autoregression(covariances.col(j), std::max(samples[j], 1.0))});
    noise.correlation_time[j] = noise.parts.back().front().correlation_time;
  }
  factor = noise_factor(source, columns, static_cast<int>(beta.size()), noise);
  // of all that is left, whatever part of it the process has
  factor.power = samples.cwiseProduct(covariances.row(0).transpose());
  factor.correlated_power = factor.power.cwiseProduct(noise.correlation_time);
  return factor;
}

NoiseFactor noise_factor(const RowSource& source, const std::vector<std::vector<int>>& columns,
                         int parameters, const KnownNoise& noise) {
  NoiseFactor factor = empty_noise(columns);
  FilteredRows rows(columns, noise.parts);
  VectorXd samples = VectorXd::Zero(factor.power.size());
  source([&](const RowBlock& block) {
    rows.add(block, parameters);
    samples += counted_rows(block);
  });
  rows.finish_run();
  for (std::size_t j = 0; j < columns.size(); ++j) {
    factor.F[j] = rows.factors()[j].R;
    double variance = 0;
    for (const AutoregressiveNoise& part : noise.parts[j]) {
      variance += part.deviation * part.deviation;
    }
    factor.power[static_cast<Index>(j)] = samples[static_cast<Index>(j)] * variance;
  }
  factor.correlated_power = factor.power.cwiseProduct(noise.correlation_time);
  return factor;
}

void merge(NoiseFactor& factor, const NoiseFactor& other) {
  if (factor.F.size() != other.F.size()) {
    throw std::invalid_argument(
        fmt::format("merge(): noise of {} and of {} joints", factor.F.size(), other.F.size()));
  }
  for (std::size_t j = 0; j < factor.F.size(); ++j) {
    JointFactor joint{factor.F[j], 0};
    MatrixXd rows = other.F[j];
    absorb(joint, rows);
    factor.F[j] = joint.R;
  }
  factor.power += other.power;
  factor.correlated_power += other.correlated_power;
}

}  // namespace dyngen::runtime

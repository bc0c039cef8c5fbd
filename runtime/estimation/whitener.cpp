// SPDX-License-Identifier: MIT
#include "runtime/estimation/whitener.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kSameGap =
    1e-12;  // of the largest entry: a covariance or gain that does not change

/// Covariance of the state: the last m samples of the autoregressive part, the slow parts.
class StateCovariance {
 public:
  StateCovariance(const JointNoise& noise, const VectorXd& coefficients, const VectorXd& poles)
      : a_(coefficients), poles_(poles), innovation_(noise.quick.innovation) {
    const Index m = a_.size(), slow = poles.size();
    P_ = MatrixXd::Zero(m + slow, m + slow);
    const VectorXd lags = autocovariance(noise.quick, m - 1);
    for (Index i = 0; i < m; ++i) {
      for (Index j = 0; j < m; ++j) P_(i, j) = lags[std::abs(i - j)];
    }
    slow_variance_.resize(slow);
    for (Index k = 0; k < slow; ++k) {
      const double deviation = noise.slow[static_cast<std::size_t>(k)].deviation;
      slow_variance_[k] = deviation * deviation;
      P_(m + k, m + k) = slow_variance_[k];
    }
    before_predicted_ = P_;
  }

  /// Variance of what the prediction of a sample misses.
  [[nodiscard]] double missed() const { return seen(P_.row(0)) + seen_slow().sum(); }

  /// @return (m + slow) by which the state changes for what the prediction misses
  VectorXd observe() {
    VectorXd gain(P_.rows());
    for (Index i = 0; i < gain.size(); ++i) gain[i] = seen(P_.row(i));
    const double variance = missed();
    gain /= variance;
    P_.noalias() -= variance * gain * gain.transpose();
    return gain;
  }

  /// One sample on. @return whether that changes nothing
  bool predict() {
    const Index m = a_.size(), slow = poles_.size();
    MatrixXd next(P_.rows(), P_.cols());
    const VectorXd ahead = P_.leftCols(m) * a_;  // of each state with the next sample
    next(0, 0) = a_.dot(ahead.head(m)) + innovation_ * innovation_;
    for (Index i = 1; i < m; ++i) next(i, 0) = next(0, i) = ahead[i - 1];
    next.block(1, 1, m - 1, m - 1) = P_.topLeftCorner(m - 1, m - 1);
    for (Index k = 0; k < slow; ++k) {
      next(m + k, 0) = poles_[k] * ahead[m + k];
      next.row(m + k).segment(1, m - 1) = poles_[k] * P_.row(m + k).head(m - 1);
      for (Index l = 0; l < slow; ++l) {
        next(m + k, m + l) = poles_[k] * poles_[l] * P_(m + k, m + l);
      }
      next(m + k, m + k) += (1 - poles_[k] * poles_[k]) * slow_variance_[k];
    }
    next.topRightCorner(m, slow) = next.bottomLeftCorner(slow, m).transpose();
    const bool same = (next - before_predicted_).cwiseAbs().maxCoeff() <= kSameGap * next(0, 0);
    before_predicted_ = next;
    P_ = std::move(next);
    return same;
  }

 private:
  /// A row's part of the newest sample and of the slow parts.
  template <class Row>
  [[nodiscard]] double seen(const Row& row) const {
    return row[0] + row.tail(poles_.size()).sum();
  }
  [[nodiscard]] VectorXd seen_slow() const {
    VectorXd sums(poles_.size());
    for (Index k = 0; k < sums.size(); ++k) sums[k] = seen(P_.row(a_.size() + k));
    return sums;
  }

  const VectorXd& a_;
  const VectorXd& poles_;
  double innovation_;
  VectorXd slow_variance_;
  MatrixXd P_, before_predicted_;
};

}  // namespace

Whitener::Whitener(const JointNoise& noise, const Eigen::Ref<const VectorXd>& counted)
    : coefficients_(noise.quick.coefficients),
      poles_(static_cast<Index>(noise.slow.size())),
      steps_(static_cast<std::size_t>(counted.size())) {
  if (coefficients_.size() == 0) coefficients_ = VectorXd::Zero(1);
  for (Index k = 0; k < poles_.size(); ++k)
    poles_[k] = noise.slow[static_cast<std::size_t>(k)].pole;
  const Index m = coefficients_.size(), states = m + poles_.size();
  StateCovariance covariance(noise, coefficients_, poles_);
  bool steady = false;
  for (Index t = 0; t < counted.size(); ++t) {
    Step& step = steps_[static_cast<std::size_t>(t)];
    if (counted[t] == 0) {
      steady = false;
      covariance.predict();
      continue;
    }
    if (steady) {
      step = steps_[static_cast<std::size_t>(t) - 1];
      continue;
    }
    step.deviation = std::sqrt(covariance.missed());
    const VectorXd gain = covariance.observe();
    for (Index k = reach_; k < m; ++k) {
      if (std::abs(gain[k]) > kSameGap) reach_ = k + 1;
    }
    step.gain = gains_.size();
    gains_.insert(gains_.end(), gain.data(), gain.data() + states);
    steady = covariance.predict();
  }
}

/// Some columns on their way through the filter, side by side. What one column becomes does not
/// depend on how many there are.
template <int kTogether>
class Whitener::Columns {
 public:
  Columns(const Whitener& whitener, std::vector<double*> columns)
      : whitener_(whitener),
        columns_(std::move(columns)),
        past_(static_cast<std::size_t>(whitener.coefficients_.size()), Lane::Zero()),
        slow_(static_cast<std::size_t>(whitener.poles_.size()), Lane::Zero()) {}

  void run() {
    const Index m = whitener_.coefficients_.size();
    Index newest = 0;  // place of the last sample in past_, a ring
    for (std::size_t t = 0; t < whitener_.steps_.size(); ++t) {
      Lane next = Lane::Zero();
      for (Index k = 0; k < m; ++k) next += whitener_.coefficients_[k] * at(newest, k);
      newest = newest == 0 ? m - 1 : newest - 1;
      past_[static_cast<std::size_t>(newest)] = next;
      for (std::size_t k = 0; k < slow_.size(); ++k) {
        slow_[k] *= whitener_.poles_[static_cast<Index>(k)];
        next += slow_[k];
      }
      step(whitener_.steps_[t], t, newest, next);
    }
  }

 private:
  using Lane = Eigen::Array<double, kTogether, 1>;

  /// A sample `k` before the newest of the ring.
  Lane& at(Index newest, Index k) {
    const Index m = whitener_.coefficients_.size();
    return past_[static_cast<std::size_t>(newest + k < m ? newest + k : newest + k - m)];
  }

  void step(const Step& step, std::size_t t, Index newest, const Lane& predicted) {
    if (step.deviation == 0) {
      for (double* column : columns_) column[t] = 0;
      return;
    }
    Lane missed = Lane::Zero();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto lane = static_cast<Index>(c);
      missed[lane] = columns_[c][t] - predicted[lane];
      columns_[c][t] = missed[lane] / step.deviation;
    }
    const double* gain = whitener_.gains_.data() + step.gain;
    for (Index k = 0; k < whitener_.reach_; ++k) at(newest, k) += gain[k] * missed;
    gain += whitener_.coefficients_.size();
    for (std::size_t k = 0; k < slow_.size(); ++k) slow_[k] += gain[k] * missed;
  }

  const Whitener& whitener_;
  std::vector<double*> columns_;
  std::vector<Lane> past_, slow_;
};

template <int kTogether>
void Whitener::apply_to(const std::vector<double*>& columns) const {
  Columns<kTogether>(*this, columns).run();
}

void Whitener::apply(Eigen::Ref<MatrixXd> columns) const {
  constexpr std::size_t kMost = 32;
  std::vector<double*> together;
  const auto run = [&] {
    // lanes that hold no column cost as much as others: sums of 8 lanes are as many as hide the
    // latency of an addition, so that fewer are no faster
    if (together.size() > 16) {
      apply_to<kMost>(together);
    } else if (together.size() > 8) {
      apply_to<16>(together);
    } else if (!together.empty()) {
      apply_to<8>(together);
    }
    together.clear();
  };
  for (Index c = 0; c < columns.cols(); ++c) {
    if (columns.col(c).isZero(0)) continue;
    together.push_back(columns.col(c).data());
    if (together.size() == kMost) run();
  }
  run();
}

}  // namespace dyngen::runtime

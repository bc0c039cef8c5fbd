// SPDX-License-Identifier: MIT
#include "tests/blind/cases/whitening.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <unsupported/Eigen/FFT>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

using Eigen::MatrixXd;

constexpr double kSmooth = 0.12;   // of a frequency: lines on each side whose mean is its power
constexpr double kLeastLines = 2;  // and so many, of one draw
constexpr std::size_t kDraws = 32;
// of the weight of unknown values, so that those which a stopped band cannot show have one too
constexpr double kLeast = 1e-9;
// unknown values that are solved for directly, without and with a stopped band. More of them are
// found by conjugate gradients, or thinned to what a stopped band can tell apart
constexpr std::size_t kMostSolved = 2000, kMostSolvedOfStopped = 4000;
constexpr double kThinned = 2.5;  // values kept in a period of the first stopped frequency
constexpr double kEnough = 1e-7;
constexpr int kMostRounds = 100;

/// Multiplies the lines of a series by what `factor` gives of the noise's deviation there.
template <class Factor>
VectorXd filtered(const VectorXd& values, const VectorXd& deviation, const Factor& factor) {
  Eigen::FFT<double> fft;
  std::vector<double> time(values.begin(), values.end());
  std::vector<std::complex<double>> lines;
  fft.fwd(lines, time);
  const double n = static_cast<double>(time.size());
  const double last = static_cast<double>(deviation.size() - 1);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double line = std::min(static_cast<double>(k), n - static_cast<double>(k));
    const double place = line / (n / 2) * last;
    const Index low = std::min<Index>(static_cast<Index>(place), deviation.size() - 2);
    const double share = place - static_cast<double>(low);
    const bool stopped = std::isinf(deviation[low + 1]);
    const double here = (1 - share) * deviation[low] + share * deviation[low + 1];
    lines[k] = factor(lines[k], stopped ? std::numeric_limits<double>::infinity() : here);
  }
  fft.inv(time, lines);
  return Eigen::Map<VectorXd>(time.data(), static_cast<Index>(time.size()));
}

using Line = std::complex<double>;

VectorXd whitened(const VectorXd& values, const VectorXd& deviation) {
  return filtered(values, deviation,
                  [](const Line& line, double d) { return std::isinf(d) ? Line(0) : line / d; });
}

/// Error of the equations: of the torque, and of the acceleration that positions give.
MatrixXd equation_error(const Recording& recording) {
  const MatrixXd& n = recording.encoder_error;
  MatrixXd error = recording.torque_noise;
  const double square = recording.log.rate * recording.log.rate;
  for (Index k = 1; k + 1 < n.rows(); ++k) {
    const VectorXd ddn = (n.row(k + 1) - 2 * n.row(k) + n.row(k - 1)).transpose() * square;
    error.row(k) -= (recording.log.M[at(k)] * ddn).transpose();
  }
  return error;
}

/// Lines of a spectrum as another length of the series has them, on the same range of frequencies.
MatrixXd stretched(const MatrixXd& power, Index lines) {
  MatrixXd result(lines, power.cols());
  for (Index k = 0; k < lines; ++k) {
    const double place = static_cast<double>(k) * static_cast<double>(power.rows() - 1) /
                         static_cast<double>(lines - 1);
    const Index low = std::min<Index>(static_cast<Index>(place), power.rows() - 2);
    const double share = place - static_cast<double>(low);
    result.row(k) = (1 - share) * power.row(low) + share * power.row(low + 1);
  }
  return result;
}

/// Every so many of the samples, and all near the ends of each run of them.
std::vector<Index> thinned(const std::vector<Index>& rests, Index stride) {
  std::vector<Index> some;
  std::size_t first = 0;
  for (std::size_t end = 1; end <= rests.size(); ++end) {
    if (end < rests.size() && rests[end] == rests[end - 1] + 1) continue;
    for (std::size_t i = first; i < end; ++i) {
      const auto from = static_cast<Index>(i - first), to = static_cast<Index>(end - 1 - i);
      if (from < stride || to < stride || from % stride == 0) some.push_back(rests[i]);
    }
    first = end;
  }
  return some;
}

}  // namespace

MatrixXd known_torque(const Recording& recording) {
  MatrixXd torque = recording.log.recorded;
  for (const MatrixXd* beside : {&recording.disturbance, &recording.compensation}) {
    if (beside->size() > 0) torque += *beside;
  }
  return torque;
}

std::vector<std::vector<Index>> rests_of(const Log& log, double reach) {
  const Index samples = log.q.rows(), around = std::lround(reach * log.rate);
  std::vector<std::vector<Index>> rests(at(log.q.cols()));
  for (Index j = 0; j < log.q.cols(); ++j) {
    Index next = 0;  // the first sample that is not among them
    for (Index k = 0; k < samples; ++k) {
      const bool turns = around > 0 && k > 0 && log.sign(k, j) * log.sign(k - 1, j) <= -1;
      if (std::abs(log.sign(k, j)) >= 1 && !turns) continue;
      const Index to = std::min(samples, k + around + 1);
      for (next = std::max(next, k - around); next < to; ++next) rests[at(j)].push_back(next);
    }
  }
  return rests;
}

void leave_out_rest(const Log& log, Eigen::Ref<MatrixXd> rows) {
  const auto rests = rests_of(log);
  for (Index j = 0; j < log.q.cols(); ++j) {
    for (const Index k : rests[at(j)]) rows.row(j * log.q.rows() + k).setZero();
  }
}

/// Power of its noise's lines, behind Hann's window, on top of what is there.
void Whitener::add(const Recording& recording, MatrixXd& power) {
  const MatrixXd error = equation_error(recording);
  const Index samples = error.rows();
  if (samples / 2 + 1 != power.rows()) {
    MatrixXd own = MatrixXd::Zero(samples / 2 + 1, power.cols());
    add(recording, own);
    power += stretched(own, power.rows());
    return;
  }
  VectorXd window(samples);
  for (Index k = 0; k < samples; ++k) {
    const double turn = 2 * kPi * static_cast<double>(k) / static_cast<double>(samples);
    window[k] = 0.5 - 0.5 * std::cos(turn);
  }
  Eigen::FFT<double> fft;
  for (Index j = 0; j < error.cols(); ++j) {
    const VectorXd part = error.col(j).cwiseProduct(window);
    std::vector<double> time(part.begin(), part.end());
    std::vector<std::complex<double>> lines;
    fft.fwd(lines, time);
    for (Index k = 0; k < power.rows(); ++k) {
      power(k, j) += std::norm(lines[at(k)]) / window.squaredNorm();
    }
  }
}

Whitener::Whitener(const std::vector<Recording>& training, const DrawNoise& draw) {
  Index longest = 0;
  for (const Recording& each : training) longest = std::max(longest, each.log.q.rows());
  MatrixXd power = MatrixXd::Zero(longest / 2 + 1, training.front().log.q.cols());
  const std::size_t draws = draw ? kDraws : 1;
  for (std::size_t place = 0; place < training.size(); ++place) {
    if (!draw) {
      add(training[place], power);
      continue;
    }
    Recording other = training[place];
    for (std::size_t i = 0; i < draws; ++i) {
      draw(place, i, other);
      add(other, power);
    }
  }
  power /= static_cast<double>(training.size() * draws);
  // the mean over lines near in their logarithm: what is slow has few of them
  const double least = draw ? 0 : kLeastLines;
  MatrixXd sum = MatrixXd::Zero(power.rows() + 1, power.cols());
  for (Index k = 0; k < power.rows(); ++k) sum.row(k + 1) = sum.row(k) + power.row(k);
  deviation_.resize(power.rows(), power.cols());
  for (Index k = 0; k < power.rows(); ++k) {
    const auto reach = static_cast<Index>(least + kSmooth * static_cast<double>(k));
    const Index from = std::max<Index>(0, k - reach);
    const Index to = std::min<Index>(power.rows(), k + reach + 1);
    deviation_.row(k) =
        ((sum.row(to) - sum.row(from)) / static_cast<double>(to - from)).cwiseSqrt();
  }
}

VectorXd Whitener::column(Index joint, const VectorXd& values) const {
  return whitened(values, deviation_.col(joint));
}

VectorXd Whitener::coloured_twice(Index joint, const VectorXd& values, double least) const {
  return filtered(values, deviation_.col(joint), [&](const Line& line, double d) {
    return line / ((std::isinf(d) ? 0 : 1 / (d * d)) + least);
  });
}

void Whitener::stop_above(double hz, double rate) {
  const auto last = static_cast<double>(deviation_.rows() - 1);
  const auto first = static_cast<Index>(std::ceil(hz / (rate / 2) * last));
  if (first >= deviation_.rows()) return;
  stopped_ = hz;
  deviation_.bottomRows(deviation_.rows() - first)
      .setConstant(std::numeric_limits<double>::infinity());
}

RestWhitener::RestWhitener(const Whitener& whitener, const Log& log, double reach,
                           std::size_t most_solved)
    : whitener_(whitener),
      samples_(log.q.rows()),
      rests_(rests_of(log, reach)),
      solved_(rests_),
      weight_(rests_.size()),
      least_(rests_.size()),
      most_solved_(most_solved) {
  const bool stops = whitener.stopped() > 0;
  if (most_solved == 0) most_solved_ = stops ? kMostSolvedOfStopped : kMostSolved;
  for (Index j = 0; j < log.q.cols(); ++j) {
    std::vector<Index>& rests = solved_[at(j)];
    if (rests.empty()) continue;
    const bool many = rests.size() > most_solved_;
    if (many && stops) {
      const auto stride = static_cast<Index>(log.rate / (kThinned * whitener.stopped()));
      rests = thinned(rests, std::max<Index>(1, stride));
    }
    // what two of them share depends on how far apart they are
    const VectorXd shared = whitener.column(j, whitener.column(j, VectorXd::Unit(samples_, 0)));
    least_[at(j)] = kLeast * shared[0];
    if (many && !stops) continue;
    const auto count = static_cast<Index>(rests.size());
    MatrixXd weight(count, count);
    for (Index a = 0; a < count; ++a) {
      for (Index b = 0; b <= a; ++b) weight(a, b) = shared[rests[at(a)] - rests[at(b)]];
    }
    weight.diagonal().array() += least_[at(j)];
    weight_[at(j)].compute(weight);
  }
}

VectorXd RestWhitener::unknown(Index joint, const VectorXd& shown) const {
  const std::vector<Index>& rests = solved_[at(joint)];
  if (weight_[at(joint)].rows() > 0) return weight_[at(joint)].solve(shown);
  const auto spread = [&](const VectorXd& x) {
    VectorXd all = VectorXd::Zero(samples_);
    all(rests) = x;
    return all;
  };
  // conjugate gradients; the noise's covariance is nearly the inverse of the weight
  const auto weigh = [&](const VectorXd& x) {
    const VectorXd twice = whitener_.column(joint, whitener_.column(joint, spread(x)));
    return VectorXd(twice(rests) + least_[at(joint)] * x);
  };
  const auto prepare = [&](const VectorXd& x) {
    return VectorXd(whitener_.coloured_twice(joint, spread(x), least_[at(joint)])(rests));
  };
  VectorXd x = VectorXd::Zero(shown.size()), left = shown, step = prepare(left), way = step;
  double size = left.dot(step);
  const double enough = kEnough * kEnough * std::abs(size);
  for (int round = 0; round < kMostRounds && std::abs(size) > enough; ++round) {
    const VectorXd weighed = weigh(way);
    const double length = size / way.dot(weighed);
    x += length * way;
    left -= length * weighed;
    step = prepare(left);
    const double next = left.dot(step);
    way = step + next / size * way;
    size = next;
  }
  return x;
}

MatrixXd RestWhitener::operator()(const MatrixXd& rows) const {
  const Index joints = whitener_.joints(), samples = rows.rows() / joints;
  MatrixXd result = MatrixXd::Zero(rows.rows(), rows.cols());
  for (Index c = 0; c < rows.cols(); ++c) {
    for (Index j = 0; j < joints; ++j) {
      const std::vector<Index>& rests = rests_[at(j)];
      VectorXd part = rows.col(c).segment(j * samples, samples);
      part(rests).setZero();
      if (part.isZero(0)) continue;
      VectorXd white = whitener_.column(j, part);
      if (!rests.empty()) {
        const std::vector<Index>& solved = solved_[at(j)];
        const VectorXd shown = whitener_.column(j, white)(solved);
        const VectorXd there = unknown(j, shown);
        VectorXd held = VectorXd::Zero(samples);
        held(solved) = there;
        white -= whitener_.column(j, held);
      }
      result.col(c).segment(j * samples, samples) = white;
    }
  }
  return result;
}

}  // namespace blind

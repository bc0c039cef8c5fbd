// SPDX-License-Identifier: MIT
#include "tests/blind/cases/instants.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

using Eigen::MatrixXd;

constexpr double kReach = 16;      // samples of a band-limited impulse, to each side
constexpr double kOwnPart = 1e-3;  // of an impulse that others do not make up

/// An impulse between samples, as what is not faster than half of the rate shows it.
VectorXd impulse(Index samples, double at) {
  VectorXd values = VectorXd::Zero(samples);
  const Index first = std::max<Index>(0, static_cast<Index>(std::ceil(at - kReach)));
  const Index last = std::min(samples - 1, static_cast<Index>(std::floor(at + kReach)));
  for (Index k = first; k <= last; ++k) {
    const double x = kPi * (static_cast<double>(k) - at);
    const double window = 0.5 * (1 + std::cos(x / kReach));
    values[k] = window * (std::abs(x) < 1e-9 ? 1 : std::sin(x) / x);
  }
  return values;
}

/// Where the velocity is 0, between two samples. @param moving  the one at which it is not
double zero_between(const Log& log, Index joint, Index before, Index moving) {
  const double rate = log.ddq(moving, joint) / log.rate;
  const double at = static_cast<double>(moving) - (rate == 0 ? 0 : log.dq(moving, joint) / rate);
  return std::clamp(at, static_cast<double>(before), static_cast<double>(before + 1));
}

}  // namespace

std::vector<double> instants_of(const Log& log, Index joint) {
  std::vector<double> instants;
  for (Index k = 0; k < log.q.rows(); ++k) {
    const bool rests = std::abs(log.sign(k, joint)) < 1;
    if (k > 0) {
      const bool rested = std::abs(log.sign(k - 1, joint)) < 1;
      const bool turns = log.sign(k, joint) * log.sign(k - 1, joint) <= -1;
      if (rests && !rested) instants.push_back(zero_between(log, joint, k - 1, k - 1));
      if (!rests && rested) instants.push_back(zero_between(log, joint, k - 1, k));
      if (turns) {
        const double from = log.dq(k - 1, joint), to = log.dq(k, joint);
        const double share = from == to ? 0.5 : std::clamp(from / (from - to), 0.0, 1.0);
        instants.push_back(static_cast<double>(k - 1) + share);
      }
    }
    if (rests) instants.push_back(static_cast<double>(k));
  }
  return instants;
}

InstantWhitener::InstantWhitener(const Whitener& whitener, const Log& log) : whitener_(whitener) {
  const Index samples = log.q.rows();
  for (Index j = 0; j < log.q.cols(); ++j) {
    const std::vector<double> instants = instants_of(log, j);
    const auto count = static_cast<Index>(instants.size());
    MatrixXd columns(samples, count);
    for (Index i = 0; i < count; ++i) {
      columns.col(i) = whitener.column(j, impulse(samples, instants[at(i)]));
    }
    if (count == 0) {
      impulses_.push_back(columns);
      continue;
    }
    Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
    qr.setThreshold(kOwnPart);
    impulses_.emplace_back(qr.householderQ() * MatrixXd::Identity(samples, qr.rank()));
  }
}

MatrixXd InstantWhitener::operator()(const MatrixXd& rows) const {
  const Index joints = whitener_.joints(), samples = rows.rows() / joints;
  MatrixXd result(rows.rows(), rows.cols());
  for (Index c = 0; c < rows.cols(); ++c) {
    for (Index j = 0; j < joints; ++j) {
      VectorXd white = whitener_.column(j, rows.col(c).segment(j * samples, samples));
      const MatrixXd& impulses = impulses_[at(j)];
      white -= impulses * (impulses.transpose() * white);
      result.col(c).segment(j * samples, samples) = white;
    }
  }
  return result;
}

}  // namespace blind

// SPDX-License-Identifier: MIT
#include "runtime/ripple/rivals.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "runtime/estimation/distributions.h"
#include "runtime/signals/fourier.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns of one direction behind the filter, where its samples count.
template <typename Wave>
MatrixXd side_columns(const WhiteResidual& white, const VectorXd& seen, const Wave& wave) {
  const RippleData& data = white.data();
  std::vector<VectorXd> columns;
  for (const double direction : {1.0, -1.0}) {
    const VectorXd own =
        (white.direction().array() == direction).select(seen, VectorXd::Zero(seen.size()));
    if (own.sum() == 0) continue;
    for (const int part : {0, 1}) {
      const VectorXd signal = VectorXd::NullaryExpr(
          data.q.size(), [&](Index k) { return data.dq[k] * direction > 0 ? wave(k, part) : 0.0; });
      columns.push_back(white.filtered(signal).cwiseProduct(own));
    }
  }
  MatrixXd all(data.q.size(), static_cast<Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) all.col(static_cast<Index>(i)) = columns[i];
  return all;
}

/// A piece of the samples in which a line has a phase of its own.
struct LinePiece {
  Index from = 0, to = 0;
};

/// A line of fixed frequency in a white residual.
struct FixedLine {
  double frequency = 0;  ///< periods per sample
  double power = 0;      ///< sum of its power in all pieces
  double tests = 1;      ///< independent frequencies that were tried, twice
};

FixedLine strongest_fixed(const VectorXd& e, const VectorXd& seen,
                          const std::vector<LinePiece>& pieces, double from, double to) {
  Index longest = 1;
  for (const LinePiece& piece : pieces) longest = std::max(longest, piece.to - piece.from);
  constexpr Index kFiner = 8;  // frequencies per resolution: 1.3 % of the power is lost between
  std::size_t size = 1;
  while (static_cast<Index>(size) < kFiner * longest) size *= 2;
  const auto first = static_cast<std::size_t>(from * static_cast<double>(size));
  const auto last =
      std::min(size / 2, 1 + static_cast<std::size_t>(to * static_cast<double>(size)));
  VectorXd power = VectorXd::Zero(static_cast<Index>(last - first) + 1);
  for (const LinePiece& piece : pieces) {
    const double count = seen.segment(piece.from, piece.to - piece.from).sum();
    if (count == 0) continue;
    std::vector<std::complex<double>> signal(size, 0);
    for (Index k = piece.from; k < piece.to; ++k) {
      signal[static_cast<std::size_t>(k - piece.from)] = e[k] * seen[k];
    }
    const auto transform = fourier(signal);
    for (Index i = 0; i < power.size(); ++i) {
      power[i] += std::norm(transform[first + static_cast<std::size_t>(i)]) / count;
    }
  }
  FixedLine line;
  Index place = 0;
  line.power = power.maxCoeff(&place);
  line.frequency =
      static_cast<double>(first + static_cast<std::size_t>(place)) / static_cast<double>(size);
  line.tests = 1 + 2 * (to - from) * static_cast<double>(longest);
  return line;
}

/// Without a line that has its own phase in each piece.
VectorXd without_fixed(const VectorXd& e, const VectorXd& seen,
                       const std::vector<LinePiece>& pieces, double frequency) {
  VectorXd left = e;
  for (const LinePiece& piece : pieces) {
    const Index count = piece.to - piece.from;
    MatrixXd D(count, 2);
    for (Index k = 0; k < count; ++k) {
      const double angle = kOrderTurn * frequency * static_cast<double>(k);
      D(k, 0) = seen[piece.from + k] * std::cos(angle);
      D(k, 1) = seen[piece.from + k] * std::sin(angle);
    }
    left.segment(piece.from, count) = left_beside(D, e.segment(piece.from, count));
  }
  return left;
}

/// Frequencies at which an order was seen: quantiles, periods per sample.
std::pair<double, double> frequencies_of(const WhiteResidual& white, const VectorXd& seen,
                                         double order, double part) {
  const RippleData& data = white.data();
  std::vector<double> speeds;
  for (Index k = 0; k < seen.size(); ++k) {
    if (seen[k] != 0) speeds.push_back(std::abs(data.dq[k]));
  }
  if (speeds.empty()) return {0, 0};
  std::sort(speeds.begin(), speeds.end());
  const double last = static_cast<double>(speeds.size() - 1);
  const double scale = order * data.sample_time / kOrderTurn;
  return {scale * speeds[static_cast<std::size_t>(part * last)],
          scale * speeds[static_cast<std::size_t>((1 - part) * last)]};
}

/// Whether an order stands in what a rival leaves.
bool stands_beside(const WhiteResidual& white, const VectorXd& left, double order,
                   const OrderTest& test, double power, const RippleRules& rules) {
  const OrderSums sums = order_sums(white, left, order, rules.most_per_sample);
  const double own = test.separate ? sums.separate() : sums.common();
  return order_test(sums, test.level, test.degrees).log_tail <= std::log(rules.beside) &&
         own >= rules.least_share * power;
}

std::optional<OrderRival> fixed_rival(const WhiteResidual& white, const VectorXd& e, double order,
                                      const OrderTest& test, double power,
                                      const RippleRules& rules) {
  const RippleData& data = white.data();
  const VectorXd seen = white.seen(order, rules.most_per_sample);
  constexpr double kEdge = 0.01;
  const auto [from, to] = frequencies_of(white, seen, order, kEdge);
  std::vector<LinePiece> runs, ways;
  for (std::size_t i = 0; i < data.run_starts.size(); ++i) {
    runs.push_back({data.run_starts[i], end_of_run(data, i)});
  }
  for (const OneWay& way : white.stretches()) ways.push_back({way.from, way.to});
  const VectorXd beside = left_beside(wave_columns(white, order, rules.most_per_sample).columns, e);
  for (const std::vector<LinePiece>* pieces : {&runs, &ways}) {
    const FixedLine line = strongest_fixed(e, seen, *pieces, from, to);
    VectorXd left = without_fixed(e, seen, *pieces, line.frequency);
    if (stands_beside(white, left, order, test, power, rules)) continue;
    // phases of many pieces explain anything: the order, which has one phase, must leave some of it
    constexpr std::size_t kFew = 2;
    if (pieces->size() > kFew) {
      const FixedLine more = strongest_fixed(beside, seen, *pieces, from, to);
      const double degrees = 2 * static_cast<double>(pieces->size());
      const double chance = more.tests * chi_square_tail(2 * more.power / test.level, degrees);
      if (chance > rules.beside) continue;
    }
    return OrderRival{RippleKind::kFrequency, line.frequency / data.sample_time, std::move(left)};
  }
  return std::nullopt;
}

/// The speed at which most samples are, and which part of them: an order above Nyquist looks like
/// another one at a single speed alone.
struct UsualSpeed {
  double speed = 0, part = 0;
};
UsualSpeed most_usual_speed(const WhiteResidual& white, const VectorXd& seen) {
  constexpr double kWidth = 1.01;  // half a period in a hundred samples at Nyquist
  std::vector<double> speeds;
  for (Index k = 0; k < seen.size(); ++k) {
    if (seen[k] != 0) speeds.push_back(std::abs(white.data().dq[k]));
  }
  std::sort(speeds.begin(), speeds.end());
  UsualSpeed usual;
  for (std::size_t i = 0, end = 0; i < speeds.size(); ++i) {
    while (end < speeds.size() && speeds[end] <= kWidth * speeds[i]) ++end;
    const double part = static_cast<double>(end - i) / static_cast<double>(speeds.size());
    if (part > usual.part) usual = {speeds[i + (end - i) / 2], part};
  }
  return usual;
}

std::optional<OrderRival> image_rival(const WhiteResidual& white, const VectorXd& e, double order,
                                      const OrderTest& test, double power,
                                      const RippleRules& rules) {
  const VectorXd seen = white.seen(order, rules.most_per_sample);
  const UsualSpeed usual = most_usual_speed(white, seen);
  if (usual.part < rules.least_share) return std::nullopt;
  const OrderReach reach = order_reach(white, rules);
  const double sampling = kOrderTurn / (usual.speed * white.data().sample_time);  // orders
  constexpr double kEverySample = 1e9;  // periods per sample
  for (const double centre : {sampling - order, sampling + order, 2 * sampling - order}) {
    if (!(centre > 0) || centre > rules.most_order) continue;
    constexpr int kSteps = 16;
    double best = 0, image = centre;
    for (int i = -kSteps; i <= kSteps; ++i) {
      const double at = centre + i * reach.resolution / 4;
      const OrderSums sums = order_sums(white, e, at, kEverySample);
      if (sums.separate() > best) {
        best = sums.separate();
        image = at;
      }
    }
    VectorXd left = left_beside(wave_columns(white, image, kEverySample).columns, e);
    if (stands_beside(white, left, order, test, power, rules)) continue;
    return OrderRival{RippleKind::kImage, image, std::move(left)};
  }
  return std::nullopt;
}

}  // namespace

WaveColumns wave_columns(const WhiteResidual& white, double order, double most) {
  const VectorXd seen = white.seen(order, most);
  const VectorXd& q = white.data().q;
  WaveColumns waves;
  waves.forward = (seen.array() * white.direction().array() > 0).any();
  waves.backward = (seen.array() * white.direction().array() < 0).any();
  waves.columns = side_columns(white, seen, [&](Index k, int part) {
    return part == 0 ? std::cos(order * q[k]) : std::sin(order * q[k]);
  });
  return waves;
}

MatrixXd position_columns(const WhiteResidual& white, double order, double most) {
  const RippleData& data = white.data();
  return side_columns(white, white.seen(order, most), [&](Index k, int part) {
    const double c = std::cos(order * data.q[k]), s = std::sin(order * data.q[k]);
    const double square = order * order * data.dq[k] * data.dq[k], turn = order * data.ddq[k];
    return part == 0 ? -(square * c + turn * s) : -(square * s - turn * c);
  });
}

VectorXd left_beside(const MatrixXd& columns, const VectorXd& e) {
  if (columns.cols() == 0) return e;
  const MatrixXd products = columns.transpose() * columns;
  return e - columns * products.completeOrthogonalDecomposition().solve(columns.transpose() * e);
}

std::optional<OrderRival> rival_of(const WhiteResidual& white, const VectorXd& e, double order,
                                   const OrderTest& test, const RippleRules& rules) {
  const OrderSums sums = order_sums(white, e, order, rules.most_per_sample);
  const double power = test.separate ? sums.separate() : sums.common();
  if (auto rival = fixed_rival(white, e, order, test, power, rules)) return rival;
  return image_rival(white, e, order, test, power, rules);
}

PositionTest position_test(const WhiteResidual& white, const VectorXd& e, double order,
                           const OrderTest& test, const RippleRules& rules) {
  const MatrixXd torque = wave_columns(white, order, rules.most_per_sample).columns;
  MatrixXd position = position_columns(white, order, rules.most_per_sample);
  if (position.norm() > 0) position *= torque.norm() / position.norm();  // of one size
  MatrixXd both(torque.rows(), torque.cols() + position.cols());
  both << torque, position;
  const double whole = left_beside(both, e).squaredNorm();
  const double degrees = static_cast<double>(torque.cols());
  const auto chance = [&](const MatrixXd& alone) {
    const double gain = left_beside(alone, e).squaredNorm() - whole;
    return variance_ratio_tail(std::max(0.0, gain) / degrees / test.level, degrees, test.degrees);
  };
  return {chance(position), chance(torque)};
}

}  // namespace dyngen::runtime

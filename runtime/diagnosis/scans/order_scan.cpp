// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/order_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "runtime/diagnosis/scans/turning.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kMostOrders = 1000;  // orders
constexpr std::size_t kPeaks = 2;

struct Extent {
  double lowest = 0, highest = 0;  // position
  double speed = 0;                // that half of the samples exceed
};

Extent extent_of(const EffectRecordings& data, int joint) {
  Extent extent;
  extent.lowest = extent.highest = data.runs.front().motion.q(0, joint);
  std::vector<double> speeds;
  for (const EffectRun& run : data.runs) {
    const auto q = run.motion.q.col(joint);
    extent.lowest = std::min(extent.lowest, q.minCoeff());
    extent.highest = std::max(extent.highest, q.maxCoeff());
    for (const double v : run.motion.dq.col(joint)) speeds.push_back(std::abs(v));
  }
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), place, speeds.end());
  extent.speed = *place;
  return extent;
}

/// Orders at which the chi-square reduction has its largest peaks.
std::vector<double> peaks_of(const std::vector<double>& squares, double first, double step) {
  std::vector<std::pair<double, double>> found;  // chi-square reduction, order
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const bool peak = (i == 0 || squares[i] >= squares[i - 1]) &&
                      (i + 1 == squares.size() || squares[i] > squares[i + 1]);
    if (peak) found.emplace_back(squares[i], first + static_cast<double>(i) * step);
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<double> orders;
  for (const auto& [value, order] : found) {
    if (orders.size() < kPeaks) orders.push_back(order);
  }
  return orders;
}

}  // namespace

OrderScan scan_orders(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                      bool surrogates) {
  OrderScan scan;
  scan.surrogates = VectorXd::Zero(surrogates ? system.surrogates() : 0);
  const Extent extent = extent_of(data, joint);
  const double range = extent.highest - extent.lowest;
  if (!(range > 0) || !(extent.speed > 0)) return scan;
  const double rate = std::numbers::pi / data.row_time;  // rad/s
  const double step = 0.5 * std::numbers::pi / range;
  const double first = std::max(1.0, 4 * std::numbers::pi / range);
  scan.highest = std::min(kMostOrders, rate / extent.speed);
  std::vector<Turning> runs;
  std::vector<VectorXd> squared_speeds;
  for (const EffectRun& run : data.runs) {
    squared_speeds.push_back(run.motion.dq.col(joint).cwiseAbs2());
    // about the middle, where the phase of neighbouring orders is the same
    const double middle = 0.5 * (extent.lowest + extent.highest);
    runs.emplace_back(run.motion.q.col(joint).array() - middle, first, step);
  }
  std::vector<double> squares, error_squares;
  constexpr Index kBatch = 24;  // orders that are looked at together
  for (double n = first; n <= scan.highest;) {
    MatrixXd part(data.equations(), 4 * kBatch);
    Index batch = 0;
    for (; batch < kBatch && n <= scan.highest; ++batch, n += step) {
      Index start = 0;
      for (std::size_t run = 0; run < runs.size(); ++run) {
        const RowBlock& rows = data.runs[run].rows;
        MatrixXd both(squared_speeds[run].size(), 4);
        both.col(0) = runs[run].cosine();
        both.col(1) = runs[run].sine();
        both.rightCols(2) = squared_speeds[run].asDiagonal() * both.leftCols(2);
        part.block(start, 4 * batch, rows.Y.rows(), 4) =
            rows.counted.col(joint).asDiagonal() * decimate(data.runs[run].decimator, both);
        start += rows.Y.rows();
        runs[run].next();
      }
    }
    part.conservativeResize(Eigen::NoChange, 4 * batch);
    JointColumns columns = columns_of_joint(joint, std::move(part));
    bool error = false;  // torque and that of an error by turns
    for (const Products& products :
         system.products_of_groups(system.whitened(std::move(columns)), 2, surrogates)) {
      const Score score = score_of(products, surrogates);
      if (surrogates) scan.surrogates = scan.surrogates.cwiseMax(score.surrogates);
      (error ? error_squares : squares).push_back(score.delta_chi2);
      error = !error;
    }
  }
  scan.peaks = peaks_of(squares, first, step);
  scan.error_peaks = peaks_of(error_squares, first, step);
  return scan;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/evidence/period_differences.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/evidence/lag_products.h"
#include "runtime/signals/interpolation.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t kFewestRuns = 3;  // that can have a course in common
constexpr Index kHalfWaves = 4;         // of the longest run
constexpr double kShared = 14;          // F of 4 and 8 degrees: one joint in a thousand by chance

}  // namespace

void PeriodDifferences::add(const VectorXd& e, const VectorXd& counted, double period) {
  const auto whole = static_cast<Index>(std::llround(period));
  const Index rows = e.size() - whole;
  if (whole < 1 || 2 * static_cast<double>(rows) < period) return;
  const VectorXd moved = shifted(e, static_cast<double>(whole) - period);
  const VectorXd both = counted.tail(rows).cwiseProduct(counted.head(rows));
  runs_.push_back(
      {(e.tail(rows) - moved.head(rows)).cwiseProduct(both) / std::sqrt(2.0), both, period});
}

double PeriodDifferences::samples() const {
  double sum = 0;
  for (const Run& run : runs_) sum += run.counted.sum();
  return sum;
}

/// Samples of the longest run.
double PeriodDifferences::longest() const {
  double longest = 0;
  for (const Run& run : runs_) {
    longest = std::max(longest, static_cast<double>(run.difference.size()) + run.period);
  }
  return longest;
}

/// (samples x kHalfWaves) differences of cosines of the time since the run began.
MatrixXd PeriodDifferences::courses(const Run& run) const {
  MatrixXd columns(run.difference.size(), kHalfWaves);
  const double turn = M_PI / longest();
  for (Index k = 0; k < columns.cols(); ++k) {
    const double rate = turn * static_cast<double>(k + 1);
    for (Index t = 0; t < columns.rows(); ++t) {
      const auto before = static_cast<double>(t);
      columns(t, k) = run.counted[t] *
                      (std::cos(rate * (before + run.period)) - std::cos(rate * before)) /
                      std::sqrt(2.0);
    }
  }
  return columns;
}

PeriodDifferences::Common PeriodDifferences::common() const {
  Common common;
  if (runs_.size() < kFewestRuns) return common;
  std::vector<MatrixXd> products;
  std::vector<VectorXd> own;  // sizes of each run
  MatrixXd all = MatrixXd::Zero(kHalfWaves, kHalfWaves);
  VectorXd rest = VectorXd::Zero(kHalfWaves);
  for (const Run& run : runs_) {
    common.columns.push_back(courses(run));
    const MatrixXd& columns = common.columns.back();
    products.emplace_back(columns.transpose() * columns);
    const VectorXd part = columns.transpose() * run.difference;
    own.emplace_back(products.back().completeOrthogonalDecomposition().solve(part));
    all += products.back();
    rest += part;
  }
  common.sizes = all.completeOrthogonalDecomposition().solve(rest);
  double apart = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    apart += (own[r] - common.sizes).dot(products[r] * (own[r] - common.sizes));
  }
  const double shared = common.sizes.dot(all * common.sizes);
  if (apart > 0) common.ratio = shared * static_cast<double>(runs_.size() - 1) / apart;
  return common;
}

double PeriodDifferences::shared() const { return common().ratio; }

JointDifferences PeriodDifferences::of_joint() {
  const double length = longest();
  const Common all = common();
  const bool shared = all.ratio > kShared;
  for (std::size_t r = 0; shared && r < runs_.size(); ++r) {
    runs_[r].difference -= all.columns[r] * all.sizes;
  }
  LagProducts products;
  for (const Run& run : runs_) products.add(run.difference, run.counted);
  JointDifferences joint;
  joint.samples = std::max(products.samples(), 1.0);
  joint.covariance = products.covariance();
  joint.process = fit_autoregression(joint.covariance, joint.samples);
  if (!(joint.process.innovation > 0)) return joint;
  for (const Run& run : runs_) {
    for (DifferenceLine line :
         difference_lines(run.difference, run.counted, run.period, joint.process)) {
      const auto count = static_cast<double>(runs_.size());
      if (shared && line.frequency * length < 0.5 * static_cast<double>(kHalfWaves)) {
        line.power *= count / (count - 1);
      }
      joint.lines.push_back(line);
    }
  }
  return joint;
}

}  // namespace dyngen::runtime

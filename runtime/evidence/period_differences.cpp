// SPDX-License-Identifier: MIT
#include "runtime/evidence/period_differences.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/evidence/lag_products.h"
#include "runtime/signals/interpolation.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kHalfWaves = 4;  // of the longest run

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

void PeriodDifferences::add_between(const Residual& earlier, const Residual& later, double lag) {
  const auto whole = static_cast<Index>(std::llround(lag));
  const Index from = std::max<Index>(0, -whole);
  const Index rows = std::min(later.e.size(), earlier.e.size() - whole) - from;
  if (rows < 1) return;
  const VectorXd moved = shifted(earlier.e, lag - static_cast<double>(whole));
  const VectorXd both =
      later.counted.segment(from, rows).cwiseProduct(earlier.counted.segment(from + whole, rows));
  runs_.push_back(
      {(later.e.segment(from, rows) - moved.segment(from + whole, rows)).cwiseProduct(both) /
           std::sqrt(2.0),
       both, std::numeric_limits<double>::infinity()});
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
    const double apart = std::isfinite(run.period) ? run.period : 0;
    longest = std::max(longest, static_cast<double>(run.difference.size()) + apart);
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

JointDifferences PeriodDifferences::of_joint() const { return of_runs(runs_, 1); }

/// @param restored  factor of the power of lines that the common course has been taken out of
JointDifferences PeriodDifferences::of_runs(const std::vector<Run>& runs, double restored) const {
  LagProducts products;
  for (const Run& run : runs) products.add(run.difference, run.counted);
  JointDifferences joint;
  joint.samples = std::max(products.samples(), 1.0);
  joint.covariance = products.covariance();
  joint.process = fit_autoregression(joint.covariance, joint.samples);
  if (!(joint.process.innovation > 0)) return joint;
  const double highest = 0.5 * static_cast<double>(kHalfWaves) / longest();
  for (const Run& run : runs) {
    for (DifferenceLine line :
         difference_lines(run.difference, run.counted, run.period, joint.process, rules_)) {
      if (line.frequency < highest) line.power *= restored;
      joint.lines.push_back(line);
    }
  }
  return joint;
}

std::optional<CommonCourse> PeriodDifferences::common_course() const {
  if (static_cast<double>(runs_.size()) < rules_.course_runs) return std::nullopt;
  // a course that all recordings have is in none of their differences
  for (const Run& run : runs_) {
    if (!std::isfinite(run.period)) return std::nullopt;
  }
  Index rows = 0;
  double periods = 0;
  for (const Run& run : runs_) {
    rows += run.difference.size();
    periods += run.period / static_cast<double>(runs_.size());
  }
  MatrixXd columns(rows, kHalfWaves);
  VectorXd differences(rows);
  Index start = 0;
  for (const Run& run : runs_) {
    columns.middleRows(start, run.difference.size()) = courses(run);
    differences.segment(start, run.difference.size()) = run.difference;
    start += run.difference.size();
  }
  const Eigen::HouseholderQR<MatrixXd> decomposition(columns);
  const MatrixXd basis = decomposition.householderQ() * MatrixXd::Identity(rows, kHalfWaves);
  const VectorXd parts = basis.transpose() * differences;
  CommonCourse course;
  for (Index k = 0; k < kHalfWaves; ++k) {
    const double frequency = 0.5 * static_cast<double>(k + 1) / longest();
    course.lines.push_back(
        {frequency, 1 - std::cos(2 * M_PI * frequency * periods), parts[k] * parts[k]});
  }
  differences -= basis * parts;
  std::vector<Run> runs = runs_;
  start = 0;
  for (Run& run : runs) {
    run.difference = differences.segment(start, run.difference.size());
    start += run.difference.size();
  }
  const auto count = static_cast<double>(runs.size());
  course.without = of_runs(runs, count / (count - 1));
  return course;
}

double chi_square(const CommonCourse& course, const JointNoise& noise) {
  double sum = 0;
  for (const DifferenceLine& line : course.lines) {
    sum += line.power / (line.passed * noise.density(line.frequency));
  }
  return sum;
}

std::vector<JointNoise> noise_of_periods(const std::vector<PeriodDifferences>& joints,
                                         const DifferenceLengths& lengths,
                                         const NoiseRules& rules) {
  std::vector<JointDifferences> differences;
  for (const PeriodDifferences& joint : joints) differences.push_back(joint.of_joint());
  std::vector<JointNoise> noise = noise_of_differences(differences, lengths, rules);
  std::vector<std::size_t> drifting;
  std::vector<CommonCourse> courses;
  std::vector<JointDifferences> without = differences;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    std::optional<CommonCourse> course = joints[j].common_course();
    if (!course) continue;
    without[j] = course->without;
    drifting.push_back(j);
    courses.push_back(std::move(*course));
  }
  if (drifting.empty()) return noise;
  const std::vector<JointNoise> beside = noise_of_differences(without, lengths, rules);
  bool all = true;
  for (std::size_t i = 0; i < drifting.size(); ++i) {
    const std::size_t j = drifting[i];
    if (chi_square(courses[i], beside[j]) > rules.course_chi_square) {
      differences[j] = without[j];
    } else {
      all = false;
    }
  }
  return all ? beside : noise_of_differences(differences, lengths, rules);
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/tools/dynid/excite/excite_report.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd one_or_each(const std::vector<double>& values, Index joints, const char* option) {
  const Index given = static_cast<Index>(values.size());
  if (given == 1) return VectorXd::Constant(joints, values[0]);
  if (given == joints) return Eigen::Map<const VectorXd>(values.data(), given);
  throw std::invalid_argument(
      fmt::format("{}: {} values, expected one or {}", option, given, joints));
}

LimitOptions asked_limits(const ExciteOptions& options) {
  LimitOptions wanted;
  wanted.share = options.limits;
  wanted.acceleration = options.acceleration;
  if (!options.keep_out.empty()) {
    std::copy_n(options.keep_out.begin(), 6, wanted.keep_out.emplace().begin());
  }
  std::copy(options.tool.begin(), options.tool.end(), wanted.tool.begin());
  return wanted;
}

PeriodOfRows period_of_rows(const ExciteOptions& options) {
  PeriodOfRows period;
  period.duration = options.base_frequency > 0 ? 1 / options.base_frequency : options.duration;
  period.samples = static_cast<int>(std::lround(period.duration * options.rate));
  if (period.samples < 10) {
    throw std::invalid_argument(
        fmt::format("--rate: {} rows in a period of {} s, expected at least 10", period.samples,
                    period.duration));
  }
  const double rate = period.samples / period.duration;
  if (std::abs(rate - options.rate) > 1e-9 * rate) {
    period.note =
        fmt::format("--rate: {:.9g} Hz instead of {:.9g}, so that a period is {} whole samples",
                    rate, options.rate, period.samples);
  }
  return period;
}

Trajectory repeated(const JointMotion& period, int periods, double duration) {
  const Index samples = period.q.rows(), rows = samples * periods + 1;
  Trajectory all;
  all.time = VectorXd::LinSpaced(rows, 0, static_cast<double>(rows - 1)) * duration /
             static_cast<double>(samples);
  const auto whole = [&](const MatrixXd& one) {
    MatrixXd many(rows, one.cols());
    for (Index k = 0; k < rows; ++k) many.row(k) = one.row(k % samples);
    return many;
  };
  all.q = whole(period.q);
  all.dq = whole(period.dq);
  all.ddq = whole(period.ddq);
  return all;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/likelihood.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLeastRows = 3;  // for each coefficient

}  // namespace

LikelihoodRatio::LikelihoodRatio(const EffectRecordings& data, const RunResiduals& base)
    : data_(data), base_(data.joints()), degrees_(data.joints()) {
  const std::vector<double> no_repeats(data.runs.size(), 0.0);
  const TorqueNoiseModel noise = torque_noise_model(data, base, no_repeats, false);
  for (int j = 0; j < data.joints(); ++j) {
    double counted = 0;
    for (const EffectRun& run : data.runs) counted += run.rows.counted.col(j).sum();
    const auto parameters =
        static_cast<double>(data.model.columns[static_cast<std::size_t>(j)].size());
    degrees_[j] = std::max(1.0, counted - parameters);
    orders_.push_back(noise.joints[static_cast<std::size_t>(j)].quick.coefficients.size());
    base_[j] = innovation_squares(base, j);
  }
}

double LikelihoodRatio::of(const RunResiduals& larger) const {
  double ratio = 0;
  for (int j = 0; j < data_.joints(); ++j) {
    const double squares = innovation_squares(larger, j);
    if (squares > 0) ratio += degrees_[j] * std::log(base_[j] / squares);
  }
  return ratio;
}

double LikelihoodRatio::innovation_squares(const RunResiduals& residuals, int joint) const {
  const Index order = orders_[static_cast<std::size_t>(joint)];
  std::vector<std::pair<std::size_t, Index>> places;  // with all samples before them that are asked
  double squares = 0;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    const auto counted = data_.runs[run].rows.counted.col(joint);
    Index before = 0;
    for (Index t = 0; t < counted.size(); ++t) {
      if (counted[t] != 0 && before >= order) {
        places.emplace_back(run, t);
        squares += residuals[run](t, joint) * residuals[run](t, joint);
      }
      before = counted[t] != 0 ? before + 1 : 0;
    }
  }
  const auto rows = static_cast<Index>(places.size());
  if (order == 0 || rows < kLeastRows * order) return squares;
  MatrixXd past(rows, order);
  VectorXd now(rows);
  for (Index i = 0; i < rows; ++i) {
    const auto [run, t] = places[static_cast<std::size_t>(i)];
    now[i] = residuals[run](t, joint);
    for (Index k = 0; k < order; ++k) past(i, k) = residuals[run](t - 1 - k, joint);
  }
  return (now - past * past.colPivHouseholderQr().solve(now)).squaredNorm();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/estimation/whitener.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Whitener::Whitener(const AutoregressiveNoise& noise)
    : predictors_{noise.coefficients}, deviations_{noise.innovation} {
  while (predictors_.back().size() > 0) {
    const VectorXd& a = predictors_.back();
    const Index order = a.size() - 1;
    const double reflection = a[order];
    const double left = 1 - reflection * reflection;
    VectorXd lower(order);
    for (Index k = 0; k < order; ++k) lower[k] = (a[k] + reflection * a[order - 1 - k]) / left;
    const double deviation = deviations_.back() / std::sqrt(left);
    predictors_.push_back(std::move(lower));
    deviations_.push_back(deviation);
  }
  std::reverse(predictors_.begin(), predictors_.end());
  std::reverse(deviations_.begin(), deviations_.end());
}

void Whitener::apply(Eigen::Ref<MatrixXd> columns,
                     const Eigen::Ref<const VectorXd>& counted) const {
  const auto most = static_cast<Index>(predictors_.size()) - 1;
  Eigen::VectorXi known(counted.size());  // samples before each that it may be predicted from
  int before = 0;
  for (Index t = 0; t < counted.size(); ++t) {
    known[t] = counted[t] != 0 ? before : -1;
    before = counted[t] != 0 ? static_cast<int>(std::min<Index>(before + 1, most)) : 0;
  }
  for (Index c = 0; c < columns.cols(); ++c) {
    if (columns.col(c).isZero(0)) continue;
    double* x = columns.col(c).data();
    // from the last sample on, so that each still finds those before it
    for (Index t = counted.size() - 1; t >= 0; --t) {
      if (known[t] < 0) {
        x[t] = 0;
        continue;
      }
      const auto order = static_cast<std::size_t>(known[t]);
      const VectorXd& a = predictors_[order];
      double sum = x[t];
      for (Index k = 0; k < a.size(); ++k) sum -= a[k] * x[t - 1 - k];
      x[t] = sum / deviations_[order];
    }
  }
}

}  // namespace dyngen::runtime

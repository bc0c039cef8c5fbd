// SPDX-License-Identifier: MIT
#include "runtime/evidence/motion_innovations.h"

#include <algorithm>
#include <utility>

#include "runtime/estimation/burg.h"
#include "runtime/estimation/whitener.h"
#include "runtime/evidence/lag_products.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Equations, early and late, over which the parallel filter spreads an instant.
constexpr Index kSpread = 2;

/// Accelerations of a joint at the equations, less their mean, run by run.
std::vector<VectorXd> accelerations_of(const EffectRecordings& data, int joint) {
  std::vector<VectorXd> runs;
  for (const EffectRun& run : data.runs) {
    VectorXd values = decimate(run.decimator, run.motion.ddq.col(joint));
    if (values.size() > 0) values.array() -= values.mean();
    runs.push_back(std::move(values));
  }
  return runs;
}

/// Of unit variance, run by run; nothing of a joint that stands or is predicted exactly.
std::vector<VectorXd> innovations_of(std::vector<VectorXd> runs) {
  double squares = 0;
  for (const VectorXd& run : runs) squares += run.squaredNorm();
  if (!(squares > 0)) return {};
  const AutoregressiveNoise process = autoregression_of(runs, kNoiseLags);
  if (!(process.innovation > 0)) return {};
  for (VectorXd& run : runs) {
    MatrixXd column = run;
    Whitener({process, {}}, VectorXd::Ones(run.size())).apply(column);
    run = column;
  }
  return runs;
}

/// A process that something drives in place of its white noise.
VectorXd driven(const AutoregressiveNoise& process, const VectorXd& drive) {
  VectorXd x = process.innovation * drive;
  for (Index t = 0; t < x.size(); ++t) {
    const Index past = std::min(process.coefficients.size(), t);
    for (Index k = 0; k < past; ++k) x[t] += process.coefficients[k] * x[t - 1 - k];
  }
  return x;
}

/// What was `late` rows before; 0 beyond the ends.
VectorXd moved_later(const VectorXd& series, Index late) {
  VectorXd moved = VectorXd::Zero(series.size());
  const Index count = series.size() - std::abs(late);
  if (count > 0) {
    moved.segment(std::max<Index>(late, 0), count) =
        series.segment(std::max<Index>(-late, 0), count);
  }
  return moved;
}

}  // namespace

std::vector<JointColumns> motion_innovations(const EffectRecordings& data,
                                             const TorqueNoiseModel& noise) {
  std::vector<std::vector<VectorXd>> moving;  // of each joint that moves
  for (int j = 0; j < data.joints(); ++j) {
    std::vector<VectorXd> own = innovations_of(accelerations_of(data, j));
    if (!own.empty()) moving.push_back(std::move(own));
  }
  std::vector<JointColumns> all;
  constexpr Index kEach = 2 * kSpread + 1;
  for (int j = 0; j < data.joints() && !moving.empty(); ++j) {
    if (!(noise.worth[j] > 0)) continue;  // it has no equations
    const AutoregressiveNoise& process = noise.joints[static_cast<std::size_t>(j)].quick;
    MatrixXd part(data.equations(), kEach * static_cast<Index>(moving.size()));
    Index start = 0;
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      const VectorXd counted = data.runs[run].rows.counted.col(j);
      Index column = 0;
      for (const std::vector<VectorXd>& innovations : moving) {
        for (Index late = -kSpread; late <= kSpread; ++late) {
          part.col(column++).segment(start, counted.size()) =
              driven(process, moved_later(innovations[run], late)).cwiseProduct(counted);
        }
      }
      start += counted.size();
    }
    all.push_back(columns_of_joint(j, std::move(part)));
  }
  return all;
}

}  // namespace dyngen::runtime

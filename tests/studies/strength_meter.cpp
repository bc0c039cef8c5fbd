// SPDX-License-Identifier: MIT
#include "tests/studies/strength_meter.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/effects/effect_rows.h"
#include "runtime/signals/decimation.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;
using runtime::EffectRole;
using runtime::EffectRun;

MatrixXd regressor(const runtime::EffectRecordings& data, runtime::EffectSignals& signals,
                   const runtime::EquationStack& stack, const VectorXd& beta) {
  signals.set_beta(beta);
  signals.set_tangent_beta(beta);
  const runtime::EffectPoint nothing = runtime::at_rest(data, beta, {});
  return stack.stacked(runtime::linearised(data, signals, nothing, runtime::base_unknowns(nothing)))
      .leftCols(data.model.size());
}

/// Shapes with which an effect is tried: as typical, and narrower and wider.
std::vector<VectorXd> shapes_of(const EffectInstance& effect, const runtime::EffectSizes& sizes) {
  std::vector<VectorXd> shapes = {sizes.typical};
  for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
    VectorXd shape = sizes.typical;
    bool differs = false;
    for (Index p = 0; p < shape.size(); ++p) {
      const auto& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
      if (parameter.role != EffectRole::kShape) continue;
      shape[p] = std::clamp(factor * shape[p], sizes.min[p], sizes.max[p]);
      differs = true;
    }
    if (differs) shapes.push_back(shape);
  }
  return shapes;
}

}  // namespace

StrengthMeter::StrengthMeter(const runtime::EffectRecordings& data, const VectorXd& beta,
                             const runtime::AtlasNoise& noise)
    : data_(data),
      beta_(beta),
      signals_(data),
      scales_(data),
      stack_(data, runtime::Whitening{runtime::quick_noise(noise.joints)}),
      projection_(regressor(data, signals_, stack_, beta)) {}

VectorXd StrengthMeter::whitened(const std::vector<MatrixXd>& torque) const {
  if (torque.size() != data_.runs.size()) {
    throw std::invalid_argument("StrengthMeter: expected one run of each recording");
  }
  VectorXd all = VectorXd::Zero(stack_.rows());
  Index start = 0;
  for (std::size_t r = 0; r < data_.runs.size(); ++r) {
    const EffectRun& run = data_.runs[r];
    const Index first = std::lround(run.time[0] / run.motion.sample_time);
    const MatrixXd rows =
        runtime::decimate(run.decimator, torque[r].middleRows(first, run.motion.samples()));
    for (int j = 0; j < data_.joints(); ++j) {
      all.segment(stack_.first(j) + start, rows.rows()) =
          rows.col(j).cwiseProduct(run.rows.counted.col(j));
    }
    start += rows.rows();
  }
  return stack_.whitened(all);
}

VectorXd StrengthMeter::left_of(const std::vector<MatrixXd>& torque) const {
  return projection_.rest(whitened(torque));
}

double StrengthMeter::likeness(const VectorXd& left, const EffectInstance& effect) {
  const runtime::EffectSizes sizes = effect.law.sizes(scales_.of(beta_, effect));
  double most = 0;
  for (const VectorXd& shape : shapes_of(effect, sizes)) {
    EffectInstance tried = effect;
    tried.parameters = shape;
    MatrixXd plain;
    try {
      plain = stack_.plain(signals_, tried);
    } catch (const std::invalid_argument&) {
      return 0;  // the recording lacks what it reads
    }
    if (!plain.allFinite()) continue;
    const MatrixXd columns = stack_.whitened(std::move(plain));
    MatrixXd span(columns.rows(), 0);
    for (Index p = 0; p < shape.size(); ++p) {
      const EffectRole role = effect.law.parameters[static_cast<std::size_t>(p)].role;
      if (role != EffectRole::kLinear || columns.col(1 + p).isZero(0)) continue;
      span.conservativeResize(Eigen::NoChange, span.cols() + 1);
      span.rightCols(1) = columns.col(1 + p).normalized();
    }
    if (span.cols() == 0 && !columns.col(0).isZero(0)) span = columns.col(0).normalized();
    if (span.cols() == 0) continue;
    const MatrixXd rest = projection_.rest(span);
    Eigen::ColPivHouseholderQR<MatrixXd> qr(rest);
    qr.setThreshold(1e-6);
    if (rest.norm() < 1e-6) continue;
    const VectorXd missed = left - rest * qr.solve(left);
    most = std::max(most, 1 - missed.squaredNorm() / left.squaredNorm());
  }
  return most;
}

}  // namespace dyngen::test

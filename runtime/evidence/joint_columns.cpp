// SPDX-License-Identifier: MIT
#include "runtime/evidence/joint_columns.h"

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/effects/effect_rows.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

// NOLINTNEXTLINE(performance-unnecessary-value-param): its parts are moved
JointColumns columns_of(std::map<int, MatrixXd> parts) {
  JointColumns columns;
  for (auto& [joint, part] : parts) {
    columns.joints.push_back(joint);
    columns.parts.push_back(std::move(part));
  }
  return columns;
}

}  // namespace

JointColumns columns_of_joint(int joint, MatrixXd part) {
  JointColumns columns;
  columns.joints.push_back(joint);
  columns.parts.push_back(std::move(part));
  return columns;
}

JointColumns side_by_side(const std::vector<JointColumns>& sets) {
  Index width = 0;
  for (const JointColumns& set : sets) width += set.columns();
  std::map<int, MatrixXd> parts;
  Index first = 0;
  for (const JointColumns& set : sets) {
    for (std::size_t i = 0; i < set.joints.size(); ++i) {
      MatrixXd& part = parts[set.joints[i]];
      if (part.size() == 0) part = MatrixXd::Zero(set.parts[i].rows(), width);
      part.middleCols(first, set.columns()) = set.parts[i];
    }
    first += set.columns();
  }
  return columns_of(std::move(parts));
}

JointColumns effect_columns(const EffectRecordings& data, EffectSignals& signals,
                            const EffectInstance& effect, const std::vector<int>& wanted,
                            bool states_held) {
  std::map<int, MatrixXd> parts;
  Index start = 0;
  const auto width = static_cast<Index>(wanted.size());
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const RowBlock& rows = data.runs[run].rows;
    const EffectSignature signature = signature_of(data, signals, run, effect, wanted, states_held);
    for (std::size_t i = 0; i < signature.joints.size(); ++i) {
      const int joint = signature.joints[i];
      MatrixXd& part = parts[joint];
      if (part.size() == 0) part = MatrixXd::Zero(data.equations(), width);
      for (Index c = 0; c < width; ++c) {
        part.col(c).segment(start, rows.Y.rows()) =
            signature.columns[i].col(c).cwiseProduct(rows.counted.col(joint));
      }
    }
    start += rows.Y.rows();
  }
  return columns_of(std::move(parts));
}

namespace {

/// Every `stride`th sample of a run; a divisor of its decimation.
void thin(EffectRun& run, Index stride) {
  if (stride <= 1) return;
  const Index factor = run.decimator.factor / stride;
  const Decimator decimator = design_decimator(factor, run.decimator.shape);
  const Index origin = first_sample(run.decimator) - first_sample(decimator) * stride;
  const Index count =
      first_sample(decimator) + (run.rows.Y.rows() - 1) * factor + decimator.taps.size() / 2 + 1;
  Motion& motion = run.motion;
  // the filters' ends differ by less than a stride
  const Index last = motion.samples() - 1;
  std::vector<Index> places;
  for (Index k = 0; k < count; ++k)
    places.push_back(std::clamp<Index>(origin + k * stride, 0, last));
  motion.sample_time *= static_cast<double>(stride);
  motion.time = motion.time(places).eval();
  run.time = run.time(places).eval();
  for (MatrixXd* signal : {&motion.q, &motion.dq, &motion.ddq, &motion.tau, &motion.temperature}) {
    if (signal->size() != 0) *signal = (*signal)(places, Eigen::all).eval();
  }
  run.decimator = decimator;
}

}  // namespace

EffectRecordings thinned(EffectRecordings data, double longest) {
  for (EffectRun& run : data.runs) {
    const Index factor = run.decimator.factor;
    const double most = longest / run.motion.sample_time * (1 + 1e-9);
    Index stride = 1;
    for (Index s = 2; s <= factor && static_cast<double>(s) <= most; ++s) {
      if (factor % s == 0) stride = s;
    }
    thin(run, stride);
  }
  return data;
}

EffectRecordings thinned(const EffectRecordings& data) {
  EffectRecordings thin_data = data;
  for (EffectRun& run : thin_data.runs) {
    if (run.decimator.factor % kThinnedSamples == 0) {
      thin(run, run.decimator.factor / kThinnedSamples);
    }
  }
  return thin_data;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/evidence/joint_columns.h"

#include <algorithm>
#include <map>

#include "runtime/effects/effect_rows.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;

JointColumns effect_columns(const EffectRecordings& data, EffectSignals& signals,
                            const EffectInstance& effect, const std::vector<int>& wanted,
                            bool states_held) {
  std::map<int, MatrixXd> parts;
  Index start = 0;
  const auto width = static_cast<Index>(wanted.size());
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const RowBlock& rows = data.runs[run].rows;
    const EffectSignature signature = signature_of(data, signals, run, effect, states_held);
    for (std::size_t i = 0; i < signature.joints.size(); ++i) {
      const int joint = signature.joints[i];
      MatrixXd& part = parts[joint];
      if (part.size() == 0) part = MatrixXd::Zero(data.equations(), width);
      for (Index c = 0; c < width; ++c) {
        part.col(c).segment(start, rows.Y.rows()) = signature.columns[i]
                                                        .col(wanted[static_cast<std::size_t>(c)])
                                                        .cwiseProduct(rows.counted.col(joint));
      }
    }
    start += rows.Y.rows();
  }
  JointColumns columns;
  for (auto& [joint, part] : parts) {
    columns.joints.push_back(joint);
    columns.parts.push_back(std::move(part));
  }
  return columns;
}

EffectRecordings thinned(const EffectRecordings& data) {
  EffectRecordings thin = data;
  for (EffectRun& run : thin.runs) {
    const Index factor = run.decimator.factor;
    if (factor % kThinnedSamples != 0 || factor == kThinnedSamples) continue;
    const Index stride = factor / kThinnedSamples;
    const Decimator decimator = design_decimator(kThinnedSamples);
    const Index lead = first_sample(decimator);
    const Index origin = first_sample(run.decimator) - lead * stride;
    const Index count =
        lead + (run.rows.Y.rows() - 1) * kThinnedSamples + decimator.taps.size() / 2 + 1;
    Motion& motion = run.motion;
    // the filters' ends differ by less than a stride
    const Index last = motion.samples() - 1;
    std::vector<Index> places;
    for (Index k = 0; k < count; ++k) {
      places.push_back(std::clamp<Index>(origin + k * stride, 0, last));
    }
    motion.sample_time *= static_cast<double>(stride);
    motion.time = motion.time(places).eval();
    run.time = run.time(places).eval();
    for (MatrixXd* signal :
         {&motion.q, &motion.dq, &motion.ddq, &motion.tau, &motion.temperature}) {
      if (signal->size() != 0) *signal = (*signal)(places, Eigen::all).eval();
    }
    run.decimator = decimator;
  }
  return thin;
}

}  // namespace dyngen::runtime

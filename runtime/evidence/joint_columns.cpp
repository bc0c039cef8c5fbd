// SPDX-License-Identifier: MIT
#include "runtime/evidence/joint_columns.h"

#include <algorithm>
#include <map>
#include <set>

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

EffectRecordings at_equations(const EffectRecordings& data) {
  EffectRecordings coarse = data;
  for (EffectRun& run : coarse.runs) {
    const Index first = first_sample(run.decimator), factor = run.decimator.factor;
    const auto places = Eigen::seqN(first, run.rows.Y.rows(), factor);
    Motion& motion = run.motion;
    motion.sample_time *= static_cast<double>(factor);
    motion.time = motion.time(places).eval();
    run.time = run.time(places).eval();
    for (MatrixXd* signal :
         {&motion.q, &motion.dq, &motion.ddq, &motion.tau, &motion.temperature}) {
      if (signal->size() != 0) *signal = (*signal)(places, Eigen::all).eval();
    }
    run.decimator = design_decimator(1);
  }
  return coarse;
}

JointColumns selected(const JointColumns& all, const std::vector<int>& places) {
  JointColumns result{all.joints, {}};
  for (const MatrixXd& part : all.parts) {
    MatrixXd some(part.rows(), static_cast<Index>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i) {
      some.col(static_cast<Index>(i)) = part.col(places[i]);
    }
    result.parts.push_back(std::move(some));
  }
  return result;
}

JointColumns joined(const JointColumns& first, const JointColumns& second) {
  if (first.parts.empty()) return second;
  if (second.parts.empty()) return first;
  std::set<int> joints(first.joints.begin(), first.joints.end());
  joints.insert(second.joints.begin(), second.joints.end());
  const Index rows = first.parts.front().rows();
  JointColumns result;
  for (const int joint : joints) {
    MatrixXd part = MatrixXd::Zero(rows, first.columns() + second.columns());
    for (std::size_t i = 0; i < first.joints.size(); ++i) {
      if (first.joints[i] == joint) part.leftCols(first.columns()) = first.parts[i];
    }
    for (std::size_t i = 0; i < second.joints.size(); ++i) {
      if (second.joints[i] == joint) part.rightCols(second.columns()) = second.parts[i];
    }
    result.joints.push_back(joint);
    result.parts.push_back(std::move(part));
  }
  return result;
}

}  // namespace dyngen::runtime

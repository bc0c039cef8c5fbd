// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/largest_model.h"

#include <utility>

#include "runtime/diagnosis/equation_sets/sufficiency.h"
#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;
using Form = GenericStructure::Form;

/// The first two derivatives of a joint's load by time. @return (equations x 2)
MatrixXd derivatives_of_load(const EffectRecordings& data, EffectSignals& signals, int joint) {
  MatrixXd all(data.equations(), 2);
  Index start = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    const VectorXd load = variable_values(data, signals, run, {Kind::kLoad, joint});
    const Index n = load.size();
    MatrixXd both = MatrixXd::Zero(n, 2);
    for (Index k = 1; k + 1 < n; ++k) {
      both(k, 0) = (load[k + 1] - load[k - 1]) / (2 * here.motion.sample_time);
      both(k, 1) = (load[k + 1] - 2 * load[k] + load[k - 1]) /
                   (here.motion.sample_time * here.motion.sample_time);
    }
    all.middleRows(start, here.rows.Y.rows()) = decimate(here.decimator, both);
    start += here.rows.Y.rows();
  }
  return all;
}

MatrixXd shapes_of_joint(const EffectRecordings& data, EffectSignals& signals, int joint) {
  std::vector<MatrixXd> parts;
  for (const Kind kind : {Kind::kPosition, Kind::kVelocity, Kind::kLoad}) {
    parts.push_back(function_shapes(data, signals, {joint, {{kind, joint}}, Form::kFunction}));
  }
  for (const Kind kind : {Kind::kPosition, Kind::kLoad, Kind::kDistance}) {
    parts.push_back(function_shapes(data, signals, {joint, {{kind, joint}}, Form::kFriction}));
  }
  parts.push_back(derivatives_of_load(data, signals, joint));
  Index columns = 0;
  for (const MatrixXd& part : parts) columns += part.cols();
  MatrixXd shapes(data.equations(), columns);
  Index at = 0;
  for (const MatrixXd& part : parts) {
    shapes.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  return shapes;
}

}  // namespace

std::vector<JointColumns> largest_model(const EffectRecordings& data, EffectSignals& signals,
                                        const EquationRules& rules) {
  std::vector<JointColumns> all;
  for (int j = 0; j < data.joints(); ++j) {
    const double counted = equations_of_joint(data, j);
    if (counted == 0) continue;  // it stands
    all.push_back(counted_columns(data, j, shapes_of_joint(data, signals, j)));
    const std::size_t parameters = data.model.columns[static_cast<std::size_t>(j)].size();
    if (counted < rules.least_equations + 2 * static_cast<double>(parameters) +
                      2 * static_cast<double>(all.back().columns())) {
      return {};
    }
  }
  return all;
}

}  // namespace dyngen::runtime

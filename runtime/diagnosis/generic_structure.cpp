// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/generic_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;

constexpr int kAlone = 9, kInPairs = 5;  // knots of one variable, and of each of two
constexpr int kOfSpeeds = 3;             // of each of two velocities: rest, and fast both ways

EffectInstance of_joint(int joint) {
  EffectInstance effect;
  effect.joint = joint;
  return effect;
}

/// Quantiles of a variable over all runs, from the smallest to the largest; without repeats.
std::vector<double> knots_of(const std::vector<VectorXd>& runs, int count) {
  std::vector<double> all;
  for (const VectorXd& run : runs) {
    const Index step = std::max<Index>(1, run.size() / 2000);
    for (Index k = 0; k < run.size(); k += step) all.push_back(run[k]);
  }
  std::sort(all.begin(), all.end());
  std::vector<double> knots;
  for (int i = 0; i < count; ++i) {
    const double place = static_cast<double>(i) / (count - 1) * static_cast<double>(all.size() - 1);
    const double value = all[static_cast<std::size_t>(place)];
    if (knots.empty() || value > knots.back()) knots.push_back(value);
  }
  return knots;
}

/// Hat functions between knots, each 1 at its knot; constant beyond the ends. @return (N x knots)
MatrixXd hats(const VectorXd& x, const std::vector<double>& knots) {
  const auto count = static_cast<Index>(knots.size());
  MatrixXd values = MatrixXd::Zero(x.size(), count);
  if (count == 1) return MatrixXd::Ones(x.size(), 1);
  for (Index k = 0; k < x.size(); ++k) {
    const double at = std::clamp(x[k], knots.front(), knots.back());
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, at);
    const auto high = static_cast<Index>(above - knots.begin());
    const double low_knot = knots[static_cast<std::size_t>(high - 1)];
    const double part = (at - low_knot) / (*above - low_knot);
    values(k, high - 1) = 1 - part;
    values(k, high) = part;
  }
  return values;
}

/// Travel since the last reversal of a joint, of all samples.
VectorXd distance_since_reversal(const VectorXd& q, const VectorXd& sign) {
  VectorXd distance(q.size());
  double turned = q.size() > 0 ? q[0] : 0;
  for (Index k = 0; k < q.size(); ++k) {
    if (k > 0 && sign[k] * sign[k - 1] < 0) turned = q[k];
    distance[k] = std::abs(q[k] - turned);
  }
  return distance;
}

VectorXd sign_of(const EffectRecordings& data, std::size_t run, int joint) {
  const EffectRun& here = data.runs[run];
  return travelled_sign(here.motion.q.col(joint), here.motion.dq.col(joint),
                        2.5 * here.position_step[joint]);
}

}  // namespace

std::string variable_name(const StructureVariable& variable) {
  const int joint = variable.joint + 1;
  switch (variable.kind) {
    case Kind::kPosition:
      return fmt::format("q{}", joint);
    case Kind::kVelocity:
      return fmt::format("qd{}", joint);
    case Kind::kAcceleration:
      return fmt::format("qdd{}", joint);
    case Kind::kLoad:
      return fmt::format("tau_load{}", joint);
    case Kind::kDistance:
      return fmt::format("distance{}", joint);
    case Kind::kTime:
      break;
  }
  return "t";
}

std::vector<std::string> GenericStructure::names() const {
  if (line) return {"t"};
  if (at_reversals) return {variable_name({Kind::kDistance, joint})};
  std::vector<std::string> names;
  for (const StructureVariable& variable : variables) names.push_back(variable_name(variable));
  const std::string speed = variable_name({Kind::kVelocity, joint});
  if (times_sign && std::find(names.begin(), names.end(), speed) == names.end()) {
    names.push_back(speed);
  }
  return names;
}

GenericStructure impulses_at_reversals(int joint) { return {joint, {}, false, true}; }

std::vector<GenericStructure> generic_structures(int joints) {
  std::vector<GenericStructure> structures;
  for (int j = 0; j < joints; ++j) {
    for (const Kind kind : {Kind::kPosition, Kind::kVelocity, Kind::kAcceleration, Kind::kLoad}) {
      structures.push_back({j, {{kind, j}}, false});
    }
    structures.push_back({j, {{Kind::kTime, -1}}, false});
    for (const Kind kind : {Kind::kPosition, Kind::kAcceleration, Kind::kLoad, Kind::kDistance}) {
      structures.push_back({j, {{kind, j}}, true});
    }
    structures.push_back({j, {{Kind::kTime, -1}}, true});
    structures.push_back(impulses_at_reversals(j));
    structures.push_back({j, {}, false, false, true});
    for (int k = 0; k < joints; ++k) {
      if (k == j) continue;
      for (const Kind kind : {Kind::kPosition, Kind::kVelocity, Kind::kAcceleration}) {
        structures.push_back({j, {{kind, k}}, false});
      }
      structures.push_back({j, {{Kind::kPosition, k}}, true});
    }
    for (int k = 0; k < joints; ++k) {
      structures.push_back({j, {{Kind::kVelocity, j}, {Kind::kPosition, k}}, false});
      for (int m = k + 1; m < joints; ++m) {
        structures.push_back({j, {{Kind::kPosition, k}, {Kind::kPosition, m}}, false});
        structures.push_back({j, {{Kind::kVelocity, k}, {Kind::kVelocity, m}}, false});
      }
    }
  }
  return structures;
}

VectorXd variable_values(const EffectRecordings& data, EffectSignals& signals, std::size_t run,
                         const StructureVariable& variable) {
  const EffectRun& here = data.runs[run];
  const Motion& motion = here.motion;
  switch (variable.kind) {
    case Kind::kPosition:
      return motion.q.col(variable.joint);
    case Kind::kVelocity:
      return motion.dq.col(variable.joint);
    case Kind::kAcceleration:
      return motion.ddq.col(variable.joint);
    case Kind::kDistance:
      return distance_since_reversal(motion.q.col(variable.joint),
                                     sign_of(data, run, variable.joint));
    case Kind::kLoad: {
      EffectInstance effect = of_joint(variable.joint);
      effect.law.variables = {"tau_load"};
      return signals.variables(run, effect, variable.joint).col(0);
    }
    case Kind::kTime:
      break;
  }
  return here.time;
}

VectorXd values_at_equations(const EffectRecordings& data, EffectSignals& signals,
                             const StructureVariable& variable) {
  VectorXd values(data.equations());
  Index start = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    const VectorXd all = variable_values(data, signals, run, variable);
    const Index first = first_sample(here.decimator), rows = here.rows.Y.rows();
    for (Index k = 0; k < rows; ++k) values[start + k] = all[first + k * here.decimator.factor];
    start += rows;
  }
  return values;
}

namespace {

constexpr double kResting = 0.015;  // of the largest speed: below it a joint may have stopped

double fastest(const EffectRecordings& data, int joint) {
  double speed = 0;
  for (const EffectRun& run : data.runs) {
    speed = std::max(speed, run.motion.dq.col(joint).cwiseAbs().maxCoeff());
  }
  return speed;
}

/// Samples in the middle of the impulses of a run: some apart from one another over each stretch in
/// which the joint may have stopped, two or more of each.
std::vector<Index> impulses_of(const EffectRun& run, int joint, double still, Index apart) {
  const auto dq = run.motion.dq.col(joint);
  const auto stops = [&](Index k) {
    return std::abs(dq[k]) < still || (k > 0 && dq[k] * dq[k - 1] < 0);
  };
  std::vector<Index> middles;
  Index end = -1;  // of the last stretch
  for (Index k = 0; k < dq.size(); ++k) {
    if (!stops(k)) continue;
    const Index from = k;
    Index to = k;
    for (Index i = k; i < std::min(dq.size(), to + apart); ++i) {
      if (stops(i)) to = i;
    }
    const Index length = to - from, count = std::max<Index>(2, 1 + (length + apart) / apart);
    const Index first = (from + to) / 2 - (count - 1) * apart / 2;
    for (Index i = 0; i < count; ++i) {
      const Index middle = first + i * apart;
      if (middle > end) middles.push_back(middle);
    }
    end = middles.empty() ? -1 : middles.back();
    k = to;
  }
  return middles;
}

/// Impulses where the joint turns or stops, short beside the filter.
JointColumns impulse_columns(const EffectRecordings& data, int joint) {
  const double still = kResting * fastest(data, joint);
  std::vector<std::vector<Index>> middles;
  Index count = 0;
  for (const EffectRun& run : data.runs) {
    middles.push_back(impulses_of(run, joint, still, std::max<Index>(1, run.decimator.factor / 2)));
    count += static_cast<Index>(middles.back().size());
  }
  JointColumns columns{{joint}, {MatrixXd::Zero(data.equations(), count)}};
  Index start = 0, column = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    const EffectRun& here = data.runs[run];
    const Index width = std::max<Index>(1, here.decimator.factor / 2);
    MatrixXd impulses =
        MatrixXd::Zero(here.motion.samples(), static_cast<Index>(middles[run].size()));
    for (Index c = 0; c < impulses.cols(); ++c) {
      const Index middle = middles[run][static_cast<std::size_t>(c)];
      const Index end = std::min(impulses.rows(), middle + width);
      for (Index k = std::max<Index>(0, middle - width); k < end; ++k) {
        impulses(k, c) = 1 - std::abs(static_cast<double>(k - middle)) / static_cast<double>(width);
      }
    }
    columns.parts[0].block(start, column, here.rows.Y.rows(), impulses.cols()) =
        here.rows.counted.col(joint).asDiagonal() * decimate(here.decimator, impulses);
    start += here.rows.Y.rows();
    column += impulses.cols();
  }
  return columns;
}

/// Cosine and sine of each run.
JointColumns line_columns(const EffectRecordings& data, const GenericStructure& structure) {
  const double w = 2 * std::numbers::pi * structure.frequency;
  MatrixXd part = MatrixXd::Zero(data.equations(), 2 * static_cast<Index>(data.runs.size()));
  Index start = 0, column = 0;
  for (const EffectRun& run : data.runs) {
    MatrixXd both(run.time.size(), 2);
    both << (w * run.time.array()).cos().matrix(), (w * run.time.array()).sin().matrix();
    part.block(start, column, run.rows.Y.rows(), 2) =
        run.rows.counted.col(structure.joint).asDiagonal() * decimate(run.decimator, both);
    start += run.rows.Y.rows();
    column += 2;
  }
  return {{structure.joint}, {std::move(part)}};
}

}  // namespace

JointColumns generic_columns(const EffectRecordings& data, EffectSignals& signals,
                             const GenericStructure& structure) {
  if (structure.at_reversals) return impulse_columns(data, structure.joint);
  if (structure.line) return line_columns(data, structure);
  const bool speeds = std::all_of(
      structure.variables.begin(), structure.variables.end(),
      [](const StructureVariable& variable) { return variable.kind == Kind::kVelocity; });
  const int knots = structure.variables.size() == 1 ? kAlone : speeds ? kOfSpeeds : kInPairs;
  std::vector<std::vector<VectorXd>> values;
  std::vector<std::vector<double>> places;
  for (const StructureVariable& variable : structure.variables) {
    values.emplace_back();
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      values.back().push_back(variable_values(data, signals, run, variable));
    }
    places.push_back(knots_of(values.back(), knots));
  }
  JointColumns columns{{structure.joint}, {}};
  MatrixXd part;
  Index start = 0;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    MatrixXd shape = hats(values[0][run], places[0]);
    if (structure.variables.size() > 1) {
      const MatrixXd second = hats(values[1][run], places[1]);
      MatrixXd both(shape.rows(), shape.cols() * second.cols());
      for (Index i = 0; i < shape.cols(); ++i) {
        both.middleCols(i * second.cols(), second.cols()) = shape.col(i).asDiagonal() * second;
      }
      shape = std::move(both);
    }
    if (structure.times_sign) shape = sign_of(data, run, structure.joint).asDiagonal() * shape;
    const RowBlock& rows = data.runs[run].rows;
    if (part.size() == 0) part = MatrixXd::Zero(data.equations(), shape.cols());
    part.middleRows(start, rows.Y.rows()) =
        rows.counted.col(structure.joint).asDiagonal() * decimate(data.runs[run].decimator, shape);
    start += rows.Y.rows();
  }
  columns.parts.push_back(std::move(part));
  return columns;
}

}  // namespace dyngen::runtime

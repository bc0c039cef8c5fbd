// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/generic_columns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "runtime/diagnosis/scans/impulse_columns.h"
#include "runtime/diagnosis/scans/repeat_scan.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;
using Form = GenericStructure::Form;

constexpr int kAlone = 9, kInPairs = 5;  // knots of one variable, and of each of two
constexpr int kOfSpeeds = 3;             // of each of two velocities: rest, and fast both ways

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

/// Cosine and sine of each run.
JointColumns line_columns(const EffectRecordings& data, const GenericStructure& structure) {
  const double w = 2 * std::numbers::pi * structure.frequency[0];
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
  return columns_of_joint(structure.joint, std::move(part));
}

/// Values of a run for all runs, where they are of a run's motion.
using RunValues = std::vector<VectorXd>;

RunValues values_of(const EffectRecordings& data, EffectSignals& signals,
                    const StructureVariable& variable) {
  RunValues values;
  for (std::size_t run = 0; run < data.runs.size(); ++run) {
    values.push_back(variable_values(data, signals, run, variable));
  }
  return values;
}

/// Each column of one times each of the other, sample by sample.
MatrixXd products_of(const MatrixXd& first, const MatrixXd& second) {
  MatrixXd both(first.rows(), first.cols() * second.cols());
  for (Index i = 0; i < first.cols(); ++i) {
    both.middleCols(i * second.cols(), second.cols()) = first.col(i).asDiagonal() * second;
  }
  return both;
}

/// What the functions of a structure are of, and what multiplies them; nothing where that is 1.
struct Arguments {
  std::vector<RunValues> of;
  RunValues factor;
  int knots = kAlone;  // of each
};

Arguments arguments_of(const EffectRecordings& data, EffectSignals& signals,
                       const GenericStructure& structure) {
  Arguments arguments;
  for (const StructureVariable& variable : structure.variables) {
    arguments.of.push_back(values_of(data, signals, variable));
  }
  if (structure.form == Form::kSpeeds) {
    RunValues product = arguments.of[0];
    for (std::size_t run = 0; run < product.size(); ++run) {
      product[run].array() *= arguments.of[1][run].array();
    }
    if (arguments.of.size() == 2) {
      arguments.of = {std::move(product)};
    } else {
      arguments.of = {std::move(arguments.of[2])};
      arguments.factor = std::move(product);
      arguments.knots = kOfSpeeds;
    }
    return arguments;
  }
  const bool speeds = std::all_of(
      structure.variables.begin(), structure.variables.end(),
      [](const StructureVariable& variable) { return variable.kind == Kind::kVelocity; });
  if (arguments.of.size() > 1) arguments.knots = speeds ? kOfSpeeds : kInPairs;
  if (structure.form == Form::kFriction) {
    for (std::size_t run = 0; run < data.runs.size(); ++run) {
      arguments.factor.push_back(travelled_sign_of(data, run, structure.joint));
    }
  }
  return arguments;
}

StructureKnots knots_of(const Arguments& arguments) {
  StructureKnots knots;
  for (const RunValues& values : arguments.of) {
    knots.push_back(knots_of(values, arguments.knots));
  }
  return knots;
}

/// Shapes of each run at all samples.
std::vector<MatrixXd> shapes_of(const Arguments& arguments, const StructureKnots& knots) {
  std::vector<MatrixXd> shapes;
  for (std::size_t run = 0; run < arguments.of[0].size(); ++run) {
    MatrixXd shape = hats(arguments.of[0][run], knots[0]);
    if (arguments.of.size() > 1) shape = products_of(shape, hats(arguments.of[1][run], knots[1]));
    if (!arguments.factor.empty()) shape = arguments.factor[run].asDiagonal() * shape;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

/// Cosines and sines of a position times each of some frequencies, of any sign.
class Turns {
 public:
  Turns(const VectorXd& q, const Eigen::RowVectorXd& frequencies) {
    for (const double frequency : frequencies) {
      const auto [place, added] = turns_.try_emplace(std::abs(frequency));
      if (!added) continue;
      auto& [cosines, sines] = place->second;
      cosines.resize(q.size());
      sines.resize(q.size());
      for (Index k = 0; k < q.size(); ++k) {  // both at once, which is little more than one
        const double angle = place->first * q[k];
        cosines[k] = std::cos(angle);
        sines[k] = std::sin(angle);
      }
    }
  }
  [[nodiscard]] const ArrayXd& cosines(double frequency) const {
    return turns_.at(std::abs(frequency)).first;
  }
  /// Of the frequency without its sign.
  [[nodiscard]] const ArrayXd& sines(double frequency) const {
    return turns_.at(std::abs(frequency)).second;
  }

 private:
  std::map<double, std::pair<ArrayXd, ArrayXd>> turns_;
};

/// The equations of what is given at all samples of each run.
MatrixXd behind_filter(const EffectRecordings& data, const std::vector<MatrixXd>& shapes) {
  MatrixXd all(data.equations(), shapes.front().cols());
  Index start = 0;
  for (std::size_t run = 0; run < shapes.size(); ++run) {
    const Index rows = data.runs[run].rows.Y.rows();
    all.middleRows(start, rows) = decimate(data.runs[run].decimator, shapes[run]);
    start += rows;
  }
  return all;
}

}  // namespace

bool is_function(const GenericStructure& structure) {
  return structure.form == Form::kFunction || structure.form == Form::kFriction ||
         structure.form == Form::kSpeeds;
}

JointColumns counted_columns(const EffectRecordings& data, int joint, MatrixXd shapes) {
  Index start = 0;
  for (const EffectRun& run : data.runs) {
    auto part = shapes.middleRows(start, run.rows.Y.rows());
    part = (run.rows.counted.col(joint).asDiagonal() * part).eval();
    start += part.rows();
  }
  return columns_of_joint(joint, std::move(shapes));
}

MatrixXd function_shapes(const EffectRecordings& data, EffectSignals& signals,
                         const GenericStructure& structure) {
  const Arguments arguments = arguments_of(data, signals, structure);
  return behind_filter(data, shapes_of(arguments, knots_of(arguments)));
}

MatrixXd wave_shapes(const EffectRecordings& data, int first, int second,
                     const Eigen::Matrix2Xd& frequencies) {
  std::vector<MatrixXd> shapes;
  for (const EffectRun& run : data.runs) {
    const Turns own(run.motion.q.col(first), frequencies.row(0));
    const Turns other(run.motion.q.col(second), frequencies.row(1));
    MatrixXd both(run.motion.samples(), 2 * frequencies.cols());
    for (Index i = 0; i < frequencies.cols(); ++i) {
      const double f = frequencies(0, i), g = frequencies(1, i);
      const double sign = (f < 0) == (g < 0) ? 1 : -1, turned = f < 0 ? -1 : 1;
      const ArrayXd &c = own.cosines(f), &s = own.sines(f);
      const ArrayXd &other_c = other.cosines(g), &other_s = other.sines(g);
      // of the sum of both angles
      both.col(2 * i) = c * other_c - sign * (s * other_s);
      both.col(2 * i + 1) = turned * (s * other_c + sign * (c * other_s));
    }
    shapes.push_back(std::move(both));
  }
  return behind_filter(data, shapes);
}

StructureKnots structure_knots(const EffectRecordings& data, EffectSignals& signals,
                               const GenericStructure& structure) {
  if (!is_function(structure)) return {};
  return knots_of(arguments_of(data, signals, structure));
}

JointColumns generic_columns(const EffectRecordings& data, EffectSignals& signals,
                             const GenericStructure& structure, const StructureKnots& knots) {
  if (!is_function(structure)) return generic_columns(data, signals, structure);
  return counted_columns(
      data, structure.joint,
      behind_filter(data, shapes_of(arguments_of(data, signals, structure), knots)));
}

JointColumns generic_columns(const EffectRecordings& data, EffectSignals& signals,
                             const GenericStructure& structure) {
  switch (structure.form) {
    case Form::kImpulses:
      return impulse_columns(data, structure.joint);
    case Form::kLine:
      return line_columns(data, structure);
    case Form::kRepeats:
      return harmonic_columns(data, structure.joint, repeats_of(data), structure.frequency[0]);
    case Form::kWave:
      return counted_columns(data, structure.joint,
                             wave_shapes(data, structure.variables[0].joint,
                                         structure.variables[1].joint, structure.frequency));
    case Form::kFunction:
    case Form::kFriction:
    case Form::kSpeeds:
      break;
  }
  return counted_columns(data, structure.joint, function_shapes(data, signals, structure));
}

}  // namespace dyngen::runtime

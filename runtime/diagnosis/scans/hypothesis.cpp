// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/hypothesis.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kOrders = 1000;         // values of a scan that is one over orders
constexpr int kScanned = 40;          // values of any other, at most
constexpr double kShownPart = 1e-12;  // of an effect's sum of squares: less is rounding
constexpr double kWide = 8;  // times the typical shape, both ways, where there are no bounds

/// Linear parameters at which the effect has no torque: torque = C (p - nothing).
/// @param plain  torque, then C
VectorXd null_values(const JointColumns& plain, const Hypothesis& hypothesis,
                     const VectorXd& parameters) {
  const auto k = static_cast<Index>(hypothesis.linear.size());
  MatrixXd A = MatrixXd::Zero(k, k);
  VectorXd b = VectorXd::Zero(k), present(k);
  for (Index i = 0; i < k; ++i) {
    present[i] = parameters[hypothesis.linear[static_cast<std::size_t>(i)]];
  }
  for (const MatrixXd& part : plain.parts) {
    A += part.rightCols(k).transpose() * part.rightCols(k);
    b += part.rightCols(k).transpose() * part.col(0);
  }
  VectorXd scale = A.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0 ? 1 / s : 0;
  const MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const VectorXd distance =
      scale.cwiseProduct(scaled.completeOrthogonalDecomposition().solve(scale.cwiseProduct(b)));
  VectorXd nothing = present - distance;
  // rounding: a file that says 0 means 0
  for (Index i = 0; i < k; ++i) {
    if (std::abs(nothing[i]) < 1e-6 * std::abs(distance[i])) nothing[i] = 0;
  }
  return nothing;
}

/// Parameters of a trial, and whether they are admissible.
/// @param nothing  linear parameters at which there is no effect
TrialScore concluded(const Hypothesis& hypothesis, EffectInstance trial, Score score,
                     const Products& products, const VectorXd& nothing, const EffectScales& scales,
                     const PriorRules& priors) {
  TrialScore result;
  const auto k = static_cast<Index>(hypothesis.linear.size());
  result.typical.resize(k);
  for (Index i = 0; i < k; ++i) {
    double& value = trial.parameters[hypothesis.linear[static_cast<std::size_t>(i)]];
    result.typical[i] = value - nothing[i];
    value = nothing[i] + score.coefficients[i];
  }
  // what moves nothing here has no size that counts
  const VectorXd shown = products.whole.diagonal().cwiseProduct(result.typical.cwiseAbs2());
  for (Index i = 0; i < k; ++i) {
    if (!(shown[i] > kShownPart * shown.sum())) result.typical[i] = 0;
  }
  // of friction that the machine does not have no size is typical, nor of a force that meets its
  // joint's axis: one that would just be seen
  for (Index i = 0; i < k && result.typical.isZero(); ++i) {
    if (!(products.left(i, i) > kShownPart * products.whole(i, i))) continue;
    result.typical[i] = 1 / std::sqrt(products.left(i, i));
  }
  result.typical_lambda = result.typical.dot(products.left * result.typical);
  const EffectSizes sizes = trial.law.sizes(scales);
  for (Index i = 0; i < k && result.admissible; ++i) {
    const int p = hypothesis.linear[static_cast<std::size_t>(i)];
    const double value = trial.parameters[p];
    const double slack = 1e-9 * std::abs(result.typical[i]);
    if (value >= sizes.min[p] - slack && value <= sizes.max[p] + slack) continue;
    result.admissible = false;
    result.objection = fmt::format("{} would be {:.3g}",
                                   trial.law.parameters[static_cast<std::size_t>(p)].name, value);
  }
  for (const auto* conditions : {&trial.law.requirements, &trial.law.falsifiers}) {
    for (const EffectCondition& condition : *conditions) {
      if (!result.admissible || condition.slack(trial.parameters, scales) >= 0) continue;
      result.admissible = false;
      result.objection = condition.spelling + " does not hold";
    }
  }
  result.unusual = price_of_unusual(trial, scales, priors);
  result.effect = std::move(trial);
  result.score = std::move(score);
  result.few = squares_of_few(products);
  return result;
}

}  // namespace

double price_of_unusual(const EffectInstance& effect, const EffectScales& scales,
                        const PriorRules& priors) {
  return priors.unusual_value *
         static_cast<double>(effect.law.unusual(effect.parameters, scales).size());
}

Hypothesis hypothesis_of(const EffectInstance& effect, const EffectScales& scales) {
  Hypothesis hypothesis;
  hypothesis.effect = effect;
  const EffectSizes sizes = effect.law.sizes(scales);
  bool times = true;
  for (int p = 0; p < effect.law.size(); ++p) {
    const EffectParameter& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
    double& value = hypothesis.effect.parameters[p];
    const bool known = !std::isnan(value);
    if (!known) value = sizes.typical[p];
    // a part of friction that the machine does not have: no size is typical, none is excluded
    if (parameter.role == EffectRole::kLinear && !std::isfinite(value)) value = 0;
    // a number of poles, slots or teeth: what repeats within a turn of the motor
    hypothesis.fast = hypothesis.fast || (parameter.role == EffectRole::kGiven &&
                                          parameter.unit == "1" && effect.law.reads("q"));
    if (parameter.role == EffectRole::kLinear) {
      hypothesis.linear.push_back(p);
    } else if (parameter.role == EffectRole::kShape ||
               (parameter.role == EffectRole::kScanned && !known)) {
      hypothesis.shapes.push_back(p);
      hypothesis.ordered = hypothesis.ordered || (parameter.role == EffectRole::kScanned &&
                                                  parameter.grid >= kOrders && !known);
      times = times && parameter.role == EffectRole::kScanned && parameter.unit == "s";
    }
  }
  hypothesis.fast = hypothesis.fast || hypothesis.ordered || !effect.law.states.empty();
  hypothesis.held = !hypothesis.linear.empty();
  if (hypothesis.linear.empty()) std::swap(hypothesis.linear, hypothesis.shapes);
  hypothesis.windowed = times && !hypothesis.shapes.empty();
  return hypothesis;
}

EffectInstance with_shapes(const Hypothesis& hypothesis, const VectorXd& shapes) {
  EffectInstance effect = hypothesis.effect;
  for (std::size_t i = 0; i < hypothesis.shapes.size(); ++i) {
    effect.parameters[hypothesis.shapes[i]] = shapes[static_cast<Index>(i)];
  }
  return effect;
}

bool is_position_error(const Hypothesis& hypothesis) {
  return hypothesis.ordered && hypothesis.effect.law.reads("d_qdd");
}

int grid_values(const EffectParameter& scanned) { return std::min(scanned.grid, kScanned); }

std::vector<VectorXd> shape_grid(const Hypothesis& hypothesis, const EffectScales& scales,
                                 int values) {
  const EffectSizes sizes = hypothesis.effect.law.sizes(scales);
  std::vector<VectorXd> grid = {VectorXd(0)};
  for (const int p : hypothesis.shapes) {
    const EffectParameter& parameter =
        hypothesis.effect.law.parameters[static_cast<std::size_t>(p)];
    double low = sizes.min[p], high = sizes.max[p];
    const double typical = low <= high ? std::clamp(sizes.typical[p], low, high) : sizes.typical[p];
    const bool logarithmic = parameter.logarithmic && typical > 0;
    int count = hypothesis.shapes.size() > 2 ? 2 : hypothesis.shapes.size() > 1 ? 3 : values;
    if (parameter.role == EffectRole::kScanned) {
      count = std::max(values, grid_values(parameter));
    } else {
      low = std::max(low, logarithmic ? typical / kWide : typical - std::abs(typical));
      high = std::min(high, logarithmic ? typical * kWide : typical + std::abs(typical));
    }
    if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
      low = high = typical;
      count = 1;
    }
    std::vector<VectorXd> wider;
    for (const VectorXd& before : grid) {
      for (int i = 0; i < count; ++i) {
        const double part = count == 1 ? 0 : static_cast<double>(i) / (count - 1);
        VectorXd shapes(before.size() + 1);
        shapes << before,
            logarithmic ? low * std::pow(high / low, part) : low + part * (high - low);
        wider.push_back(std::move(shapes));
      }
    }
    grid = std::move(wider);
  }
  return grid;
}

JointColumns hypothesis_columns(const EffectRecordings& data, EffectSignals& signals,
                                const EvidenceSystem& system, const Hypothesis& hypothesis,
                                const EffectInstance& trial) {
  std::vector<int> wanted;
  for (const int p : hypothesis.linear) wanted.push_back(1 + p);
  return system.whitened(effect_columns(data, signals, trial, wanted, hypothesis.held));
}

namespace {

/// Equations in which columns are not 0, of those of all joints.
double part_of(const JointColumns& columns, int joints) {
  double count = 0, rows = 0;
  for (const MatrixXd& part : columns.parts) {
    count += static_cast<double>((part.rowwise().squaredNorm().array() > 0).count());
    rows = static_cast<double>(part.rows());
  }
  return count / (rows * joints);
}

}  // namespace

std::vector<TrialScore> try_shapes(const EffectRecordings& data, EffectSignals& signals,
                                   const EvidenceSystem& system, const Hypothesis& hypothesis,
                                   const std::vector<EffectInstance>& trials,
                                   const EffectScales& scales, bool surrogates) {
  const auto k = static_cast<Index>(hypothesis.linear.size());
  // torque that is proportional to them is none where they are 0
  const bool proportional = hypothesis.held && hypothesis.effect.law.proportional;
  std::vector<int> wanted;
  if (!proportional) wanted.push_back(0);
  for (const int p : hypothesis.linear) wanted.push_back(1 + p);
  JointColumns all;
  std::vector<VectorXd> nothing;
  std::vector<double> acting;  // parts of the equations
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const JointColumns plain = effect_columns(data, signals, trials[i], wanted, hypothesis.held);
    nothing.push_back(proportional ? VectorXd::Zero(k).eval()
                                   : null_values(plain, hypothesis, trials[i].parameters));
    acting.push_back(hypothesis.windowed ? part_of(plain, data.joints()) : 1);
    if (i == 0) {
      all.joints = plain.joints;
      for (const MatrixXd& part : plain.parts) {
        all.parts.emplace_back(part.rows(), k * static_cast<Index>(trials.size()));
      }
    }
    for (std::size_t j = 0; j < plain.parts.size(); ++j) {
      all.parts[j].middleCols(static_cast<Index>(i) * k, k) = plain.parts[j].rightCols(k);
    }
  }
  const std::vector<Products> products =
      system.products_of_groups(system.whitened(std::move(all)), k, surrogates);
  std::vector<TrialScore> scores;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    scores.push_back(concluded(hypothesis, trials[i], score_of(products[i], surrogates),
                               products[i], nothing[i], scales, system.priors()));
    scores.back().part = acting[i];
  }
  return scores;
}

TrialScore try_hypothesis(const EffectRecordings& data, EffectSignals& signals,
                          const EvidenceSystem& system, const Hypothesis& hypothesis,
                          const EffectInstance& trial, const EffectScales& scales,
                          bool surrogates) {
  return try_shapes(data, signals, system, hypothesis, {trial}, scales, surrogates).front();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_baselines.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "runtime/effects/effect_constraints.h"
#include "runtime/effects/effect_fit.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/effects/equation_stack.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;

constexpr std::size_t kMostNames = 12;

/// Effects as columns of unit length at right angles to the base model, and what it leaves.
struct Dictionary {
  std::vector<EffectInstance> effects;
  MatrixXd columns;
  VectorXd left;
  double equations = 0;  ///< less the base model's parameters
};

Dictionary dictionary_of(const DiagnosisCase& own, const runtime::EffectRecordings& data) {
  const runtime::EffectFit base = runtime::fit_effects(data, {});
  const VectorXd& beta = base.point.beta;
  const runtime::EquationStack stack(data, runtime::Whitening::by_weights(base.rms.cwiseInverse()));
  runtime::EffectSignals signals(data);
  signals.set_beta(beta);
  signals.set_tangent_beta(beta);
  const runtime::ScaleTable scales(data);
  const runtime::EffectPoint nothing = runtime::at_rest(data, beta, {});
  const MatrixXd all =
      stack.stacked(runtime::linearised(data, signals, nothing, runtime::base_unknowns(nothing)));
  const runtime::Projection projection(all.leftCols(data.model.size()));
  Dictionary dictionary;
  dictionary.left = projection.rest(all.rightCols(1));
  dictionary.equations = static_cast<double>(stack.rows() - projection.rank());
  dictionary.columns.resize(stack.rows(), static_cast<Index>(own.input.hypotheses.size()));
  Index count = 0;
  for (EffectInstance effect : own.input.hypotheses) {
    effect.parameters = effect.law.sizes(scales.of(beta, effect)).typical;
    MatrixXd plain;
    try {
      plain = stack.plain(signals, effect);
    } catch (const std::invalid_argument&) {
      continue;  // the recording lacks what it reads
    }
    const VectorXd column = stack.whitened(plain.leftCols(1));
    const double length = column.norm();
    if (!std::isfinite(length) || !(length > 0)) continue;
    const VectorXd rest = projection.rest(column);
    if (rest.norm() < 1e-4 * length) continue;
    dictionary.columns.col(count++) = rest.normalized();
    dictionary.effects.push_back(std::move(effect));
  }
  dictionary.columns.conservativeResize(Eigen::NoChange, count);
  return dictionary;
}

double criterion(double squares, double names, double equations) {
  return equations * std::log(squares / equations) + names * std::log(equations);
}

/// Coordinate descent on the Gram matrix, from the largest penalty down.
VectorXd lasso(const Dictionary& dictionary) {
  const MatrixXd gram = dictionary.columns.transpose() * dictionary.columns;
  const VectorXd toward = dictionary.columns.transpose() * dictionary.left;
  const double whole = dictionary.left.squaredNorm();
  VectorXd x = VectorXd::Zero(toward.size()), best = x;
  double least = criterion(whole, 0, dictionary.equations);
  double penalty = toward.size() > 0 ? toward.cwiseAbs().maxCoeff() : 0;
  for (int step = 0; step < 40 && penalty > 0; ++step, penalty *= 0.85) {
    VectorXd slope = toward - gram * x;
    for (int sweep = 0; sweep < 300; ++sweep) {
      double moved = 0;
      for (Index k = 0; k < x.size(); ++k) {
        const double open = slope[k] + x[k];
        const double next = std::copysign(std::max(0.0, std::abs(open) - penalty), open);
        if (next == x[k]) continue;
        slope -= (next - x[k]) * gram.col(k);
        moved = std::max(moved, std::abs(next - x[k]));
        x[k] = next;
      }
      if (moved < 1e-6 * penalty) break;
    }
    const double names = static_cast<double>((x.array() != 0).count());
    const double value = criterion((dictionary.left - dictionary.columns * x).squaredNorm(), names,
                                   dictionary.equations);
    if (value < least) {
      least = value;
      best = x;
    }
  }
  return best;
}

std::vector<Index> forward(const Dictionary& dictionary) {
  MatrixXd columns = dictionary.columns;
  VectorXd left = dictionary.left;
  std::vector<Index> chosen;
  while (chosen.size() < kMostNames && columns.cols() > 0) {
    const VectorXd gains = (columns.transpose() * left).cwiseAbs2();
    Index place = 0;
    const double gain = gains.maxCoeff(&place);
    const double before = left.squaredNorm(), after = before - gain;
    const double names = static_cast<double>(chosen.size());
    const double F = gain / (after / (dictionary.equations - names - 1));
    const bool better = criterion(after, names + 1, dictionary.equations) <
                        criterion(before, names, dictionary.equations);
    if (!(F > 3.84) || !better) break;  // F(1, many) at 5 %
    chosen.push_back(place);
    const VectorXd taken = columns.col(place);
    left -= taken * taken.dot(left);
    columns -= taken * (taken.transpose() * columns);
    for (Index k = 0; k < columns.cols(); ++k) {
      const double length = columns.col(k).norm();
      if (length > 1e-3) {
        columns.col(k) /= length;
      } else {
        columns.col(k).setZero();
      }
    }
  }
  return chosen;
}

BaselineAnswer named(const std::string& method, const Dictionary& dictionary,
                     const std::vector<Index>& places) {
  BaselineAnswer answer{method, {}, {}};
  for (const Index place : places) {
    const EffectInstance& effect = dictionary.effects[static_cast<std::size_t>(place)];
    answer.families.push_back(effect.law.family);
    answer.joints.push_back(effect.joint);
  }
  return answer;
}

}  // namespace

std::vector<BaselineAnswer> baseline_answers(const DiagnosisCase& own,
                                             const runtime::EffectRecordings& data) {
  const Dictionary dictionary = dictionary_of(own, data);
  const VectorXd x = lasso(dictionary);
  std::vector<Index> places(static_cast<std::size_t>(x.size()));
  std::iota(places.begin(), places.end(), Index{0});
  std::erase_if(places, [&](Index k) { return x[k] == 0; });
  std::stable_sort(places.begin(), places.end(),
                   [&](Index a, Index b) { return std::abs(x[a]) > std::abs(x[b]); });
  return {named("lasso", dictionary, places), named("forward", dictionary, forward(dictionary))};
}

}  // namespace dyngen::test

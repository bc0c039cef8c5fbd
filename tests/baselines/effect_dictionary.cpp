// SPDX-License-Identifier: MIT
#include "tests/baselines/effect_dictionary.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/effects/effect_constraints.h"
#include "runtime/effects/effect_fit.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/effects/equation_stack.h"

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using runtime::EffectInstance;

EffectDictionary effect_dictionary(const std::vector<EffectInstance>& hypotheses,
                                   const runtime::EffectRecordings& data) {
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
  EffectDictionary dictionary;
  ColumnSet& set = dictionary.set;
  set.left = projection.rest(all.rightCols(1));
  set.equations = static_cast<double>(stack.rows() - projection.rank());
  set.columns.resize(stack.rows(), static_cast<Index>(hypotheses.size()));
  Index count = 0;
  for (EffectInstance effect : hypotheses) {
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
    set.columns.col(count++) = rest.normalized();
    dictionary.effects.push_back(std::move(effect));
  }
  set.columns.conservativeResize(Eigen::NoChange, count);
  return dictionary;
}

}  // namespace dyngen::test

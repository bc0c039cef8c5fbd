// SPDX-License-Identifier: MIT
#include "tests/blind/reach/reach.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/diagnosis.h"
#include "runtime/diagnosis/scans/repeat_scan.h"
#include "tests/blind/dynid/competed.h"

namespace blind {
namespace {

using namespace dyngen::runtime;
using Eigen::Index;

/// What two sets of the same equations differ in, as one column.
JointColumns difference(const EffectRecordings& a, const EffectRecordings& b) {
  JointColumns column;
  for (int j = 0; j < a.joints(); ++j) {
    Eigen::MatrixXd part(a.equations(), 1);
    Index row = 0;
    for (std::size_t r = 0; r < a.runs.size(); ++r) {
      const Index rows = a.runs[r].rows.tau.rows();
      part.middleRows(row, rows) = (a.runs[r].rows.tau.col(j) - b.runs[r].rows.tau.col(j))
                                       .cwiseProduct(a.runs[r].rows.counted.col(j));
      row += rows;
    }
    column.joints.push_back(j);
    column.parts.push_back(std::move(part));
  }
  return column;
}

EffectPoint model_of(const EffectRecordings& data) {
  EffectFitOptions options;
  options.most_rounds = 2;
  return fit_effects(data, {}, options).point;
}

/// Squares that the model leaves of columns.
Products beside_model(const EvidenceSystem& system, const JointColumns& column) {
  return system.products(system.whitened(column), false);
}

/// Squares of a column that are in what comes back in every period, as the diagnosis looks for it.
double repeating_part(const EffectRecordings& data, const EvidenceSystem& system,
                      const JointColumns& column, const std::vector<double>& repeats) {
  std::vector<JointColumns> all = {column};
  for (int j = 0; j < data.joints(); ++j) {
    all.push_back(harmonic_columns(data, j, repeats, kWidestRepeatBand));
  }
  Products products = beside_model(system, side_by_side(all));
  const Index lines = products.left.cols() - 1;
  products.rest = products.left.col(0).tail(lines).eval();
  products.left = products.left.bottomRightCorner(lines, lines).eval();
  products.whole = products.whole.bottomRightCorner(lines, lines).eval();
  return score_of(products, false).delta_chi2;
}

}  // namespace

Reach reach_of(const DiagnosisInput& input, std::vector<MotionSource> without) {
  const DiagnosisOptions defaults;
  Search search(input, defaults.decimation);
  compete_by_default(search);
  const Division parts{std::move(without), search.parts().heldout};
  const EquationSets bare = equation_sets_of(input, parts, search.seen());
  const EquationSets& sets = search.sets();
  const JointColumns column = difference(sets.evidence(), bare.evidence());
  const EffectPoint model = model_of(sets.train), truth = model_of(bare.train);
  const std::vector<double> repeats = repeats_of(sets.train);
  // the model alone, with the noise that residuals at a point show
  EffectSignals signals(sets.evidence());
  const auto system_with = [&](const EffectRecordings& data, const EffectPoint& point) {
    const TorqueNoiseModel noise =
        torque_noise_model(data, residuals_of(data, point), repeats, true);
    return system_at(sets.evidence(), signals, model, {}, noise, {});
  };
  Reach reach;
  reach.lambda = beside_model(system_with(bare.train, truth), column).left(0, 0);
  const EvidenceSystem system = system_with(sets.train, model);
  const Products seen = beside_model(system, column);
  reach.seen = seen.left(0, 0);
  reach.found = score_of(seen, false).delta_chi2;
  reach.repeating = repeating_part(sets.evidence(), system, column, repeats);
  const double surprise = search.result().last.threshold(defaults.false_alarm);
  reach.needed =
      quantile(complement(boost::math::chi_squared_distribution<>(1), std::exp(-surprise)));
  return reach;
}

}  // namespace blind

// SPDX-License-Identifier: MIT
#include "tests/blind/reach/reach.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/diagnosis.h"

namespace blind {
namespace {

using namespace dyngen::runtime;
using Eigen::Index;

/// What two views of the same equations differ in, as one column.
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

/// One column beside the model alone.
struct Alone {
  double squares = 0;  ///< what the column explains of the recordings
  double lambda = 0;   ///< what the model leaves of itself
};
Alone beside_model(const EffectRecordings& data, const EffectPoint& model,
                   const TorqueNoiseModel& noise, const JointColumns& column) {
  EffectSignals signals(data);
  const EvidenceSystem system = system_at(data, signals, model, {}, noise, {});
  const Products products = system.products(system.whitened(column), false);
  return {score_of(products, false).squares, products.left(0, 0)};
}

}  // namespace

Reach reach_of(const DiagnosisInput& input, std::vector<MotionSource> without) {
  const DiagnosisOptions defaults;
  Search search(input, defaults.decimation);
  CompetitionOptions options;
  options.false_alarm = defaults.false_alarm;
  options.most_winners = defaults.most_findings;
  options.seed = defaults.seed;
  search.compete(options, {});
  const Division parts{std::move(without), search.parts().heldout};
  const Views bare = views_of(input, parts, search.seen());
  const Views& views = search.views();
  const JointColumns column = difference(views.evidence(), bare.evidence());
  const EffectPoint model = model_of(views.train), truth = model_of(bare.train);
  const std::vector<double> repeats = repeats_of(views.train);
  const auto noise_of = [&](const EffectRecordings& data, const EffectPoint& point) {
    return torque_noise_model(data, residuals_of(data, point), repeats, true);
  };
  Reach reach;
  const TorqueNoiseModel true_noise = noise_of(bare.train, truth);
  reach.lambda = beside_model(views.evidence(), model, true_noise, column).lambda;
  const Alone seen = beside_model(views.evidence(), model, noise_of(views.train, model), column);
  reach.seen = seen.lambda;
  reach.found = seen.squares;
  const double surprise = search.result().last.threshold(defaults.false_alarm);
  reach.needed =
      quantile(complement(boost::math::chi_squared_distribution<>(1), std::exp(-surprise)));
  return reach;
}

}  // namespace blind

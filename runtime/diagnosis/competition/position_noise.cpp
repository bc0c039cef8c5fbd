// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/position_noise.h"

namespace dyngen::runtime {

double PositionNoise::squares_without(const Products& products, const Columns& columns,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const CompetitionResult& result,
                                      EvidenceSystem::Options options) const {
  options.surrogates = 0;
  Products corrected = products;
  // products are linear in the noise and of second order in it: the sum over both signs has no
  // linear part
  corrected.rest *= 2;
  for (const double sign : {1.0, -1.0}) {
    const std::optional<EffectRecordings> data = with_more_ ? with_more_(sign) : std::nullopt;
    if (!data) return score_of(products, false).squares;
    EffectSignals signals(*data);
    const EvidenceSystem system =
        system_beside(*data, signals, hypotheses, result, result.fit.point, result.noise, options);
    corrected.rest -= system.products(system.whitened(columns(*data, signals)), false).rest / 2;
  }
  return score_of(corrected, false).squares;
}

}  // namespace dyngen::runtime

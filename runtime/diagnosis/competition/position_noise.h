// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

/// What noise of the positions makes of columns where no other period of the motion tells it from
/// physics: it is in what is left, as noise of accelerations, and in columns of the same motion,
/// and their product is not 0 in the mean. An elasticity of the gear with a negative constant comes
/// of it, and lateness. As much noise again, and as much taken away, make the same product once
/// more: half of what both change is what there was (the idea of simulation and extrapolation,
/// Cook and Stefanski, J. Am. Stat. Assoc. 89, 1994). To second order in the noise: of columns
/// that the model absorbs but for a part in which noise is a third, a third of it is seen. Noise
/// that a controller makes torque of is not simulated.
class PositionNoise {
 public:
  /// The fitted recordings with noise added (1) or taken away (-1); none where that cannot be.
  using WithMore = std::function<std::optional<EffectRecordings>(double sign)>;
  /// Columns of an effect or a structure, not whitened.
  using Columns = std::function<JointColumns(const EffectRecordings&, EffectSignals&)>;

  explicit PositionNoise(WithMore with_more) : with_more_(std::move(with_more)) {}

  /// Squares that columns explain beside the model with all that was found, less what noise of the
  /// positions makes of them. @param products  of the columns in the recordings as they are
  [[nodiscard]] double squares_without(const Products& products, const Columns& columns,
                                       const std::vector<Hypothesis>& hypotheses,
                                       const CompetitionResult& result,
                                       EvidenceSystem::Options options) const;

 private:
  WithMore with_more_;
};

}  // namespace dyngen::runtime

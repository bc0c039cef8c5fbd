// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/diagnosis/scans/hypothesis.h"
#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// What is left beside columns, where they are and elsewhere.
///
/// Evidence takes what the model leaves for noise of one variance. Where a joint all but sticks it
/// is not: friction there is of any size and the same in every period. Columns that are large just
/// there explain hundreds of squares of it by chance, and leave thousands.
struct SandwichTest {
  double squares = 0;  ///< that the columns explain: f'f
  /// Sum over stretches of (f'(r - f))^2: as f'f, where r - f is the noise that it is taken for.
  double here = 0;
  /// The same with r - f of other times, mean: another effect that is left is there as well.
  double elsewhere = 0;
  /// What is left is far larger where the columns are than elsewhere.
  [[nodiscard]] bool refutes() const;
};

/// @param whitened      columns, as EvidenceSystem::whitened() gives them
/// @param coefficients  (columns) at which they explain most
/// Source: the sandwich of White, Econometrica 48, 1980, over stretches of time.
SandwichTest sandwich_test(const EvidenceSystem& system, const JointColumns& whitened,
                           const Eigen::VectorXd& coefficients);

/// The same of the linear parameters of an effect at its shapes. Never of an event: where it is
/// large nothing else tells what the noise is.
bool scatter_refutes(const EffectRecordings& data, EffectSignals& signals,
                     const EvidenceSystem& system, const Hypothesis& hypothesis,
                     const EffectInstance& trial);

}  // namespace dyngen::runtime

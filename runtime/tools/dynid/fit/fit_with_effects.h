// SPDX-License-Identifier: MIT
#pragma once

#include "gen/tool/progress_line.h"
#include "runtime/tools/dynid/fit/fit_report.h"
#include "runtime/tools/dynid/recordings/loading.h"

namespace dyngen::runtime {

/// What dynid fit is asked to do with a robot file that has rows `effect`.
struct EffectTask {
  EffectCatalogue catalogue;
  std::vector<EffectInstance> effects;  ///< of the robot file's rows; empty: none

  /// @throws ModelError  positioned, if a row or a file of --effects is wrong
  static EffectTask of(const DescribedRobot& robot, const ToolOptions& options);

  /// Options with which recordings are read: periods are not averaged where an effect reads the
  /// time or the temperature, and no file is gone through in pieces.
  [[nodiscard]] ToolOptions reading(ToolOptions options) const;
};

/// @throws std::invalid_argument  for what cannot be done with effects, in a sentence
void refuse_with_effects(const ToolOptions& options, bool file_by_file, bool summaries);

/// Fits the model and its effects, and fills the report: the method's fit, the equations that are
/// left for the model, what was held out.
void fit_with_effects(const EffectTask& task, const ToolOptions& options,
                      const std::vector<MotionSource>& train,
                      const std::vector<MotionSource>& heldout, ProgressLine& progress,
                      FitReport& report);

/// Equations of one recording with the file's effects taken off; their states begin as
/// first_states() says.
/// @param beta  (nb)
/// @throws ModelError  if an effect has a parameter without a number that has to be estimated
RowSource rows_beside_effects(const EffectTask& task, const DescribedRobot& robot,
                              const ToolOptions& options, const MotionSource& source,
                              const Eigen::VectorXd& beta);

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/identification/motion_source.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"
#include "runtime/tools/dynid/diagnose/forward_comparison.h"
#include "runtime/tools/dynid/options/loop_settings.h"

namespace dyngen::runtime {

/// What a robot is asked to do while it is simulated, and what the real one did.
struct ForwardTask {
  LoopSettings loop;
  RobotSource controller_model;  ///< of the controller; empty: the model alone, fitted
  std::vector<MotionSource> recordings;  ///< held out, with the torque of all effects
  /// What was commanded in each of them; empty: the motion that was recorded.
  std::vector<Trajectory> commanded;
};

/// Simulates the fitted model alone and with the findings, both under the same controller, whose
/// gains are tuned on the latter, and compares positions and torques with the recordings. The
/// first period of the loop's natural frequency is left out: the state of the real controller at
/// the start of a recording is not known.
/// @param report  of `robot`; not of residual_only
/// @param tell    told the share that is done, 0 .. 1; may be empty
/// @throws std::invalid_argument  if a commanded motion has another number of joints or does not
///                                cover its recording; ModelError of the controller's file
/// Source: docs/reference/diagnosis.md, "Simulation before and after".
ForwardComparison compare_forward(const DiagnosisReport& report, const DescribedRobot& robot,
                                  const EffectCatalogue& catalogue, const ForwardTask& task,
                                  const std::function<void(double)>& tell = {});

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/tools/dynid/options/loop_settings.h"

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// What dynid diagnose is asked for besides a robot, recordings, --holdout, --effects, --json and
/// -o.
struct DiagnoseOptions {
  std::vector<std::string> reference;  ///< recordings of the robot before it changed
  DiagnosisOptions diagnosis;
  std::string rules;  ///< file of rules; empty: as they are
  /// Under which held-out motions are simulated before and after; no controller: they are not.
  LoopSettings loop;
  std::string controller_model;        ///< robot file of the controller; empty: the fitted model
  std::vector<std::string> commanded;  ///< motions that --holdout were asked for, in their order
};

void add_diagnose_options(CLI::App& command, DiagnoseOptions& options);

}  // namespace dyngen::runtime

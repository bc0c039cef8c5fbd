// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/tools/dynid/loop_settings.h"

namespace CLI {
class App;
}

namespace dyngen::runtime {

/// What dynid diagnose is asked for besides a robot, recordings, --holdout, --effects, --json and
/// -o.
struct DiagnoseOptions {
  std::vector<std::string> reference;  ///< recordings of the robot before it changed
  std::string report;                  ///< the page; empty: none
  std::string figures;                 ///< folder of its figures; empty: none
  DiagnosisOptions diagnosis;
  /// Under which held-out motions are simulated before and after; no controller: they are not.
  LoopSettings loop;
  std::string controller_model;        ///< robot file of the controller; empty: the fitted model
  std::vector<std::string> commanded;  ///< motions that --holdout were asked for, in their order
  std::string command;                 ///< as it was called, for the report
};

void add_diagnose_options(CLI::App& command, DiagnoseOptions& options);

/// The words of a call as a shell would need them, the program's path left out.
std::string command_text(int argc, const char* const* argv);

}  // namespace dyngen::runtime

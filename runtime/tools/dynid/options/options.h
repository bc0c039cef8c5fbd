// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/robot_input/robot_source.h"
#include "runtime/identification/fit.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/tools/dynid/options/diagnose_options.h"
#include "runtime/tools/dynid/options/effects_options.h"
#include "runtime/tools/dynid/options/excite_options.h"
#include "runtime/tools/dynid/options/import_options.h"
#include "runtime/tools/dynid/options/page_options.h"
#include "runtime/tools/dynid/options/simulate_options.h"

namespace dyngen::runtime {

enum class Command {
  kFit,
  kCheck,
  kAccumulate,
  kMerge,
  kSimulate,
  kExcite,
  kAtlas,
  kEffects,
  kDiagnose,
  kImport
};

/// What dynid atlas is asked for besides a robot, recordings and --effects.
struct AtlasOptions {
  std::string trajectory;     ///< instead of recordings; empty: none
  std::vector<double> noise;  ///< N m or N of each joint; empty: from the residual, or 1 %
  std::string picture;        ///< .svg or .png; empty: none
};

/// The command line of dynid.
struct ToolOptions {
  Command command = Command::kFit;
  RobotSource robot;
  std::vector<std::string> recordings;  ///< .csv, .csv.gz; of fit also .qr; of merge .qr
  std::string map;                      ///< that makes recordings of logs; empty: none
  std::string list;                     ///< a file with one more of them per line; empty: none
  std::vector<std::string> heldout;
  double heldout_part = 0;           ///< the last part of every recording is held out: 0 .. 0.9
  std::string output;                ///< empty: none
  std::string description;           ///< URDF or MJCF that -o writes numbers into; empty: the robot
  std::string json;                  ///< empty: none
  std::string tracked;               ///< the commanded motion, for instruments; empty: none
  std::string robot_name;            ///< of accumulate: whose recordings these are
  std::vector<std::string> effects;  ///< folders of effect files besides the program's own
  PageOptions page;                  ///< of fit, excite, atlas and diagnose
  std::vector<std::string> hold;     ///< numbers of the file that are not estimated; empty: none
  bool as_recorded = false;          ///< recordings that cannot be meant are fitted all the same
  bool own_friction = false;         ///< robots share inertia, each has its own friction and offset
  bool consistent = false;
  bool every_method = false;
  MotionOptions motion;
  RowOptions rows;
  FitOptions fit;
  SimulateOptions simulate;
  ExciteOptions excite;
  AtlasOptions atlas;
  DiagnoseOptions diagnose;
  EffectsOptions catalogue;  ///< of dynid effects
  ImportOptions import;      ///< of dynid import
};

/// Reads the command line. @return what to do, or the exit code if there is nothing left to do
///         (0 after --help or --version, 2 after a message about wrong usage)
struct ParsedOptions {
  ToolOptions options;
  int exit_code = -1;  ///< -1: go on
};
ParsedOptions parse_options(int argc, const char* const* argv);

/// The same with the recordings that the list names; '#' begins a comment line.
/// @throws std::invalid_argument  if the list cannot be read or there is no recording
ToolOptions with_list(ToolOptions options);

}  // namespace dyngen::runtime

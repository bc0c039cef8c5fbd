// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/process/process_group.h"

namespace dyngen::runtime {

/// Exit codes of dynid.
inline constexpr int kDone = 0, kInputWrong = 1, kUsage = 2, kCannotAnswer = 3, kOurBug = 70;

/// The commands; each prints its result and returns the exit code.
/// @throws ModelError, RecordingError, SummaryFileError, OutputError, std::invalid_argument
/// run_fit: in process 0 of the group; the others serve().
int run_fit(const ToolOptions& options, ProcessGroup& group);
int run_check(const ToolOptions& options);
int run_accumulate(const ToolOptions& options);
int run_atlas(const ToolOptions& options);
int run_diagnose(const ToolOptions& options);
int run_merge(const ToolOptions& options);
int run_simulate(const ToolOptions& options);
/// Prints what effects there are, or what one of them says; writes the document that is made of
/// them all. @throws FigureError too
int run_effects(const EffectsOptions& options);
int run_excite(const ToolOptions& options);
/// Makes a recording of logs, says what is in them, or writes a map. @throws ImportError too
int run_import(const ToolOptions& options);

}  // namespace dyngen::runtime

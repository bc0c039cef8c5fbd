// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/tools/dynid/options.h"

namespace dyngen::runtime {

/// Exit codes of dynid.
inline constexpr int kDone = 0, kInputWrong = 1, kUsage = 2, kCannotAnswer = 3, kOurBug = 70;

/// The commands; each prints its result and returns the exit code.
/// @throws ModelError, RecordingError, SummaryFileError, OutputError, std::invalid_argument
int run_fit(const ToolOptions& options);
int run_check(const ToolOptions& options);
int run_accumulate(const ToolOptions& options);
int run_merge(const ToolOptions& options);

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include "gen/diagnostic/diagnostic.h"
#include "gen/tool/fitted_lines.h"
#include "gen/tool/output_files.h"
#include "runtime/estimation/matrix_products.h"
#include "runtime/identification/summary_file.h"
#include "runtime/plausibility/remark.h"
#include "runtime/plots/figure.h"
#include "runtime/recordings/notice.h"
#include "runtime/tools/dynid/fit/file_summaries.h"
#include "runtime/tools/dynid/input/output_paths.h"
#include "runtime/tools/dynid/input/robot_warnings.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/options/parts.h"
#include "runtime/tools/dynid/process/memory.h"
#include "runtime/tools/dynid/process/process_group.h"
#include "runtime/tools/dynid/robot/identified_description.h"

namespace dyngen::runtime {
namespace {

int run(const ToolOptions& options, ProcessGroup& group) {
  switch (options.command) {
    case Command::kFit:
      return run_fit(options, group);
    case Command::kCheck:
      return run_check(options);
    case Command::kAccumulate:
      return run_accumulate(options);
    case Command::kMerge:
      return run_merge(options);
    case Command::kSimulate:
      return run_simulate(options);
    case Command::kExcite:
      return run_excite(options);
    case Command::kAtlas:
      return run_atlas(options);
    case Command::kDiagnose:
      return run_diagnose(options);
    case Command::kImport:
      return run_import(options);
    case Command::kEffects:
      return run_effects(options.catalogue);
  }
  return kUsage;
}

/// By hand, since a process other than 0 has no std::cerr.
int our_bug(const std::exception& error, const ToolOptions& options) {
  const std::string text = std::string("dynid: internal error: ") + error.what() +
                           "\nThis is a bug of dynid. Please report it with the file " +
                           options.robot.path + ".\n";
  std::fputs(text.c_str(), stderr);
  return kOurBug;
}

int guarded_run(const ToolOptions& parsed, ProcessGroup& group) {
  try {
    const ToolOptions options = with_list(parsed);
    const std::string missing = missing_parts(options, group.size());
    if (!missing.empty()) {
      std::cerr << missing;
      return kUsage;
    }
    const std::string collision = output_collision(options);
    if (!collision.empty()) {
      std::cerr << "dynid: " << collision << "\n";
      return kUsage;
    }
    std::cerr << robot_warnings(options);
    return run(options, group);
  } catch (const ModelError& error) {
    std::cerr << error.what();
    return kInputWrong;
  } catch (const RecordingError& error) {
    std::cerr << error.what() << "\n";
    return kInputWrong;
  } catch (const SummaryFileError& error) {
    std::cerr << error.what() << "\n";
    return kInputWrong;
  } catch (const OutputError& error) {
    std::cerr << error.what() << "\n";
    return kInputWrong;
  } catch (const FigureError& error) {
    std::cerr << "dynid: error: " << error.what() << "\n";
    return kInputWrong;
  } catch (const TooLittleDataError& error) {
    std::cerr << error.what() << "\ndynid: these recordings hold too little for an answer\n";
    return kCannotAnswer;
  } catch (const ImplausibleError& error) {
    std::cerr << error.what() << "\n";
    return kCannotAnswer;
  } catch (const NoBodiesError& error) {
    std::cerr << "dynid: " << error.what() << "\n";
    return kCannotAnswer;
  } catch (const std::invalid_argument& error) {
    std::cerr << "dynid: error: " << error.what() << "\n";
    return kInputWrong;
  } catch (const std::exception& error) {
    return our_bug(error, parsed);
  }
}

int guarded_serve(const ToolOptions& options, ProcessGroup& group) {
  try {
    return serve(options, group);
  } catch (const std::exception& error) {
    return our_bug(error, options);
  }
}

int main_of_group(int argc, const char* const* argv, ProcessGroup& group) {
  // The command line is the same for all; only process 0 speaks.
  if (group.rank() > 0) {
    std::cout.rdbuf(nullptr);
    std::cerr.rdbuf(nullptr);
  }
  std::optional<FittedLines> out, errors;
  if (group.rank() == 0) {
    out.emplace(std::cout);
    errors.emplace(std::cerr);
  }
  const ParsedOptions parsed = parse_options(argc, argv);
  if (parsed.exit_code >= 0) return parsed.exit_code;
  const bool serves = group.connected() && group.rank() > 0;
  const int code =
      serves ? guarded_serve(parsed.options, group) : guarded_run(parsed.options, group);
  out.reset();
  errors.reset();
  std::cout << std::flush;
  // where the others are is not known
  if (code == kOurBug) group.abort(code);
  if (group.connected() && !serves) dismiss(group, code);
  return code;
}

}  // namespace
}  // namespace dyngen::runtime

int main(int argc, char** argv) {
  dyngen::runtime::keep_memory();
  dyngen::runtime::multiply_on_own_thread();  // a diagnosis has threads of its own
  dyngen::runtime::ProcessGroup group;
  const int code = dyngen::runtime::main_of_group(argc, argv, group);
  group.finish();
  return code;
}

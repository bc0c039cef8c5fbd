// SPDX-License-Identifier: MIT
#include <exception>
#include <iostream>
#include <stdexcept>

#include "gen/diagnostic/diagnostic.h"
#include "gen/tool/output_files.h"
#include "runtime/identification/summary_file.h"
#include "runtime/recordings/notice.h"
#include "runtime/tools/dynid/commands.h"
#include "runtime/tools/dynid/options.h"

namespace dyngen::runtime {
namespace {

int run(const ToolOptions& options) {
  switch (options.command) {
    case Command::kFit:
      return run_fit(options);
    case Command::kCheck:
      return run_check(options);
    case Command::kAccumulate:
      return run_accumulate(options);
    case Command::kMerge:
      return run_merge(options);
  }
  return kUsage;
}

int guarded_main(int argc, const char* const* argv) {
  const ParsedOptions parsed = parse_options(argc, argv);
  if (parsed.exit_code >= 0) return parsed.exit_code;
  try {
    return run(parsed.options);
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
  } catch (const std::invalid_argument& error) {
    std::cerr << "dynid: error: " << error.what() << "\n";
    return kInputWrong;
  } catch (const std::exception& error) {
    std::cerr << "dynid: internal error: " << error.what()
              << "\nThis is a bug of dynid. Please report it with the file " << parsed.options.robot
              << ".\n";
    return kOurBug;
  }
}

}  // namespace
}  // namespace dyngen::runtime

int main(int argc, char** argv) { return dyngen::runtime::guarded_main(argc, argv); }

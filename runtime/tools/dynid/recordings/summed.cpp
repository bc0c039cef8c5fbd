// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/recordings/summed.h"

#include <iostream>

#include "runtime/tools/dynid/recordings/inputs.h"
#include "runtime/tools/dynid/recordings/judged.h"
#include "runtime/tools/dynid/recordings/loading.h"

namespace dyngen::runtime {

bool add_recordings_to(RecordingSummary& sum, const DescribedRobot& robot,
                       const std::vector<std::string>& paths, const ToolOptions& options,
                       ProgressLine& progress) {
  bool any = false;
  for (const RecordingInput& input : recording_inputs(paths, options)) {
    try {
      LoadedRecordings one = load_recordings(std::vector{input}, options, false, progress);
      LoadedRecordings none;
      settle_cutoff(&robot.linear, one, none, options, progress);
      judge_recordings(robot, one.sources, options, progress);
      merge(sum, summarise_together(robot.linear, one, options, progress));
      any = true;
    } catch (const TooLittleDataError& error) {
      progress.clear();
      std::cerr << error.what() << "; it adds nothing\n";
    }
  }
  return any;
}

}  // namespace dyngen::runtime

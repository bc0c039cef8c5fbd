// SPDX-License-Identifier: MIT
#include "tests/blind/dynid/case_input.h"

#include <limits>

#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"

namespace blind {

namespace runtime = dyngen::runtime;

std::vector<runtime::MotionSource> read_recordings(const std::vector<std::string>& paths) {
  runtime::MotionOptions options;
  options.stream_above = std::numeric_limits<std::size_t>::max();
  options.average_periods = false;
  std::vector<runtime::MotionSource> sources;
  for (const std::string& path : paths) sources.push_back(runtime::motion_of_file(path, options));
  return sources;
}

runtime::DiagnosisInput case_input(const std::string& robot, const std::vector<std::string>& train,
                                   const std::vector<std::string>& heldout) {
  const runtime::DescribedRobot described =
      runtime::describe_robot(robot, runtime::OpenParameters::kAbsentRows);
  runtime::DiagnosisInput input;
  input.model = described.linear;
  input.robot = runtime::effect_robot(described);
  input.train = read_recordings(train);
  input.heldout = read_recordings(heldout);
  std::vector<runtime::MotionSource> all = input.train;
  all.insert(all.end(), input.heldout.begin(), input.heldout.end());
  input.hypotheses = runtime::competing_effects(described, runtime::effect_catalogue({}), all);
  return input;
}

}  // namespace blind

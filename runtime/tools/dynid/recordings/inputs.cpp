// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/recordings/inputs.h"

#include <fmt/format.h>

#include <memory>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "runtime/import/map_file.h"

namespace dyngen::runtime {

ImportedRobot imported_robot(const RobotSource& source) {
  ImportedRobot robot;
  if (source.empty()) return robot;
  const RobotModel model = build_model(read_robot_file(source));
  for (const JointModel& joint : model.joints) {
    if (joint.type == JointType::kFixed) continue;
    ++robot.joints;
    if (!joint.name.empty()) robot.names.push_back(joint.name);
  }
  if (robot.names.size() != static_cast<std::size_t>(robot.joints)) robot.names.clear();
  return robot;
}

std::vector<RecordingInput> recording_inputs(const std::vector<std::string>& paths,
                                             const ToolOptions& options) {
  std::vector<RecordingInput> inputs;
  if (options.map.empty()) {
    for (const std::string& path : paths) inputs.push_back(recording_file(path));
    return inputs;
  }
  if (paths.empty()) return inputs;
  const auto map = std::make_shared<const ImportMap>(read_import_map(options.map));
  const ImportedRobot robot = imported_robot(options.robot);
  for (const LogGroup& group : log_groups(*map, paths)) {
    inputs.push_back(imported_recording(map, group, robot));
  }
  return inputs;
}

RecordingInput recording_input(const std::string& path, const ToolOptions& options) {
  const std::vector<RecordingInput> inputs = recording_inputs({path}, options);
  if (inputs.size() == 1) return inputs.front();
  throw ImportError(fmt::format("{}: error: found {} recordings in it by --map, expected one here",
                                path, inputs.size()));
}

}  // namespace dyngen::runtime

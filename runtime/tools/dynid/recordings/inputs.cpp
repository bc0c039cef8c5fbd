// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/recordings/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
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
    robot.kinds.push_back(joint.type == JointType::kPrismatic ? MotionKind::kLength
                                                              : MotionKind::kAngle);
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

namespace {

/// Whether an input opens; else what it says.
std::string fault_of_opening(const RecordingInput& input) {
  ReadOptions options;
  options.torque_required = false;
  try {
    input.open(options);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

RecordingInput motion_input(const std::string& path, const std::string& map,
                            const RobotSource& robot, std::vector<Notice>& notices) {
  RecordingInput plain = recording_file(path);
  if (map.empty()) return plain;
  const auto own =
      std::make_shared<const ImportMap>(map_of_motion(read_import_map(map, MapUse::kMotion)));
  const std::vector<LogGroup> groups = log_groups(*own, {path});
  if (groups.size() != 1) {
    throw ImportError(fmt::format("{}: error: found {} motions in it by --map, expected one here",
                                  path, groups.size()));
  }
  RecordingInput mapped = imported_recording(own, groups.front(), imported_robot(robot));
  if (!plain.reopens) return mapped;
  const std::string fault = fault_of_opening(mapped);
  const bool stands = fault_of_opening(plain).empty();
  if (!fault.empty()) {
    if (!stands) throw ImportError(fault);
    notices.push_back({path, 0, 0,
                       fmt::format("the columns of {} are not in it, and it is a trajectory as it "
                                   "stands: it is read without the map",
                                   map)});
    return plain;
  }
  if (stands) {
    notices.push_back({path, 0, 0,
                       fmt::format("it could be read as it stands; it has the columns of {} and is "
                                   "read by the map",
                                   map)});
  }
  return mapped;
}

namespace {

bool same_content(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_regular_file(a, error) || !fs::is_regular_file(b, error)) return a == b;
  if (fs::equivalent(a, b, error)) return true;
  if (fs::file_size(a, error) != fs::file_size(b, error)) return false;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  return std::equal(std::istreambuf_iterator<char>(first), std::istreambuf_iterator<char>(),
                    std::istreambuf_iterator<char>(second));
}

}  // namespace

std::vector<std::string> repeated_recordings(const ToolOptions& options) {
  std::vector<std::string> sentences;
  const std::vector<std::string>& fitted = options.recordings;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!same_content(fitted[i], fitted[k])) continue;
      sentences.push_back(fmt::format(
          "{} is the recording {} again: its equations count twice, and standard deviations are "
          "too small",
          fitted[i], fitted[k]));
      break;
    }
    for (const std::string& heldout : options.heldout) {
      if (!same_content(fitted[i], heldout)) continue;
      sentences.push_back(
          fmt::format("{} is held out and fitted: what is held out proves nothing "
                      "here ('--holdout-part' divides a recording)",
                      heldout));
    }
  }
  std::vector<std::string> later = fitted;
  later.insert(later.end(), options.heldout.begin(), options.heldout.end());
  for (const std::string& reference : options.diagnose.reference) {
    const bool both = std::any_of(later.begin(), later.end(), [&](const std::string& other) {
      return same_content(reference, other);
    });
    if (!both) continue;
    sentences.push_back(
        fmt::format("{} is on both sides of the comparison: in it nothing changes, and what "
                    "changed elsewhere looks smaller and more certain",
                    reference));
  }
  return sentences;
}

RecordingInput recording_input(const std::string& path, const ToolOptions& options) {
  const std::vector<RecordingInput> inputs = recording_inputs({path}, options);
  if (inputs.size() == 1) return inputs.front();
  throw ImportError(fmt::format("{}: error: found {} recordings in it by --map, expected one here",
                                path, inputs.size()));
}

}  // namespace dyngen::runtime

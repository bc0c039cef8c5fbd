// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/import/imported_rows.h"
#include "runtime/recordings/reader.h"
#include "runtime/tools/dynid/options/options.h"

namespace dyngen::runtime {

/// What a log's map may ask of the robot: how many joints move, and their names.
/// @param path  of the robot file; empty: nothing is known  @throws ModelError
ImportedRobot imported_robot(const RobotSource& source);

/// Recordings of the command line, as they stand or through --map. Every command opens them here.
/// @throws ImportError, ModelError
std::vector<RecordingInput> recording_inputs(const std::vector<std::string>& paths,
                                             const ToolOptions& options);

/// A motion that was commanded or is planned, as it stands or through --map. A trajectory that does
/// not have the map's columns is read as it stands.
/// @param map  of --map; empty: none   @param notices  which of both, where both could be meant
/// @throws ImportError, ModelError, RecordingError
RecordingInput motion_input(const std::string& path, const std::string& map,
                            const RobotSource& robot, std::vector<Notice>& notices);

/// Recordings that the command line names twice, by their content: sentences. Equations that count
/// twice make standard deviations too small, held-out residuals of what was fitted prove nothing,
/// and a file on both sides of a comparison shows no change.
std::vector<std::string> repeated_recordings(const ToolOptions& options);

/// The same of a path that is one recording: a file, or a folder of files that a map joins.
RecordingInput recording_input(const std::string& path, const ToolOptions& options);

}  // namespace dyngen::runtime

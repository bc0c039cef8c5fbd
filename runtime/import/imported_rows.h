// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/import/column_lookup.h"
#include "runtime/import/import_map.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/sample_rows.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {

/// What is known of the robot before its log is read.
struct ImportedRobot {
  int joints = 0;                   ///< 0: not known
  std::vector<std::string> names;   ///< of its joints; may be empty
  std::vector<MotionKind> kinds{};  ///< of its joints: angles or lengths; empty: not known
};

/// Samples at the joints, made of logs by a map, in constant memory.
/// @throws ImportError  what the map asks for is not in the logs; RecordingError
std::unique_ptr<SampleSource> imported_rows(const ImportMap& map, std::vector<OpenedLog> logs,
                                            const ImportedRobot& robot, NoticeLog& log);

/// Files that make one recording: one for each of ImportMap::files, in their order, or one.
struct LogGroup {
  std::vector<std::string> paths;
};

/// Sorts the files of the command line into recordings. Without ImportMap::files each is one.
/// Else each pattern must match as many of them, and the i-th of each pattern belong together; a
/// folder stands for the files in it that match.
/// @throws ImportError  a file matches no pattern or several, or a pattern matches too few
std::vector<LogGroup> log_groups(const ImportMap& map, const std::vector<std::string>& paths);

/// Opens the logs of a group. @throws RecordingError
std::vector<OpenedLog> open_logs(const ImportMap& map, const LogGroup& group);

/// What a map makes of logs, as a recording that can be opened again and again.
RecordingInput imported_recording(std::shared_ptr<const ImportMap> map, const LogGroup& group,
                                  const ImportedRobot& robot);

}  // namespace dyngen::runtime

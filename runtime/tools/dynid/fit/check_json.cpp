// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/check_report.h"
#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {

std::string check_json(const CheckReport& report) {
  Json files = Json::array();
  for (const CheckReport::Recording& recording : report.recordings) {
    const RecordingLine& line = recording.line;
    const Residual& residual = recording.residual;
    Json repairs = Json::array(), two_encoders = Json::array();
    for (const int joint : recording.two_encoders) two_encoders.push_back(joint + 1);
    for (const Notice& notice : line.condition.repairs) repairs.push_back(notice.text());
    files.push_back({{"file", line.name},
                     {"seconds", line.seconds},
                     {"sample_time", line.condition.sample_time},
                     {"jitter", line.condition.jitter},
                     {"cutoff_hz", line.cutoff},
                     {"equations", recording.equations},
                     {"rms", numbers(residual.rms)},
                     {"percent", numbers(residual.percent)},
                     {"two_encoders", std::move(two_encoders)},
                     {"repairs", repairs},
                     {"messages", line.condition.messages}});
  }
  const Json json = {{"schema", "dynid.check/1"},
                     {"robot", report.robot},
                     {"joints", report.revolute.size()},
                     {"base_parameters", report.base_parameters},
                     {"recordings", files}};
  return json.dump(2) + "\n";
}

}  // namespace dyngen::runtime

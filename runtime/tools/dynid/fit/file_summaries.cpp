// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/file_summaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <stdexcept>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/identification/common_cutoff.h"
#include "runtime/identification/summary_file.h"
#include "runtime/tools/dynid/process/message.h"
#include "runtime/tools/dynid/recordings/judged.h"
#include "runtime/tools/dynid/recordings/loading.h"

namespace dyngen::runtime {
namespace {

// Process 0 says           and the others answer
//   list <file> ...          robot <text of the robot file>, or error <reason>
//   go                       file <name> <warnings> <reason> <.qr bytes> for each of their files
//   stop
//   end <exit code>
constexpr const char *kList = "list", *kRobot = "robot", *kError = "error", *kGo = "go",
                     *kStop = "stop", *kFile = "file", *kEnd = "end";

/// A file's own words, which begin with its name.
std::string named(const std::string& path, const std::string& reason) {
  return reason.find(path) != std::string::npos ? reason
                                                : fmt::format("{}: error: {}", path, reason);
}

/// @param warnings  what was repaired, also where the recording is refused then
MotionSource motion_and_warnings(const std::string& path, const ToolOptions& options,
                                 std::string& warnings) {
  std::vector<Notice> repairs;
  const auto add = [&] {
    for (const Notice& notice : repairs) warnings += notice.text() + "\n";
  };
  try {
    MotionSource source = motion_of_file(path, options.motion, &repairs);
    add();
    return source;
  } catch (...) {
    add();
    throw;
  }
}

std::string summary_bytes(const std::string& path, const DescribedRobot& robot,
                          const ToolOptions& options, std::string& warnings) {
  if (path.ends_with(".qr") || is_summary_file(path)) {
    return write_summaries(read_summary_file(path));
  }
  MotionSource source = motion_and_warnings(path, options, warnings);
  source = at_cutoff({source}, common_cutoff(robot.linear, {source})).front();
  for (const Remark& remark : judge(judged_robot(robot), {source})) {
    if (remark.refused && !options.as_recorded) throw ImplausibleError(remark.words(), remark.text);
    warnings += remark.words() + "\n";
  }
  RobotSummaries one = empty_summaries(robot.linear);
  const RecordingSummary summary = summarise(robot.linear, source, options.rows);
  RecordingLine line = describe(source, options, false);
  line.equations = equations_of(summary.equations);
  const std::string reason = why_no_equations(line, options.rows);
  if (!reason.empty()) throw TooLittleDataError(reason);
  one.robots.emplace("", summary);
  return write_summaries(one);
}

/// What became of a file, as a message; the same in whichever process.
Message file_message(const std::string& path, const DescribedRobot& robot,
                     const ToolOptions& options) {
  std::string warnings;
  try {
    const std::string bytes = summary_bytes(path, robot, options, warnings);
    return {kFile, path, warnings, "", bytes};
  } catch (const std::runtime_error& error) {  // RecordingError and SummaryFileError among them
    return {kFile, path, warnings, named(path, error.what()), ""};
  } catch (const std::invalid_argument& error) {
    return {kFile, path, warnings, named(path, error.what()), ""};
  }
}

/// @throws SummaryFileError  if they are damaged or of another robot
RobotSummaries summaries_of(const Message& message, const LinearModel& model) {
  const std::string& path = message[1];
  RobotSummaries all = empty_summaries(model);
  try {
    merge(all, read_summaries(message[4], path));
    if (pooled(all).equations.columns != model.columns) {
      throw std::invalid_argument("other parameters act on its joints");
    }
    return all;
  } catch (const std::invalid_argument& error) {
    throw SummaryFileError(
        fmt::format("{}: error: it is not of {}: {}", path, model.name, error.what()));
  }
}

/// How much there is of a robot that has a name.
struct RobotCount {
  std::int64_t recordings = 0;
  double seconds = 0;
};

class Collector {
 public:
  explicit Collector(const LinearModel& model) : model_(model) {
    found_.sum = empty_summary(model.columns, model.size());
  }

  void add(const Message& message) {
    std::cerr << message[2];
    std::string reason = message[3];
    if (reason.empty()) {
      try {
        const RobotSummaries all = summaries_of(message, model_);
        merge(found_.sum, pooled(all));
        count(all);
        return;
      } catch (const SummaryFileError& error) {
        reason = error.what();
      }
    }
    std::cerr << reason << "\n";
    found_.left_out.push_back(message[1]);
  }

  FileSummaries finish() {
    if (robots_.size() > 1) {
      for (const auto& [name, robot] : robots_) {
        found_.notes.push_back(fmt::format("robot {}: {} recordings, {:.1f} s",
                                           name.empty() ? "(not named)" : name, robot.recordings,
                                           robot.seconds));
      }
    }
    if (!found_.left_out.empty()) {
      found_.notes.push_back(fmt::format("left out: {}", fmt::join(found_.left_out, ", ")));
    }
    return std::move(found_);
  }

 private:
  void count(const RobotSummaries& all) {
    for (const auto& [name, summary] : all.robots) {
      robots_[name].recordings += summary.recordings;
      robots_[name].seconds += summary.seconds();
    }
  }

  const LinearModel& model_;
  FileSummaries found_;
  std::map<std::string, RobotCount> robots_;
};

Message receive_message(ProcessGroup& group, int from) { return unpacked(group.receive(from)); }

void tell_others(ProcessGroup& group, const Message& message) {
  for (int r = 1; r < group.size(); ++r) group.send(r, packed(message));
}

/// Gives the list to the others, and lets them begin if all have the same robot file.
void start_others(const DescribedRobot& robot, const ToolOptions& options, ProcessGroup& group) {
  Message list = {kList};
  list.insert(list.end(), options.recordings.begin(), options.recordings.end());
  tell_others(group, list);
  std::string wrong;
  for (int r = 1; r < group.size(); ++r) {
    const Message answer = receive_message(group, r);
    if (answer.at(0) == kError) {
      wrong = fmt::format("process {}: {}", r, answer.at(1));
    } else if (answer.at(1) != robot.file.text) {
      wrong = fmt::format("process {} has another robot file under the name {}", r, options.robot.path);
    }
  }
  tell_others(group, {wrong.empty() ? kGo : kStop});
  if (!wrong.empty()) throw std::invalid_argument(wrong);
}

}  // namespace

FileSummaries summarise_files(const DescribedRobot& robot, const ToolOptions& options,
                              ProcessGroup& group, ProgressLine& progress) {
  start_others(robot, options, group);
  const std::vector<std::string>& paths = options.recordings;
  const std::size_t processes = static_cast<std::size_t>(group.size());
  Collector collector(robot.linear);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    progress.show(paths[i], i, paths.size());
    const int who = static_cast<int>(i % processes);
    const Message message =
        who == 0 ? file_message(paths[i], robot, options) : receive_message(group, who);
    if (message.size() != 5 || message[1] != paths[i]) {
      throw std::logic_error(fmt::format("process {} did not answer for {}", who, paths[i]));
    }
    progress.clear();
    collector.add(message);
  }
  FileSummaries found = collector.finish();
  if (found.left_out.size() == paths.size()) {
    throw std::invalid_argument("none of the files can be used");
  }
  return found;
}

int serve(const ToolOptions& options, ProcessGroup& group) {
  std::string error;
  DescribedRobot robot;
  if (options.command == Command::kFit) {
    try {
      robot = describe_robot(options.robot, opened_by(options));
    } catch (const ModelError& wrong) {
      error = wrong.what();
    }
  }
  for (;;) {
    const Message order = receive_message(group, 0);
    if (order.at(0) == kEnd) return std::stoi(order.at(1));
    group.send(0,
               packed(error.empty() ? Message{kRobot, robot.file.text} : Message{kError, error}));
    if (receive_message(group, 0).at(0) != kGo) continue;
    for (std::size_t i = static_cast<std::size_t>(group.rank()); i + 1 < order.size();
         i += static_cast<std::size_t>(group.size())) {
      group.send(0, packed(file_message(order[i + 1], robot, options)));
    }
  }
}

void dismiss(ProcessGroup& group, int code) { tell_others(group, {kEnd, std::to_string(code)}); }

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

#include "gen/tool/output_files.h"
#include "gen/tool/progress_line.h"
#include "runtime/import/guess/guessed_map.h"
#include "runtime/import/imported_rows.h"
#include "runtime/import/map_file.h"
#include "runtime/logs/log_summary.h"
#include "runtime/plausibility/derivative_remarks.h"
#include "runtime/recordings/clock.h"
#include "runtime/recordings/signal_repair.h"
#include "runtime/recordings/time_base.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/recordings/inputs.h"
#include "runtime/tools/dynid/recordings/judged.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/robot/row_values.h"

namespace dyngen::runtime {
namespace {

constexpr Eigen::Index kImportedAtOnce = 20000;  // rows

/// What was written of one recording.
struct ImportedCount {
  std::string name;
  Eigen::Index samples = 0;
  std::size_t runs = 0;
  int joints = 0;
  double seconds = 0;
  TimeBase time;  ///< of its first rows
};

/// What the first rows say of their time base, of derivatives, slow columns and, where there is a
/// robot, of units and signs. The recording is written all the same: whoever reads it hears it
/// again.
void tell_doubts(const Recording& first, bool whole, const DescribedRobot* robot) {
  const TimeBase base = examine_time_base(first);
  const std::string where = whole ? "" : " (of the first rows)";
  const auto say = [&](const std::string& text) {
    std::cerr << fmt::format("{}: warning: {}{}\n", first.file_name, text, where);
  };
  if (!base.uniform && first.samples() > 2) {
    say(fmt::format("{}; {}", base.message, choose_clock(first).message));
  }
  Recording repaired = first;
  std::vector<Notice> repairs;
  try {
    repair_signals(repaired, repairs);
  } catch (const RecordingError& error) {
    std::cerr << error.what() << "\n";
    return;
  }
  for (const Notice& notice : repairs) {
    std::cerr << notice.text() << " when it is read; here it is written as it is" << where << "\n";
  }
  // a lag or a factor is that of samples at even times
  if (!base.uniform && base.sample_time > 0) {
    ClockChoice clock = choose_clock(repaired);
    if (clock.rebuilt) repaired.time = std::move(clock.time);
    repaired = resample(repaired, clock.rebuilt ? clock.step : base.sample_time);
  }
  if (robot == nullptr || robot->linear.joints() != first.joints()) {
    for (const Remark& remark : derivative_remarks(repaired, base.sample_time)) say(remark.text);
    return;
  }
  try {
    MotionOptions options;
    options.average_periods = false;
    for (const Remark& remark : judge(judged_robot(*robot), {motion_of(repaired, options)})) {
      say(remark.text);
    }
  } catch (const TooLittleDataError& error) {
    say(error.what());
  }
}

/// The recording that is written, in memory where it is short.
class ImportedFile {
 public:
  ImportedFile(const std::string& path, std::size_t stream_above, const DescribedRobot* robot,
               ProgressLine& progress)
      : writer_(path, true), stream_above_(stream_above), robot_(robot), progress_(&progress) {}

  ImportedCount add(const RecordingInput& input) {
    ImportedCount count;
    count.name = input.name;
    ToldRepairs repairs;
    progress_->show("importing " + input.name, 0, 1);
    if (input.text_bytes <= stream_above_) {
      ReadOptions options;
      options.repair_signals = false;
      const Recording all = read_recording(input, options, &repairs.notices);
      write(all, false, count);
      progress_->clear();
      tell_doubts(all, true, robot_);
      return count;
    }
    ReadOptions options;
    if (input.reopens) {
      RecordingReader trial = input.open(options);
      Recording first;
      trial.next(first, kJudgedRows);
      options.spread_stamps = stamps_are_repeated(trial);
    }
    RecordingReader reader = input.open(options);
    try {
      stream(reader, count);
    } catch (...) {
      repairs.notices = reader.notices();
      throw;
    }
    repairs.notices = reader.notices();
    return count;
  }
  void finish() { writer_.finish(); }

 private:
  static constexpr Eigen::Index kJudgedRows = 200000;

  void stream(RecordingReader& reader, ImportedCount& count) {
    Recording chunk;
    while (reader.next(chunk, count.samples == 0 ? kJudgedRows : kImportedAtOnce)) {
      const bool first = count.samples == 0;
      write(chunk, reader.continues_run() && !first, count);
      if (first) {
        progress_->clear();
        tell_doubts(chunk, false, robot_);
      }
      constexpr double kParts = 1000;
      progress_->show("importing " + count.name,
                      static_cast<std::size_t>(kParts * reader.fraction_read()),
                      static_cast<std::size_t>(kParts));
    }
  }
  void write(const Recording& chunk, bool continues, ImportedCount& count) {
    writer_.write(chunk, continues);
    if (count.samples == 0) count.time = examine_time_base(chunk);
    count.joints = chunk.joints();
    for (std::size_t run = 0; run < chunk.run_starts.size(); ++run) {
      const bool goes_on = run == 0 && continues;
      const double end = chunk.time(run_end(chunk, run) - 1);
      count.seconds += end - (goes_on ? last_ : chunk.time(chunk.run_starts[run]));
      count.runs += goes_on ? 0 : 1;
      last_ = end;
    }
    count.samples += chunk.samples();
  }

  RecordingWriter writer_;
  std::size_t stream_above_;
  const DescribedRobot* robot_;
  ProgressLine* progress_;
  double last_ = 0;  ///< s, of the last sample written
};

std::string text_of(const ImportedCount& count) {
  return fmt::format("{}: {} samples of {} joint{}, {:.6g} s in {} run{}; {}\n", count.name,
                     count.samples, count.joints, count.joints == 1 ? "" : "s", count.seconds,
                     count.runs, count.runs == 1 ? "" : "s", count.time.message);
}

int list_logs(const ImportOptions& options) {
  for (const std::string& path : options.logs) {
    try {
      const std::unique_ptr<RawLog> log = open_log(path);
      std::cout << path << "\n" << log_summary(*log);
    } catch (const LogError& error) {
      throw RecordingError(error.what());
    }
  }
  return kDone;
}

/// Torque that the robot's weight takes of each joint, the largest over many poses; empty where
/// numbers are unknown.
Eigen::VectorXd gravity_torque(const DescribedRobot& robot, const GuessRobot& guess) {
  const LinearModel& model = robot.linear;
  Eigen::VectorXd beta(model.size());
  for (Eigen::Index i = 0; i < beta.size(); ++i) {
    const auto& value = model.parameters[static_cast<std::size_t>(i)].value;
    if (!value) return {};
    beta[i] = *value;
  }
  constexpr Eigen::Index kPoses = 500;
  const Eigen::Index n = model.joints();
  Eigen::MatrixXd q(kPoses, n);
  std::mt19937 random(1);  // the same poses each time
  for (Eigen::Index j = 0; j < n; ++j) {
    const bool limits = guess.lowest.size() == n && std::isfinite(guess.lowest[j]) &&
                        std::isfinite(guess.highest[j]);
    std::uniform_real_distribution<double> place(limits ? guess.lowest[j] : -std::numbers::pi,
                                                 limits ? guess.highest[j] : std::numbers::pi);
    for (Eigen::Index k = 0; k < kPoses; ++k) q(k, j) = place(random);
  }
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(kPoses, n);
  return model.torque(q, still, still, beta).cwiseAbs().colwise().maxCoeff().transpose();
}

GuessRobot guess_robot(const RobotSource& source) {
  GuessRobot guess;
  guess.joints = imported_robot(source);
  if (source.empty()) return guess;
  const DescribedRobot robot = describe_robot(source, OpenParameters::kAsWritten);
  guess.lowest = row_values(robot, RowKey::kQmin);
  guess.highest = row_values(robot, RowKey::kQmax);
  guess.gravity_torque = gravity_torque(robot, guess);
  return guess;
}

int write_guess(const ToolOptions& options) {
  ProgressLine progress("dynid");
  progress.show("looking at the logs", 0, 1);
  const GuessedMap guess = guess_map(sample_logs(options.import.logs), guess_robot(options.robot));
  progress.clear();
  if (options.output.empty()) {
    std::cout << guess.yaml;
  } else {
    write_files({{options.output, guess.yaml}});
    std::cout << "written to " << options.output << "\n";
  }
  if (guess.questions > 0) {
    std::cerr << fmt::format(
        "{} question{} to be answered in the map before it can be used: look "
        "for \"?\"\n",
        guess.questions, guess.questions == 1 ? " is" : "s are");
  }
  return kDone;
}

int import_logs(const ToolOptions& options) {
  ProgressLine progress("dynid");
  ToolOptions mapped = options;
  mapped.map = options.import.map;
  const std::vector<RecordingInput> inputs = recording_inputs(options.import.logs, mapped);
  std::optional<DescribedRobot> robot;
  if (!options.robot.empty()) robot = describe_robot(options.robot, OpenParameters::kAbsentRows);
  std::string text;
  {
    ImportedFile file(options.output, options.motion.stream_above, robot ? &*robot : nullptr,
                      progress);
    for (const RecordingInput& input : inputs) text += text_of(file.add(input));
    file.finish();
  }
  progress.clear();
  std::cout << text << "written to " << options.output << "\n";
  return kDone;
}

}  // namespace

int run_import(const ToolOptions& options) {
  if (options.import.list) return list_logs(options.import);
  if (options.import.guess) return write_guess(options);
  return import_logs(options);
}

}  // namespace dyngen::runtime

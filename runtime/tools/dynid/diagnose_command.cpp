// SPDX-License-Identifier: MIT
#include <iostream>
#include <limits>
#include <utility>

#include "gen/tool/output_files.h"
#include "runtime/tools/dynid/commands.h"
#include "runtime/tools/dynid/diagnosis_recordings.h"
#include "runtime/tools/dynid/diagnosis_report.h"
#include "runtime/tools/dynid/effect_hypotheses.h"
#include "runtime/tools/dynid/effect_laws.h"
#include "runtime/tools/dynid/improved_file.h"
#include "runtime/tools/dynid/loading.h"
#include "runtime/tools/dynid/robot_tangents.h"

namespace dyngen::runtime {
namespace {

/// Reads recordings as a diagnosis sees them, and notes what each is for.
class RecordingDesk {
 public:
  RecordingDesk(const ToolOptions& options, const KnownEffects& known, ProgressLine& progress)
      : options_(options), known_(known), progress_(progress) {
    options_.motion.stream_above = std::numeric_limits<std::size_t>::max();
    // what drifts is seen between periods
    options_.motion.average_periods = false;
  }

  std::vector<MotionSource> read(const std::vector<std::string>& paths, const std::string& use) {
    LoadedRecordings loaded = options_.diagnose.diagnosis.residual_only
                                  ? unexplained(paths)
                                  : load_recordings(paths, options_, false, progress_);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      recordings_.push_back({paths[i], use, loaded.lines[i].seconds});
      loaded.sources[i] = without_effects(loaded.sources[i], known_);
    }
    return std::move(loaded.sources);
  }

  [[nodiscard]] const std::vector<DiagnosedRecording>& recordings() const { return recordings_; }

 private:
  LoadedRecordings unexplained(const std::vector<std::string>& paths) {
    LoadedRecordings loaded;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      progress_.show("reading " + paths[i], i, paths.size());
      loaded.sources.push_back(unexplained_motion(paths[i], options_.motion));
      for (const Notice& notice : loaded.sources.back().condition.repairs) {
        std::cerr << notice.text() << "\n";
      }
      loaded.lines.push_back(describe(loaded.sources.back(), options_, false));
    }
    return loaded;
  }

  ToolOptions options_;
  const KnownEffects& known_;
  ProgressLine& progress_;
  std::vector<DiagnosedRecording> recordings_;
};

void write_outputs(const ToolOptions& options, const DescribedRobot& robot,
                   DiagnosisReport& report) {
  const bool answered = report.diagnosis.verdict != Verdict::kInsufficientData;
  for (const std::string& path : {options.diagnose.report, options.json}) {
    if (!path.empty()) report.written.push_back(path);
  }
  std::vector<OutputFile> files;
  if (!options.output.empty() && answered) {
    report.written.push_back(options.output);
    files.push_back({options.output, improved_text(report, robot)});
  }
  if (!options.json.empty()) files.push_back({options.json, diagnosis_json(report)});
  if (!options.diagnose.report.empty()) {
    files.push_back({options.diagnose.report, diagnosis_page(report)});
  }
  write_files(files);
}

}  // namespace

int run_diagnose(const ToolOptions& options) {
  ProgressLine progress("dynid");
  DiagnosisOptions settings = options.diagnose.diagnosis;
  settings.decimation = options.rows.decimation;
  settings.validate();
  const EffectCatalogue catalogue = effect_catalogue(options.effects);
  const DescribedRobot robot = describe_robot(options.robot, OpenParameters::kAbsentRows);
  const KnownEffects known = known_effects(options.robot, catalogue);
  RecordingDesk desk(options, known, progress);
  DiagnosisInput input;
  input.model = robot.linear;
  input.robot = effect_robot(robot);
  input.train = desk.read(options.recordings, "fitted");
  input.heldout = desk.read(options.heldout, "held out");
  input.reference = desk.read(options.diagnose.reference, "reference");
  std::vector<MotionSource> all = input.train;
  all.insert(all.end(), input.heldout.begin(), input.heldout.end());
  all.insert(all.end(), input.reference.begin(), input.reference.end());
  input.hypotheses = competing_effects(robot, catalogue, all);

  DiagnosisReport report =
      diagnosis_report(diagnose(input, settings,
                                [&](const std::string& stage, double done) {
                                  progress.show(stage, static_cast<std::size_t>(100 * done), 100);
                                }),
                       robot, catalogue);
  report.recordings = desk.recordings();
  report.residual_only = settings.residual_only;
  report.false_alarm = settings.false_alarm;
  report.seed = settings.seed;
  report.command = options.diagnose.command;
  report.version = DYNGEN_VERSION;
  progress.clear();
  write_outputs(options, robot, report);
  std::cout << diagnosis_text(report);
  if (report.diagnosis.verdict != Verdict::kInsufficientData) return kDone;
  std::cerr << "dynid: " << report.diagnosis.sentence << "\n";
  return kCannotAnswer;
}

}  // namespace dyngen::runtime

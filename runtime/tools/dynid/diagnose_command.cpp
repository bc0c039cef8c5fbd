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

/// Recordings as a diagnosis sees them, and what each is for.
struct DiagnosedMotions {
  std::vector<MotionSource> sources;
  std::vector<DiagnosedRecording> recordings;
};

/// How they are read: whole, and without averages, since what drifts is seen between periods.
ToolOptions reading(ToolOptions options) {
  options.motion.stream_above = std::numeric_limits<std::size_t>::max();
  options.motion.average_periods = false;
  return options;
}

/// load_recordings() of what another simulator leaves.
LoadedRecordings load_unexplained(const std::vector<std::string>& paths, const ToolOptions& options,
                                  ProgressLine& progress) {
  LoadedRecordings loaded;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    progress.show("reading " + paths[i], i, paths.size());
    loaded.sources.push_back(unexplained_motion(paths[i], options.motion));
    for (const Notice& notice : loaded.sources.back().condition.repairs) {
      std::cerr << notice.text() << "\n";
    }
    loaded.lines.push_back(describe(loaded.sources.back(), options, false));
  }
  return loaded;
}

DiagnosedMotions read_motions(const std::vector<std::string>& paths, const std::string& use,
                              const ToolOptions& options, const KnownEffects& known,
                              ProgressLine& progress) {
  const LoadedRecordings loaded = options.diagnose.diagnosis.residual_only
                                      ? load_unexplained(paths, options, progress)
                                      : load_recordings(paths, options, false, progress);
  DiagnosedMotions motions;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    motions.sources.push_back(without_effects(loaded.sources[i], known));
    motions.recordings.push_back({paths[i], use, loaded.lines[i].seconds});
  }
  return motions;
}

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
  const ToolOptions how = reading(options);
  DiagnosedMotions train = read_motions(options.recordings, "fitted", how, known, progress);
  DiagnosedMotions heldout = read_motions(options.heldout, "held out", how, known, progress);
  DiagnosedMotions reference =
      read_motions(options.diagnose.reference, "reference", how, known, progress);
  std::vector<MotionSource> all = train.sources;
  std::vector<DiagnosedRecording> recordings = train.recordings;
  for (const DiagnosedMotions* motions : {&heldout, &reference}) {
    all.insert(all.end(), motions->sources.begin(), motions->sources.end());
    recordings.insert(recordings.end(), motions->recordings.begin(), motions->recordings.end());
  }
  DiagnosisInput input;
  input.model = robot.linear;
  input.robot = effect_robot(robot);
  input.train = std::move(train.sources);
  input.heldout = std::move(heldout.sources);
  input.reference = std::move(reference.sources);
  input.hypotheses = competing_effects(robot, catalogue, all);

  DiagnosisReport report =
      diagnosis_report(diagnose(input, settings,
                                [&](const std::string& stage, double done) {
                                  progress.show(stage, static_cast<std::size_t>(100 * done), 100);
                                }),
                       robot, catalogue);
  report.recordings = std::move(recordings);
  report.residual_only = settings.residual_only;
  report.false_alarm = settings.false_alarm;
  report.seed = settings.seed;
  report.command = options.diagnose.command;
  report.robot_path = options.robot;
  report.json_path = options.json;
  report.version = DYNGEN_VERSION;
  progress.clear();
  write_outputs(options, robot, report);
  std::cout << diagnosis_text(report);
  if (report.diagnosis.verdict != Verdict::kInsufficientData) return kDone;
  std::cerr << "dynid: " << report.diagnosis.sentence << "\n";
  return kCannotAnswer;
}

}  // namespace dyngen::runtime

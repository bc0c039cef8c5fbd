// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "gen/diagnostic/diagnostic.h"
#include "gen/tool/output_files.h"
#include "runtime/diagnosis/equation_sets/division.h"
#include "runtime/identification/recording_clock.h"
#include "runtime/identification/standing_joints.h"
#include "runtime/tools/dynid/diagnose/diagnosis_document.h"
#include "runtime/tools/dynid/diagnose/diagnosis_recordings.h"
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"
#include "runtime/tools/dynid/diagnose/forward_simulation.h"
#include "runtime/tools/dynid/diagnose/improved_file.h"
#include "runtime/tools/dynid/effects/effect_code_text.h"
#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/fit/number_notes.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/options/rules_file.h"
#include "runtime/tools/dynid/page/arm_drawing.h"
#include "runtime/tools/dynid/page/page_output.h"
#include "runtime/tools/dynid/process/late_error.h"
#include "runtime/tools/dynid/recordings/inputs.h"
#include "runtime/tools/dynid/recordings/judged.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/ripple/joint_ripple.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "runtime/tools/dynid/robot/write_back.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {
namespace {

/// Recordings as a diagnosis sees them, and what each is for.
struct DiagnosedMotions {
  std::vector<MotionSource> sources;   ///< without the effects that the file has already
  std::vector<MotionSource> recorded;  ///< with them
  std::vector<DiagnosedRecording> recordings;
};

/// Bytes of text: two minutes of six joints at 1 kHz with all digits, for which a search takes some
/// minutes.
constexpr std::size_t kReadWhole = 40'000'000;

// The same for all recordings of one side together, as numbers_of_rows() counts: those that last
// longer than kAlwaysWhole share it. Of longer ones stretches are read, with half as many numbers.
constexpr double kMostNumbers = 2e6;
constexpr double kAlwaysWhole = 300;  // s
constexpr double kMostOfStretches = 1e6;

/// How they are read: whole, and without averages, since what drifts is seen between periods. Of
/// longer ones the stretches that say most are read.
/// @param files  recordings of one side
ToolOptions reading(ToolOptions options, std::size_t files) {
  const double share = kMostNumbers / static_cast<double>(std::max<std::size_t>(1, files));
  options.motion.numbers_above = share;
  options.motion.read_whole = kAlwaysWhole;
  options.motion.numbers_of_stretches = std::min(kMostOfStretches, share);
  options.motion.stretches_above = kReadWhole;
  options.motion.stream_above = std::numeric_limits<std::size_t>::max();
  options.motion.average_periods = false;
  return options;
}

/// load_recordings() of what another simulator leaves.
LoadedRecordings load_unexplained(const std::vector<std::string>& paths, const ToolOptions& options,
                                  ProgressLine& progress) {
  LoadedRecordings loaded;
  const std::vector<RecordingInput> inputs = recording_inputs(paths, options);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    progress.show("reading " + inputs[i].name, i, inputs.size());
    ToldRepairs repairs;
    loaded.sources.push_back(unexplained_motion(inputs[i], options.motion, &repairs.notices));
    loaded.lines.push_back(describe(loaded.sources.back(), options, false));
  }
  return loaded;
}

DiagnosedMotions read_motions(const std::vector<std::string>& paths, const std::string& use,
                              const ToolOptions& options, const KnownEffects& known,
                              ProgressLine& progress) {
  const ToolOptions how = reading(options, paths.size());
  const LoadedRecordings loaded = options.diagnose.diagnosis.residual_only
                                      ? load_unexplained(paths, how, progress)
                                      : load_recordings(paths, how, false, progress);
  DiagnosedMotions motions;
  for (std::size_t i = 0; i < loaded.sources.size(); ++i) {
    motions.sources.push_back(without_effects(loaded.sources[i], known));
    motions.recorded.push_back(loaded.sources[i]);
    motions.recordings.push_back(
        {loaded.lines[i].name, use, loaded.lines[i].seconds, loaded.lines[i].condition.stretches});
  }
  return motions;
}

/// Structure that is sought in all joints at once needs the torque of all.
/// @throws TooLittleDataError  if one was not measured
void refuse_dead_torque(const std::vector<MotionSource>& sources) {
  for (const MotionSource& source : sources) {
    const std::vector<bool>& dead = source.condition.torque_dead;
    for (std::size_t j = 0; j < dead.size(); ++j) {
      if (!dead[j]) continue;
      throw TooLittleDataError(fmt::format(
          "{}: the torque of joint {} was not measured (one number throughout), and a diagnosis "
          "needs that of all joints.",
          source.name, j + 1));
    }
  }
}

std::vector<MotionSource> joined_sources(const DiagnosisInput& input) {
  std::vector<MotionSource> all = input.train;
  for (const auto* sources : {&input.heldout, &input.reference}) {
    all.insert(all.end(), sources->begin(), sources->end());
  }
  return all;
}

/// What --controller asks for. @throws std::invalid_argument
void check_simulation(const ToolOptions& options) {
  const DiagnoseOptions& own = options.diagnose;
  if (own.loop.controller.empty()) return;
  if (own.diagnosis.residual_only) {
    throw std::invalid_argument(
        "--controller: found --residual-only too, expected a model whose parameters are fitted: "
        "what another simulator leaves is no robot");
  }
  if (!own.commanded.empty() && own.commanded.size() != options.heldout.size()) {
    throw std::invalid_argument(
        fmt::format("--commanded: found {} motions, expected {}, one for each --holdout",
                    own.commanded.size(), options.heldout.size()));
  }
}

/// Simulates what was held out.
ForwardComparison simulated(const ToolOptions& options, const DiagnosisReport& report,
                            const DescribedRobot& robot, const EffectCatalogue& catalogue,
                            std::vector<MotionSource> heldout, ProgressLine& progress) {
  ForwardTask task{options.diagnose.loop,
                   options.robot.beside(options.diagnose.controller_model),
                   std::move(heldout),
                   {}};
  for (const std::string& path : options.diagnose.commanded) {
    task.commanded.push_back(load_motion(path, options.map, options.robot));
  }
  return compare_forward(report, robot, catalogue, task, [&](double done) {
    progress.show("simulation", static_cast<std::size_t>(1000 * done), 1000);
  });
}

/// The statements that dyngen writes for each finding, of the improved file; none if that cannot be
/// read, which write_outputs() says.
void add_code(DiagnosisReport& report, const DescribedRobot& robot,
              const std::shared_ptr<const EffectCatalogue>& catalogue) {
  const auto& effects = report.diagnosis.fit.point.effects;
  if (effects.empty()) return;
  RobotFile file;
  try {
    file = parse_robot_file(improved_text(report, robot), robot.file.file_name);
  } catch (const ModelError&) {
    return;
  }
  std::size_t row = robot.file.effects.size();
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].recording >= 0) continue;  // an event: no row
    report.words[i].code = effect_code_text(file, row++, effects[i], catalogue);
  }
}

/// What held numbers cannot go with.
void refuse_with_hold(const ToolOptions& options, const HeldNumbers& held) {
  if (!held.any()) return;
  if (options.diagnose.diagnosis.residual_only) {
    throw std::invalid_argument(
        "--hold and --residual-only: expected one of them, since the model's own parameters are "
        "not "
        "fitted to what another simulator leaves");
  }
  if (held.deviations.size() > 0) {
    throw std::invalid_argument(
        "--hold: standard deviations (+-) are for 'dynid fit'; a diagnosis takes held numbers for "
        "exact");
  }
}

/// What two encoders say of gears, and whether the findings agree with it.
void add_two_encoders(const ToolOptions& options, const WindUpRules& rules,
                      const DescribedRobot& robot, const std::vector<MotionSource>& train,
                      ProgressLine& progress, DiagnosisReport& report) {
  if (report.residual_only || joints_with_two_encoders(train).empty()) return;
  report.two_encoders = two_encoders_of(robot, std::nullopt, train, options, rules, progress);
  std::vector<ElasticityElsewhere> found;
  for (const Finding& finding : report.diagnosis.findings) {
    const EffectLaw& law = finding.effect.law;
    if (law.family != "joint_elasticity" || finding.effect.joint < 0) continue;
    for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
      if (law.parameters[p].name != "c") continue;
      found.push_back({finding.effect.joint, finding.parameters[p].value,
                       finding.parameters[p].stddev, "the finding", true});
    }
  }
  for (const CertificateLine& line : report.diagnosis.certificate) {
    if (line.effect.law.name != "joint_elasticity" || line.effect.joint < 0) continue;
    found.push_back({line.effect.joint, line.smallest, 0, "the torque", false});
  }
  compare_elasticity(report.two_encoders, found);
}

/// Ripple above the band of the equations, and rows of what no finding has.
void add_ripple(const std::vector<RippleRun>& runs, const ToolOptions& options,
                const RippleRules& rules, const DescribedRobot& robot,
                const EffectCatalogue& catalogue, ProgressLine& progress, DiagnosisReport& report) {
  report.ripples = ripples_of(robot.linear, runs, gears_of_map(options),
                              ripples_in(report.diagnosis.fit.point.effects), rules, progress);
  report.ripple_effects = ripple_effects(report.ripples, robot.model, catalogue);
}

/// The JSON and the page, then the robot file: an answer is not lost with it.
void write_outputs(const ToolOptions& options, const DescribedRobot& robot, DiagnosisReport& report,
                   ProgressLine& progress) {
  std::vector<OutputFile> answer;
  if (!options.json.empty()) {
    answer.push_back({options.json, diagnosis_json(report)});
    report.written.push_back(options.json);
  }
  const std::vector<std::string> made = write_with_page(
      options.page, [&] { return diagnosis_document(report); }, progress, std::move(answer));
  report.written.insert(report.written.begin(), made.begin(), made.end());
  const bool answered = report.diagnosis.verdict != Verdict::kInsufficientData;
  if (options.output.empty() || !answered) return;
  if (is_description_name(options.output)) return;  // behind the text
  write_robot_files({{options.output, improved_text(report, robot)}});
  report.written.push_back(options.output);
}

/// What a command line asks for, and the robot that it is asked of.
struct DiagnoseTask {
  const ToolOptions& options;
  DiagnosisOptions settings;
  std::shared_ptr<const EffectCatalogue> catalogue;
  DescribedRobot robot;
  ToolOptions how;  ///< recordings are read

  static DiagnoseTask of(const ToolOptions& options);
};

DiagnoseTask DiagnoseTask::of(const ToolOptions& options) {
  DiagnosisOptions settings = options.diagnose.diagnosis;
  settings.decimation = options.rows.decimation;
  if (!options.diagnose.rules.empty()) settings.rules = read_rules(options.diagnose.rules);
  settings.validate();
  check_simulation(options);
  check_write_back(options);
  DiagnoseTask task{
      options, settings, std::make_shared<const EffectCatalogue>(effect_catalogue(options.effects)),
      describe_robot(options.robot, OpenParameters::kAbsentRows, {.hold = options.hold}),
      reading(options, options.recordings.size())};
  refuse_without_parameters(task.robot);
  refuse_with_hold(options, task.robot.held);
  return task;
}

/// A diagnosis, and what was seen on the way to it.
struct DiagnosisRun {
  DiagnosisInput input;
  std::vector<DiagnosedRecording> recordings;
  std::vector<std::string> notes;   ///< on how recordings were read
  std::vector<MotionSource> proof;  ///< held-out ones with the torque of all effects
  Diagnosis diagnosis;
  DiagnosisViews views;
  std::vector<RippleRun> runs;  ///< at full rate; empty: with --residual-only
  Eigen::VectorXd posture;      ///< in the middle of a held-out recording
};

/// Files that continue one another have one time: those that are fitted with those that are held
/// out, and those of the reference.
void add_clock(DiagnosisInput& input, std::vector<std::string>& notes) {
  const std::size_t fitted = input.train.size();
  std::vector<MotionSource> later = input.train;
  later.insert(later.end(), input.heldout.begin(), input.heldout.end());
  ClockedRecordings today = on_one_clock(std::move(later), kLongestPause);
  ClockedRecordings before = on_one_clock(std::move(input.reference), kLongestPause);
  const auto middle = today.sources.begin() + static_cast<std::ptrdiff_t>(fitted);
  input.train.assign(today.sources.begin(), middle);
  input.heldout.assign(middle, today.sources.end());
  input.reference = std::move(before.sources);
  for (std::string* sentence : {&today.sentence, &before.sentence}) {
    if (!sentence->empty()) notes.push_back(std::move(*sentence));
  }
}

void read_input(const DiagnoseTask& task, ProgressLine& progress, DiagnosisRun& run) {
  const ToolOptions& options = task.options;
  const KnownEffects known = known_effects(options.robot, *task.catalogue);
  const auto read = [&](const std::vector<std::string>& paths, const std::string& use) {
    DiagnosedMotions motions = read_motions(paths, use, task.how, known, progress);
    run.recordings.insert(run.recordings.end(), motions.recordings.begin(),
                          motions.recordings.end());
    for (const MotionSource& source : motions.recorded) {
      if (use == "held out") run.proof.push_back(source);
      if (use == "fitted" && options.heldout.empty()) {
        run.proof.push_back(divided({source}, task.settings.rules.equations).heldout.front());
      }
    }
    return std::move(motions.sources);
  };
  DiagnosisInput& input = run.input;
  input.train = read(options.recordings, "fitted");
  hold_standing_joints(input.model.revolute, input.train, {});
  if (!task.settings.residual_only) {
    judge_recordings(task.robot, input.train, options, progress);
    refuse_dead_torque(input.train);
  }
  input.heldout = read(options.heldout, "held out");
  input.reference = read(options.diagnose.reference, "reference");
  add_clock(input, run.notes);
  for (const MotionSource& source : joined_sources(input)) {
    for (const std::string& message : source.condition.messages) {
      if (!source.condition.stretches.empty() && message.starts_with("long recording")) {
        run.notes.push_back(source.name + ": " + message);
      }
    }
  }
  input.hypotheses = competing_effects(task.robot, *task.catalogue, joined_sources(input));
  if (!input.reference.empty()) input.loads = load_places(task.robot);
}

/// Recordings that say too little leave a sentence in place of an answer.
DiagnosisRun diagnosed(const DiagnoseTask& task, ProgressLine& progress) {
  DiagnosisRun run;
  run.input.model = task.robot.linear;
  run.input.robot = effect_robot(task.robot);
  run.posture = Eigen::VectorXd::Zero(task.robot.linear.joints());
  const auto observer = [&](const DiagnosedRecordings& shown) {
    std::vector<std::string> plots;
    for (const EffectInstance& effect : shown.after.effects) {
      plots.push_back(task.catalogue->find(effect.law.name)->plot);
    }
    run.views = views_for_report(shown, plots);
    if (!task.settings.residual_only) run.runs = ripple_runs(shown.train, shown.after);
    const Eigen::MatrixXd& q = shown.heldout.runs.front().motion.q;
    run.posture = q.row(q.rows() / 2);
  };
  const auto tell = [&](const std::string& stage, double done) {
    progress.show(stage, static_cast<std::size_t>(100 * done), 100);
  };
  try {
    read_input(task, progress, run);
    run.diagnosis = diagnose(run.input, task.settings, tell, observer);
  } catch (const TooLittleDataError& error) {
    run.diagnosis.sentence = error.what();
  } catch (const ImplausibleError& error) {
    progress.clear();
    std::cerr << error.what() << "\n";
    run.diagnosis.sentence = error.sentence();
  }
  return run;
}

DiagnosisReport report_of(const DiagnoseTask& task, DiagnosisRun& run) {
  const ToolOptions& options = task.options;
  DiagnosisReport report = diagnosis_report(std::move(run.diagnosis), task.robot, *task.catalogue);
  report.views = std::move(run.views);
  report.arm = arm_drawing(task.robot.model, run.posture, marked_joints(report.diagnosis));
  report.recordings = std::move(run.recordings);
  report.notes = notes_of_numbers(task.robot, false);
  report.notes.insert(report.notes.end(), run.notes.begin(), run.notes.end());
  for (std::string& remark : repeated_recordings(options)) {
    report.notes.push_back(std::move(remark));
  }
  report.residual_only = task.settings.residual_only;
  report.false_alarm = task.settings.false_alarm;
  report.seed = task.settings.seed;
  report.command = options.page.command;
  report.robot_path = options.robot.words();
  report.json_path = options.json;
  report.version = DYNGEN_VERSION;
  return report;
}

/// What recordings say beside the equations, and what the answer says of a robot under control.
void look_beside(const DiagnoseTask& task, DiagnosisRun& run, bool answered, ProgressLine& progress,
                 LateError& late, DiagnosisReport& report) {
  const std::vector<MotionSource>& train = run.input.train;
  if (!train.empty()) {
    late.during([&] {
      add_two_encoders(task.how, task.settings.rules.wind_up, task.robot, train, progress, report);
    });
  }
  if (answered && !run.runs.empty()) {
    late.during([&] {
      add_ripple(run.runs, task.how, task.settings.rules.ripple, task.robot, *task.catalogue,
                 progress, report);
    });
  }
  if (!train.empty() && !task.settings.residual_only) {
    late.during([&] {
      report.steady = steady_of(task.robot, train, task.settings.rules.steady, progress);
    });
  }
  if (answered && !task.options.diagnose.loop.controller.empty()) {
    late.during([&] {
      report.forward = simulated(task.options, report, task.robot, *task.catalogue,
                                 std::move(run.proof), progress);
    });
  }
}

}  // namespace

int run_diagnose(const ToolOptions& options) {
  ProgressLine progress("dynid");
  const DiagnoseTask task = DiagnoseTask::of(options);
  const DescribedRobot& robot = task.robot;
  DiagnosisRun run = diagnosed(task, progress);
  DiagnosisReport report = report_of(task, run);
  const bool answered = report.diagnosis.verdict != Verdict::kInsufficientData;
  LateError late;
  look_beside(task, run, answered, progress, late, report);
  if (answered) add_code(report, robot, task.catalogue);
  progress.clear();
  if (answered && is_description_name(options.output)) {
    progress.show("bodies of " + options.output, 0, 1);
    late.during([&] {
      report.written_back = made_description(options, improved_text(report, robot),
                                             findings_comment(report, robot), run.input.train);
    });
    progress.clear();
  }
  late.during([&] { write_outputs(options, robot, report, progress); });
  progress.clear();
  std::cout << diagnosis_text(report, style_of_output()) << std::flush;
  if (report.written_back) late.during([&] { write_description(*report.written_back); });
  late.rethrow();
  if (answered) return kDone;
  std::cerr << "dynid: " << report.diagnosis.sentence << "\n";
  return kCannotAnswer;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "gen/tool/progress_line.h"
#include "runtime/identification/simulated_motion.h"
#include "runtime/identification/standing_joints.h"
#include "runtime/identification/summary_file.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/tools/dynid/fit/consistent_fit.h"
#include "runtime/tools/dynid/fit/file_summaries.h"
#include "runtime/tools/dynid/fit/fit_with_effects.h"
#include "runtime/tools/dynid/fit/held_uncertainty.h"
#include "runtime/tools/dynid/fit/number_notes.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/page/page_output.h"
#include "runtime/tools/dynid/process/late_error.h"
#include "runtime/tools/dynid/recordings/inputs.h"
#include "runtime/tools/dynid/recordings/judged.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "runtime/tools/dynid/robot/write_back.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The file's values, if it has all of them.
VectorXd prior_of(const LinearModel& model) {
  VectorXd prior(model.size());
  for (int i = 0; i < model.size(); ++i) {
    const auto& value = model.parameters[static_cast<std::size_t>(i)].value;
    if (!value) return {};
    prior[i] = *value;
  }
  return prior;
}

/// Parts of recordings that are held out by --holdout-part.
void hold_out_parts(double part, LoadedRecordings& train, LoadedRecordings& heldout,
                    const ToolOptions& options) {
  if (part <= 0) return;
  for (std::size_t i = 0; i < train.sources.size(); ++i) {
    MotionSource last = part_of(train.sources[i], 1 - part, 1);
    train.sources[i] = part_of(train.sources[i], 0, 1 - part);
    last.name += fmt::format(" (last {:.0f} %)", 100 * part);
    train.sources[i].name += fmt::format(" (first {:.0f} %)", 100 * (1 - part));
    train.lines[i] = describe(train.sources[i], options, false);
    heldout.lines.push_back(describe(last, options, true));
    heldout.sources.push_back(std::move(last));
  }
}

/// Joints that stand all through a recording are still there, unless the caller says at which speed
/// a joint stands.
void hold_standing(const LinearModel& model, LoadedRecordings& train, LoadedRecordings& heldout,
                   const ToolOptions& options) {
  if (options.rows.still_speed >= 0) return;
  hold_standing_joints(model.revolute, train.sources, {&heldout.sources});
  for (LoadedRecordings* loaded : {&train, &heldout}) {
    for (std::size_t i = 0; i < loaded->sources.size(); ++i) {
      loaded->lines[i] = describe(loaded->sources[i], options, loaded->lines[i].heldout);
    }
  }
}

Conditioning examine_conditioning(const FitReport& report) {
  constexpr double kLeastSensitivity = 0.02, kMostCondition = 30;
  const TorqueFactor& equations = report.data.summary.equations;
  const VectorXd& weights = report.main().estimate.joint_weights;
  Conditioning result;
  result.raw = report.main().estimate.raw_condition;
  result.unit_norm = report.main().estimate.condition;
  result.sensitivity =
      condition_number(singular_values(equations, weights, sensitivity_scale(equations, weights)));
  result.insensitive = remove_insensitive(equations, weights, kLeastSensitivity);
  result.dependent = remove_dependent(equations, weights, kMostCondition);
  result.weakest = drop_weakest(equations, weights, -1);
  result.essential = essential_parameters(equations, weights);
  return result;
}

/// Noise that is larger than what a combination of parameters shows: (4.1) has no bound then.
void warn_of_hidden_directions(FitReport& report) {
  if (std::isfinite(report.trust.perturbation_bound) || report.main().estimate.unseen.cols() > 0) {
    return;
  }
  report.notes.emplace_back(
      "warning: noise of accelerations is larger than what the weakest combination of parameters "
      "shows: values that share in it may be wrong beyond their deviations (more motion, longer "
      "recordings or a lower --cutoff would show it)");
}

/// Torque of held-out recordings that is not predicted.
void warn_of_held_out(FitReport& report) {
  constexpr double kMostLeft = 50;  // % of a joint's torque
  const VectorXd& left = report.main().heldout_percent;
  for (Index j = 0; j < left.size(); ++j) {
    if (!(left[j] > kMostLeft)) continue;
    report.notes.push_back(fmt::format(
        "warning: {:.0f} % of joint {}'s held-out torque is not predicted: another motion than was "
        "fitted, another state of the robot, or physics that the model leaves out ('dynid "
        "diagnose')",
        left[j], j + 1));
  }
}

/// Recordings, or files of their summaries: not both.
bool are_summaries(const std::vector<std::string>& paths) {
  const auto count = std::count_if(paths.begin(), paths.end(), is_summary_file);
  if (count == 0) return false;
  if (static_cast<std::size_t>(count) == paths.size()) return true;
  throw std::invalid_argument(
      "recordings and .qr files cannot be fitted together: accumulate the recordings first");
}

void load_summaries(const ToolOptions& options, FitReport& report) {
  RobotSummaries all = empty_summaries(report.robot.linear);
  for (const std::string& path : options.recordings) {
    try {
      merge(all, read_summary_file(path));
    } catch (const std::invalid_argument& error) {
      throw SummaryFileError(fmt::format("{}: error: it is not of {}: {}", path,
                                         report.robot.linear.name, error.what()));
    }
  }
  for (const auto& [name, summary] : all.robots) {
    if (all.robots.size() > 1) {
      report.notes.push_back(fmt::format("robot {}: {} recordings, {:.1f} s",
                                         name.empty() ? "(not named)" : name, summary.recordings,
                                         summary.seconds()));
    }
  }
  report.data.summary = pooled(all);
  if (options.own_friction) report.hierarchy = fit_own_friction(report.robot.linear, all);
}

/// The regressor of the model that tracks what was commanded, as instruments.
/// @throws std::invalid_argument  without --tracked, or if it is not of the one recording
void make_instruments(const ToolOptions& options, const LoadedRecordings& train,
                      FitReport& report) {
  const auto& methods = options.fit.methods;
  const bool wanted = std::find(methods.begin(), methods.end(), FitMethod::kIv) != methods.end();
  if (options.tracked.empty()) {
    if (!wanted) return;
    throw std::invalid_argument(
        "method iv needs the motion that was commanded: --tracked FILE, a trajectory (time, q1.., "
        "as "
        "'dynid excite' writes it) or a recording of it");
  }
  if (train.sources.size() != 1) {
    throw std::invalid_argument("--tracked goes with one recording, of the same samples");
  }
  const MotionSource commanded =
      commanded_motion(load_motion(options.tracked, options.map, options.robot), options.tracked,
                       train.sources.front());
  const Estimate start = weighted_least_squares(report.data.summary.equations);
  try {
    report.data.instruments = simulated_instruments(report.robot.linear, train.sources.front(),
                                                    commanded, options.rows, start.beta);
  } catch (const std::runtime_error& error) {
    throw TooLittleDataError(fmt::format(
        "method iv: the model that least squares give cannot track the commanded motion: "
        "{}",
        error.what()));
  }
}

/// "arm.robot" -> "arm.NAME.robot"
std::string path_of_robot(const std::string& output, const std::string& name) {
  const std::size_t dot = output.rfind('.');
  const std::size_t slash = output.rfind('/');
  const bool has_ending = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  const std::size_t cut = has_ending ? dot : output.size();
  return output.substr(0, cut) + "." + (name.empty() ? "unnamed" : name) + output.substr(cut);
}

/// File by file, in several processes if there are any.
void load_by_file(const ToolOptions& options, ProcessGroup& group, ProgressLine& progress,
                  FitReport& report) {
  if (options.heldout_part > 0) {
    throw std::invalid_argument(
        "--holdout-part goes with recordings that are given directly, to one process: "
        "hold whole recordings out by --holdout");
  }
  FileSummaries found = summarise_files(report.robot, options, group, progress);
  report.data.summary = std::move(found.sum);
  report.notes.insert(report.notes.end(), found.notes.begin(), found.notes.end());
}

/// What summaries cannot answer is said before hours are spent on them.
void check_what_is_summed_up(const ToolOptions& options, bool file_by_file, bool summaries) {
  if (options.own_friction && (file_by_file || !summaries)) {
    throw std::invalid_argument(
        "--own-friction goes with .qr files of named robots that are given directly, not by --list "
        "and not to several processes: see 'dynid accumulate --name'");
  }
  if (!file_by_file && !summaries) return;
  for (const FitMethod method : options.fit.methods) {
    if (!needs_samples(method)) continue;
    throw std::invalid_argument(fmt::format(
        "method {} looks at single samples: it needs recordings that are given directly, not sums "
        "of them",
        fit_method_names()[static_cast<std::size_t>(method)]));
  }
}

std::vector<FitMethod> methods_of(const ToolOptions& options, const FitData& data) {
  if (!options.every_method) return options.fit.methods;
  std::vector<FitMethod> methods =
      options.fit.methods.empty() ? std::vector<FitMethod>{FitMethod::kWls} : options.fit.methods;
  for (std::size_t i = 0; i < fit_method_names().size(); ++i) {
    const FitMethod method = static_cast<FitMethod>(i);
    const bool possible =
        (data.rows || !needs_samples(method)) && (data.instruments || method != FitMethod::kIv);
    if (possible && std::find(methods.begin(), methods.end(), method) == methods.end()) {
      methods.push_back(method);
    }
  }
  return methods;
}

/// What held numbers cannot go with.
void refuse_with_hold(const ToolOptions& options, const HeldNumbers& held, bool file_by_file,
                      bool summaries) {
  if (options.hold.empty()) return;
  if (file_by_file && held.deviations.size() > 0) {
    throw std::invalid_argument(
        "--hold with standard deviations (+-) goes with recordings that are given directly to one "
        "process, not with --list or mpirun");
  }
  if (summaries) {
    throw std::invalid_argument(
        "--hold goes with recordings, not with .qr files: those are sums over all parameters");
  }
  if (options.consistent) {
    throw std::invalid_argument(
        "--hold and --consistent: expected one of them. Bodies that can exist are near the file's "
        "numbers, and change with each other");
  }
  const auto& methods = options.fit.methods;
  if (std::find(methods.begin(), methods.end(), FitMethod::kIv) != methods.end()) {
    throw std::invalid_argument(
        "--hold and --method iv: expected another method, since the instruments are simulated with "
        "all parameters");
  }
}

/// Elasticities of the robot file's effects, as fitted.
std::vector<ElasticityElsewhere> elasticity_of(const FitReport& report) {
  std::vector<ElasticityElsewhere> found;
  if (!report.effects) return found;
  const EffectFit& fit = report.effects->fit;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const EffectInstance& effect = fit.point.effects[k];
    if (effect.law.family != "joint_elasticity" || effect.joint < 0) continue;
    for (std::size_t p = 0; p < fit.parameters[k].size(); ++p) {
      if (effect.law.parameters[p].name != "c") continue;
      found.push_back({effect.joint, fit.parameters[k][p].value, fit.parameters[k][p].stddev,
                       "the effect", true});
    }
  }
  return found;
}

/// How far the fit can be trusted, and what the recordings do not see.
void examine(FitReport& report, ProgressLine& progress) {
  progress.show("trust", 0, 1);
  const RecordingSummary& summary = report.data.summary;
  report.trust = measure_trust(summary.equations, report.main().estimate, summary.regressor_noise,
                               summary.row_time);
  warn_of_hidden_directions(report);
  report.conditioning = examine_conditioning(report);
  // what a method leaves out on purpose is not what the data do not see
  const Estimate plain = weighted_least_squares(summary.equations);
  report.unseen = name_unseen(plain, report.robot.linear, summary.extent);
  const Estimate& told = report.main().estimate;
  report.together = name_seen(plain, report.robot.linear, told.beta, told.covariance);
}

/// The JSON and the page, before the robot files: an answer is not lost with one of them.
/// @return  paths of the page and its figures
std::vector<std::string> write_outputs(const ToolOptions& options, FitReport& report,
                                       const std::vector<MotionSource>& motions,
                                       ProgressLine& progress) {
  LateError late;
  if (is_description_name(options.output)) {
    progress.show("bodies of " + options.output, 0, 1);
    late.during([&] {
      report.written_back = made_description(options, identified_file(report),
                                             identified_comment(report, true), motions);
    });
    progress.clear();
  }
  std::vector<OutputFile> answer;
  if (!options.json.empty()) answer.push_back({options.json, fit_json(report)});
  std::vector<std::string> made = write_with_page(
      options.page, [&] { return fit_document(report, options.page.command); }, progress,
      std::move(answer));
  late.rethrow();
  if (report.written_back) write_description(*report.written_back);
  if (options.output.empty() || report.written_back) return made;
  std::vector<OutputFile> robots = {{options.output, identified_file(report)}};
  for (std::size_t i = 0; report.hierarchy && i < report.hierarchy->robots.size(); ++i) {
    robots.push_back({path_of_robot(options.output, report.hierarchy->robots[i].name),
                      identified_file(report, i)});
  }
  write_robot_files(robots);
  return made;
}

/// Motions of a fit, and whether held-out ones were asked for and have no equations.
struct FitMotions {
  LoadedRecordings train, heldout;
  bool nothing_heldout = false;
};

/// Recordings in memory, their equations, and the fit of effects.
void load_motions(const EffectTask& task, const ToolOptions& options, ProgressLine& progress,
                  FitReport& report, FitMotions& motions) {
  const LinearModel& model = report.robot.linear;
  auto& [train, heldout, nothing] = motions;
  const bool with_effects = !task.effects.empty();
  const ToolOptions reading = task.reading(options);
  train = load_recordings(options.recordings, reading, false, progress);
  heldout = load_recordings(options.heldout, reading, true, progress);
  hold_standing(model, train, heldout, options);
  hold_out_parts(options.heldout_part, train, heldout, options);
  settle_cutoff(with_effects || model.held ? nullptr : &model, train, heldout, reading, progress);
  for (std::string& remark : judge_recordings(report.robot, train.sources, options, progress)) {
    report.notes.push_back(std::move(remark));
  }
  if (with_effects) {
    fit_with_effects(task, options, train.sources, heldout.sources, progress, report);
  } else {
    report.data.summary = summarise_together(model, train, options, progress);
    report.data.rows = joined(rows_of_all(model, train.sources, options));
    make_instruments(options, train, report);
  }
  report.recordings = train.lines;
  report.notes.insert(report.notes.end(), train.left_out.begin(), train.left_out.end());
}

/// Equations of held-out recordings, of files or summaries too.
void hold_out(bool with_effects, const ToolOptions& options, ProgressLine& progress,
              FitReport& report, FitMotions& motions) {
  LoadedRecordings& heldout = motions.heldout;
  if (!options.heldout.empty() && heldout.sources.empty()) {
    heldout = load_recordings(options.heldout, options, true, progress);
  }
  if (!heldout.sources.empty()) {
    if (!with_effects) {
      const LinearModel& model = report.robot.linear;
      report.heldout_rows = joined(rows_of_all(model, heldout.sources, options));
      report.data.heldout = heldout_equations(model, heldout, options);
    }
    report.recordings.insert(report.recordings.end(), heldout.lines.begin(), heldout.lines.end());
  }
  report.notes.insert(report.notes.end(), heldout.left_out.begin(), heldout.left_out.end());
  const bool wanted = !options.heldout.empty() || options.heldout_part > 0;
  motions.nothing_heldout = wanted && !(report.data.heldout && report.data.heldout->samples() > 0);
  if (!motions.nothing_heldout) return;
  report.data.heldout.reset();
  report.heldout_rows = {};
}

void fit_parameters(const ToolOptions& options, const std::vector<MotionSource>& train,
                    ProgressLine& progress, FitReport& report) {
  FitOptions fit_options = options.fit;
  fit_options.prior = prior_of(report.robot.linear);
  fit_options.methods = methods_of(options, report.data);
  report.fits = fit_methods(report.robot.linear, report.data, fit_options,
                            [&](const std::string& what, double done) {
                              progress.show(what, static_cast<std::size_t>(100 * done), 100);
                            });
  add_held_uncertainty(train, options, report);
}

/// Trust in the numbers, and numbers that no body has.
void judge_parameters(FitReport& report, ProgressLine& progress) {
  const LinearModel& model = report.robot.linear;
  if (model.size() == 0) return;
  examine(report, progress);
  const MethodFit& fit = report.main();
  const VectorXd deviations = fit.estimate.covariance.size() > 0 ? fit.stddev() : VectorXd();
  for (std::string& note : notes_of_negatives(model, fit.estimate.beta, deviations, fit.interval)) {
    report.notes.push_back(std::move(note));
  }
}

/// What recordings say beside the equations: two encoders, ripple, steady speeds.
void look_beside(bool with_effects, const ToolOptions& options,
                 const std::vector<MotionSource>& train, ProgressLine& progress,
                 FitReport& report) {
  const LinearModel& model = report.robot.linear;
  const DecisionRules& rules = options.diagnose.diagnosis.rules;
  if (!joints_with_two_encoders(train).empty()) {
    std::optional<LoadModel> load;  // beside effects the fit's own
    if (with_effects) {
      load = LoadModel{report.main().estimate.beta, report.main().estimate.covariance};
    }
    report.two_encoders =
        two_encoders_of(report.robot, load, train, options, rules.wind_up, progress);
    compare_elasticity(report.two_encoders, elasticity_of(report));
  }
  if (!with_effects && model.size() > 0) {
    const std::vector<RippleRun> runs = ripple_runs(model, report.main().estimate.beta, train);
    report.ripples = ripples_of(model, runs, gears_of_map(options), {}, rules.ripple, progress);
  }
  report.steady = steady_of(report.robot, train, rules.steady, progress);
}

/// @return the exit code, after a sentence where the answer has a gap
int told_gaps(const FitReport& report, bool nothing_heldout) {
  if (nothing_heldout) {
    std::cerr
        << "dynid: what was held out has no equations: nothing is known of the fit beyond the "
           "recordings that were fitted\n";
  }
  if (!report.unseen.empty()) {
    std::cerr << fmt::format(
        "dynid: these recordings do not determine {} combination{} of parameters (listed above)\n",
        report.unseen.size(), report.unseen.size() == 1 ? "" : "s");
    return kCannotAnswer;
  }
  if (report.effects && !report.effects->fit.all_seen()) {
    std::cerr << "dynid: these recordings do not determine all parameters of the effects (listed "
                 "above)\n";
    return kCannotAnswer;
  }
  return nothing_heldout ? kCannotAnswer : kDone;
}

}  // namespace

int run_fit(const ToolOptions& options, ProcessGroup& group) {
  ProgressLine progress("dynid");
  check_write_back(options);
  FitReport report;
  report.robot = describe_robot(options.robot, opened_by(options), {.hold = options.hold});
  const bool file_by_file = !options.list.empty() || group.size() > 1;
  const bool summaries = !file_by_file && are_summaries(options.recordings);
  check_what_is_summed_up(options, file_by_file, summaries);
  const EffectTask task = EffectTask::of(report.robot, options);
  const bool with_effects = !task.effects.empty();
  if (with_effects) {
    refuse_with_effects(options, file_by_file, summaries);
  } else {
    refuse_without_parameters(report.robot);
  }
  refuse_with_hold(options, report.robot.held, file_by_file, summaries);
  report.notes = notes_of_numbers(report.robot, has_open_payload(task.effects));
  for (std::string& remark : repeated_recordings(options)) {
    report.notes.push_back(std::move(remark));
  }
  FitMotions motions;
  if (file_by_file) {
    load_by_file(options, group, progress, report);
  } else if (summaries) {
    load_summaries(options, report);
  } else {
    load_motions(task, options, progress, report, motions);
  }
  hold_out(with_effects, options, progress, report, motions);
  const std::vector<MotionSource>& train = motions.train.sources;
  if (!with_effects) fit_parameters(options, train, progress, report);
  take_percentages_of_recorded_torque(train, motions.heldout.sources, options, report);
  judge_parameters(report, progress);
  look_beside(with_effects, options, train, progress, report);
  if (options.consistent) {
    progress.show("physical consistency", 0, 1);
    report.consistent = fit_consistently(report);
  }
  warn_of_held_out(report);
  progress.clear();
  std::cout << fit_table(report) << std::flush;
  const std::vector<std::string> made = write_outputs(options, report, train, progress);
  progress.clear();
  tell_written(made);
  return told_gaps(report, motions.nothing_heldout);
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/fit_with_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/effects/effect_residual.h"
#include "runtime/effects/effect_start.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/fit/held_uncertainty.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

RowSource shared_rows(std::vector<RowBlock> blocks) {
  return [kept = std::make_shared<const std::vector<RowBlock>>(std::move(blocks))](
             const std::function<void(const RowBlock&)>& visit) {
    for (const RowBlock& block : *kept) visit(block);
  };
}

/// rms of the model alone, on equations of recordings with effects.
VectorXd rms_without(const EffectRecordings& data, const EffectPoint& with, const VectorXd& beta) {
  // the same equations count: lateness leaves some out
  EffectPoint plain = with;
  plain.beta = beta;
  plain.initial.clear();
  std::erase_if(plain.effects, [](const EffectInstance& effect) {
    return effect.law.kind != EffectKind::kAlignment;
  });
  for (EffectInstance& effect : plain.effects) effect.parameters.setZero();
  return residual_with_effects(data, plain);
}

FitMethod method_of(const ToolOptions& options) {
  return options.fit.methods.empty() ? FitMethod::kWls : options.fit.methods.front();
}

/// Joints of effects with states.
std::vector<bool> remembering_joints(const std::vector<EffectInstance>& effects, int joints) {
  std::vector<bool> remembering(static_cast<std::size_t>(joints), false);
  for (const EffectInstance& effect : effects) {
    if (effect.law.states.empty()) continue;
    for (const int joint : {effect.joint, effect.other}) {
      if (joint >= 0) remembering[static_cast<std::size_t>(joint)] = true;
    }
  }
  return remembering;
}

}  // namespace

EffectTask EffectTask::of(const DescribedRobot& robot, const ToolOptions& options) {
  EffectTask task{effect_catalogue(options.effects), {}};
  task.effects = effect_instances(robot.model, task.catalogue);
  return task;
}

ToolOptions EffectTask::reading(ToolOptions options) const {
  if (effects.empty()) return options;
  options.motion.stream_above = std::numeric_limits<std::size_t>::max();
  for (const EffectInstance& effect : effects) {
    for (const std::string& variable : effect.law.variables) {
      if (variable == "t" || variable == "temp") options.motion.average_periods = false;
    }
  }
  return options;
}

void refuse_with_effects(const ToolOptions& options, bool file_by_file, bool summaries) {
  if (summaries) {
    throw std::invalid_argument(
        "the robot file has rows 'effect', and effects are fitted to samples: .qr files are sums "
        "of them; give the recordings");
  }
  if (file_by_file) {
    throw std::invalid_argument(
        "the robot file has rows 'effect', and effects are fitted to all samples at once: give the "
        "recordings directly, not by --list and not to several processes");
  }
  const bool other =
      options.every_method ||
      std::any_of(options.fit.methods.begin(), options.fit.methods.end(), [](FitMethod method) {
        return method != FitMethod::kWls && method != FitMethod::kLs;
      });
  if (other || options.fit.methods.size() > 1) {
    throw std::invalid_argument(
        "the robot file has rows 'effect': expected one of --method wls and --method ls, the "
        "methods that know constraints");
  }
}

void fit_with_effects(const EffectTask& task, const ToolOptions& options,
                      const std::vector<MotionSource>& train,
                      const std::vector<MotionSource>& heldout, ProgressLine& progress,
                      FitReport& report) {
  const LinearModel& model = report.robot.linear;
  const EffectRobot robot = effect_robot(report.robot);
  const std::vector<bool> remembering = remembering_joints(task.effects, model.joints());
  const EffectRecordings data = effect_recordings(model, robot, train, options.rows, remembering);
  const FitMethod method = method_of(options);
  EffectFitOptions settings;
  settings.weighted = method == FitMethod::kWls;
  EffectReport effects;
  effects.fit =
      fit_effects(data, task.effects, settings, [&](const std::string& what, double done) {
        progress.show(what, static_cast<std::size_t>(100 * done), 100);
      });
  add_held_uncertainty(report.robot, data, effects.fit);
  effects.units = effect_units(task.effects, task.catalogue, model);
  const EffectPoint& point = effects.fit.point;

  // what the effects leave for the model, as everything else in the report sees it
  RecordingSummary summary = empty_summary(model.columns, model.size());
  for (const MotionSource& source : train) {
    merge(summary, summarise_without_noise(model, source, options.rows));
  }
  report.data.rows = shared_rows(without_effects(data, point));
  summary.equations = factor_of(report.data.rows, model.columns, model.size());
  summary.noise = noise_at(effects.fit.base, summary.equations, report.data.rows);
  report.data.summary = std::move(summary);

  report.ripples =
      ripples_of(model, ripple_runs(data, point), gears_of_map(options), ripples_in(point.effects),
                 options.diagnose.diagnosis.rules.ripple, progress);

  MethodFit fit;
  fit.method = method;
  fit.estimate = effects.fit.base;
  fit.textbook = effects.fit.textbook;
  fit.interval = effects.fit.interval;
  fit.percent = residual_of(report.data.summary.equations, point.beta).percent;
  if (!heldout.empty()) {
    const EffectRecordings left =
        effect_recordings(model, robot, heldout, options.rows, remembering);
    EffectPoint begun = point;
    begun.initial.clear();
    effects.heldout_rms_without = rms_without(left, begun, effects.fit.beta_without);
    report.heldout_rows = shared_rows(without_effects(left, begun));
    report.data.heldout = factor_of(report.heldout_rows, model.columns, model.size());
    const Residual residual = residual_of(*report.data.heldout, point.beta);
    effects.heldout_rms = fit.heldout_rms = residual.rms;
    fit.heldout_percent = residual.percent;
  }
  if (!effects.fit.converged) {
    fit.messages.push_back("the search for the effects' parameters did not come to its end");
  }
  const bool remembers =
      std::find(remembering.begin(), remembering.end(), true) != remembering.end();
  if (options.rows.still_speed < 0 && remembers) {
    report.notes.push_back(
        "effects: joints with memory keep their equations where they stand still (--still SPEED "
        "leaves them out)");
  }
  if (options.motion.average_periods && !task.reading(options).motion.average_periods) {
    report.notes.push_back("effects: periods are not averaged, since an effect reads the time");
  }
  report.fits = {std::move(fit)};
  report.effects = std::move(effects);
}

RowSource rows_beside_effects(const EffectTask& task, const DescribedRobot& robot,
                              const ToolOptions& options, const MotionSource& source,
                              const VectorXd& beta) {
  for (const EffectInstance& effect : task.effects) {
    for (int p = 0; p < effect.law.size(); ++p) {
      const EffectParameter& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
      if (parameter.role == EffectRole::kGiven || !std::isnan(effect.parameters[p])) continue;
      throw ModelError(
          fmt::format("{}: error: '{}' of effect {} has no number; 'dynid fit' finds it\n",
                      robot.file.file_name, parameter.name, effect.law.name));
    }
  }
  const EffectRecordings data =
      effect_recordings(robot.linear, effect_robot(robot), {source}, options.rows,
                        remembering_joints(task.effects, robot.linear.joints()));
  const std::vector<EffectInstance> effects = with_starts(ScaleTable(data), beta, task.effects);
  return shared_rows(without_effects(data, at_rest(data, beta, effects)));
}

}  // namespace dyngen::runtime

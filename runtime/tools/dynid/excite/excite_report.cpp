// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "runtime/estimation/least_squares.h"
#include "runtime/excitation/chosen_points.h"
#include "runtime/excitation/multistage.h"
#include "runtime/identification/summary_file.h"
#include "runtime/tools/dynid/excite/excite_values.h"
#include "runtime/tools/dynid/recordings/summed.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Progress = std::function<void(const std::string&, std::size_t, std::size_t)>;

std::vector<int> asked_parameters(const LinearModel& model, const std::vector<std::string>& words) {
  static const std::map<std::string, ParameterKind> kinds = {
      {"inertial", ParameterKind::kInertial},
      {"rotor", ParameterKind::kRotorInertia},
      {"viscous", ParameterKind::kViscous},
      {"coulomb", ParameterKind::kCoulomb},
      {"offset", ParameterKind::kOffset}};
  std::vector<bool> asked(model.parameters.size(), words.empty());
  for (const std::string& word : words) {
    bool known = kinds.contains(word);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const LinearParameter& parameter = model.parameters[i];
      const bool fits =
          parameter.name == word || (kinds.contains(word) && kinds.at(word) == parameter.kind);
      if (fits) asked[i] = known = true;
    }
    if (!known) {
      throw std::invalid_argument(fmt::format(
          "--parameters: {} has no parameter '{}'; expected names of its base parameters, or "
          "inertial, rotor, viscous, coulomb, offset",
          model.name, word));
    }
  }
  std::vector<int> places;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (asked[i]) places.push_back(static_cast<int>(i));
  }
  if (places.empty()) {
    throw std::invalid_argument(fmt::format("--parameters: {} has none of these", model.name));
  }
  return places;
}

/// Of --prior: .qr files, and recordings, which are summed up as 'dynid accumulate' does.
TorqueFactor earlier_equations(const DescribedRobot& robot, const ToolOptions& options,
                               ProgressLine& progress) {
  const LinearModel& model = robot.linear;
  RobotSummaries all = empty_summaries(model);
  std::vector<std::string> recordings;
  for (const std::string& path : options.excite.prior) {
    if (!path.ends_with(".qr") && !is_summary_file(path)) {
      recordings.push_back(path);
      continue;
    }
    try {
      merge(all, read_summary_file(path));
    } catch (const std::invalid_argument& error) {
      throw SummaryFileError(
          fmt::format("{}: error: it is not of the robot {}: {}", path, model.name, error.what()));
    }
  }
  if (!recordings.empty()) {
    RecordingSummary sum = empty_summary(model.columns, model.size());
    if (!add_recordings_to(sum, robot, recordings, options, progress)) {
      throw TooLittleDataError("--prior: the earlier recordings have no equations");
    }
    RobotSummaries own = empty_summaries(model);
    own.robots.emplace("", std::move(sum));
    merge(all, own);
  }
  return pooled(all).equations;
}

/// Noise and prior information; noise that nobody gave is the earlier recordings' residual, or 1.
void set_information(ExciteReport& report, const TorqueFactor& earlier,
                     InformationOptions& information) {
  const LinearModel& model = report.robot.linear;
  const Index n = model.joints();
  report.noise = VectorXd::Ones(n);
  if (!report.options.noise.empty()) {
    report.noise = one_or_each(report.options.noise, n, "--noise");
  }
  if (!report.options.prior.empty()) {
    if (report.options.noise.empty()) {
      report.noise = weighted_least_squares(earlier).joint_weights.cwiseInverse();
    }
    const MatrixXd W = stacked(earlier, report.noise.cwiseInverse()).W;
    information.prior = (W.transpose() * W)(report.parameters, report.parameters);
    report.prior = true;
  } else if (report.options.noise.empty()) {
    report.notes.emplace_back(
        "--noise: not given; standard deviations are for torque noise of 1 N m at every joint");
  }
  // a condition number speaks of the regressor itself, unless noise is given
  if (report.options.chosen_criterion() != "condition" || !report.options.noise.empty() ||
      report.prior) {
    information.torque_noise = report.noise;
  }
}

CriterionOptions criterion_of(const ExciteOptions& options) {
  static const std::map<std::string, Criterion> criteria = {{"condition", Criterion::kCondition},
                                                            {"d", Criterion::kDeterminant},
                                                            {"a", Criterion::kTrace},
                                                            {"sigma", Criterion::kSmallest}};
  return {.criterion = criteria.at(options.chosen_criterion()),
          .unit_columns = options.unit_columns};
}

MotionWorth worth_of(const ExciteReport& report, const JointMotion& motion, const MatrixXd& prior) {
  const LinearModel& model = report.robot.linear;
  MotionWorth worth;
  worth.condition = condition_number(model, motion, report.parameters);
  worth.unit_condition = condition_number(model, motion, report.parameters, true);
  const int passes = report.repeats ? report.periods : 1;
  const InformationOptions white{.torque_noise = report.noise,
                                 .parameters = report.parameters,
                                 .samples = static_cast<double>(motion.q.rows()) * passes,
                                 .prior = prior};
  worth.deviations = standard_deviations(information_of(model, motion, white).R);
  return worth;
}

/// One period at the rate of the file, its end left out.
JointMotion one_period(const TrajectoryFamily& family, const MatrixXd& x, Index samples) {
  return basis_at(family, period_times(family, samples)).motion(x);
}

void find_periodic(ExciteReport& report, const TorqueFactor& earlier, const Progress& progress) {
  const ExciteOptions& options = report.options;
  ExcitationOptions search;
  search.family.form =
      options.form == "fourier" ? TrajectoryForm::kFourier : TrajectoryForm::kSpline;
  search.family.duration = report.duration;
  search.family.harmonics = options.harmonics;
  search.criterion = criterion_of(options);
  search.information.parameters = report.parameters;
  search.information.samples = static_cast<double>(report.samples) * report.periods;
  search.starts = options.starts;
  search.seed = options.seed;
  search.seconds = options.seconds;
  search.evaluations = options.evaluations;
  search.check_rate = kCheckRate;
  search.progress = progress;
  set_information(report, earlier, search.information);
  const Excitation excitation = excite(report.robot.linear, report.limits, search);
  report.found = excitation.found;
  report.message = excitation.message;
  report.shares = excitation.shares;
  report.starts = excitation.starts;
  report.evaluations = excitation.evaluations;
  if (!report.found) return;
  const MatrixXd& prior = search.information.prior;
  const JointMotion period = one_period(search.family, excitation.x, report.samples);
  report.worth = worth_of(report, period, prior);
  report.random =
      worth_of(report, one_period(search.family, excitation.random, report.samples), prior);
  report.trajectory = repeated(period, report.periods, report.duration);
}

/// The thesis's algorithm from several starts; each goes on until nothing is gained.
void find_multistage(ExciteReport& report, const Progress& progress) {
  constexpr int kIterations = 200;
  const ExciteOptions& options = report.options;
  const LinearModel& model = report.robot.linear;
  report.repeats = false;
  InformationOptions information;
  set_information(report, {}, information);
  MultistageOptions descent{
      .parameters = report.parameters,
      .iterations = options.evaluations > 0 ? options.evaluations : kIterations,
      .seconds = options.evaluations > 0 ? std::numeric_limits<double>::infinity()
                                         : options.seconds / options.starts};
  MultistageResult best;
  for (int i = 0; i < options.starts; ++i) {
    progress(fmt::format("start {} of {}", i + 1, options.starts), static_cast<std::size_t>(i),
             static_cast<std::size_t>(options.starts));
    ExcitationStart start{.seed = options.seed + static_cast<std::uint64_t>(i)};
    const HeldAccelerations first =
        through_chosen_points(model, report.limits, report.parameters,
                              {.samples = report.samples,
                               .sample_time = report.duration / report.samples,
                               .seed = start.seed});
    const JointMotion motion = first.motion();
    if (limit_shares(model, report.limits, motion).largest() > 1) continue;
    MultistageResult result = multistage(model, report.limits, first, descent);
    start.random = condition_number(model, motion, report.parameters);
    start.optimised = condition_number(model, result.trajectory.motion(), report.parameters);
    report.evaluations += static_cast<int>(result.cost.size());
    report.starts.push_back(start);
    if (report.starts.size() == 1) report.random = worth_of(report, motion, {});
    if (best.cost.empty() || result.cost.back() < best.cost.back()) best = std::move(result);
  }
  if (best.cost.empty()) {
    report.message = "no motion through chosen points keeps the limits";
    return;
  }
  const std::optional<HeldAccelerations> whole =
      brought_to_rest(model, report.limits, best.trajectory);
  if (!whole) {
    report.message = "the trajectory found cannot be brought to rest within the limits";
    return;
  }
  report.message = fmt::format("1/sigma from {:.4g} to {:.4g}; ended: {}", best.cost.front(),
                               best.cost.back(), best.ended);
  const HeldAccelerations fine =
      resampled(*whole, static_cast<int>(std::ceil(kCheckRate * whole->sample_time)));
  report.shares = limit_shares(model, report.limits, fine.motion());
  report.found = report.shares.largest() <= 1;
  if (!report.found) {
    report.message = fmt::format(
        "between samples {:.4f} of a limit is used: a smaller --limits or "
        "a higher --rate may help",
        report.shares.largest());
    return;
  }
  const JointMotion motion = whole->motion();
  report.worth = worth_of(report, motion, {});
  const Index rows = motion.q.rows();
  report.trajectory = {
      VectorXd::LinSpaced(rows, 0, static_cast<double>(rows - 1)) * whole->sample_time, motion.q,
      motion.dq, motion.ddq};
}

}  // namespace

ExciteReport make_excite_report(const ToolOptions& tool, ProgressLine& progress) {
  ExciteReport report;
  const ExciteOptions& options = tool.excite;
  report.options = options;
  const Progress tell = [&](const std::string& what, std::size_t place, std::size_t all) {
    progress.show(what, place, all);
  };
  report.robot = describe_robot(tool.robot, OpenParameters::kAbsentRows, {.gradient = true});
  RobotLimits limits = limits_of(report.robot, asked_limits(options));
  report.limits = std::move(limits.limits);
  report.notes = std::move(limits.notes);
  report.parameters = asked_parameters(report.robot.linear, options.parameters);
  const PeriodOfRows period = period_of_rows(options);
  report.duration = period.duration;
  report.samples = period.samples;
  report.periods = options.periods.value_or(kUsualPeriods);
  if (!period.note.empty()) report.notes.push_back(period.note);
  if (options.form == "multistage") {
    find_multistage(report, tell);
  } else {
    const TorqueFactor earlier =
        options.prior.empty() ? TorqueFactor{} : earlier_equations(report.robot, tool, progress);
    find_periodic(report, earlier, tell);
  }
  return report;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/separation_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include "runtime/tools/dynid/effects/effect_formula.h"
#include "runtime/tools/dynid/effects/effect_hypotheses.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"
#include "runtime/tools/dynid/excite/excite_limits.h"
#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/excite/excite_values.h"
#include "runtime/tools/dynid/robot/file_values.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string place_text(const OpenFinding& finding) {
  return finding.joint == 0 ? "the whole robot" : fmt::format("joint {}", finding.joint);
}

void check_families(const OpenFinding& finding, const std::string& where,
                    const EffectCatalogue& catalogue) {
  std::set<std::string> families;
  for (const auto& file : catalogue.all()) families.insert(file->family);
  for (const std::string& family : finding.aliases) {
    if (families.contains(family)) continue;
    throw std::invalid_argument(
        fmt::format("{}: aliases: found '{}', which no effect is of; expected one of {}", where,
                    family, fmt::join(families, ", ")));
  }
}

bool has_parameters(const EffectLaw& law, const std::map<std::string, double>& parameters) {
  return law.parameters.size() == parameters.size() &&
         std::all_of(law.parameters.begin(), law.parameters.end(),
                     [&](const EffectParameter& own) { return parameters.contains(own.name); });
}

/// The effect whose name the file does not say: by its parameters, and by its formula where they do
/// not tell.
EffectInstance finding_effect(const OpenFinding& finding, const std::string& where,
                              const std::vector<EffectInstance>& possible,
                              const EffectCatalogue& catalogue) {
  const EffectInstance* match = nullptr;
  for (const EffectInstance& effect : possible) {
    const bool there = effect.law.family == finding.family && effect.joint + 1 == finding.joint &&
                       effect.other + 1 == finding.other &&
                       has_parameters(effect.law, finding.parameters);
    if (!there) continue;
    const bool same = effect_formula(*catalogue.find(effect.law.name)) == finding.formula;
    if (match == nullptr || same) match = &effect;
    if (same) break;
  }
  if (match == nullptr) {
    std::vector<std::string> names;
    for (const auto& [name, value] : finding.parameters) names.push_back(name);
    throw std::invalid_argument(fmt::format(
        "{}: no effect of the family {} can be on {} with the parameters {}; expected those of a "
        "file of the catalogue (a folder of one's own: --effects)",
        where, finding.family, place_text(finding), fmt::join(names, ", ")));
  }
  EffectInstance effect = *match;
  effect.parameters.resize(effect.law.size());
  for (int p = 0; p < effect.law.size(); ++p) {
    const EffectParameter& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
    effect.parameters[p] = finding.parameters.at(parameter.name);
    if (std::isfinite(effect.parameters[p])) continue;
    throw std::invalid_argument(fmt::format("{}.parameters.{}.value: found null, expected a number",
                                            where, parameter.name));
  }
  return effect;
}

bool is_rival(const EffectInstance& effect, const OpenFinding& finding) {
  const auto& aliases = finding.aliases;
  if (effect.law.family == finding.family ||
      std::find(aliases.begin(), aliases.end(), effect.law.family) == aliases.end()) {
    return false;
  }
  return finding.joint == 0 || effect.joint < 0 || effect.law.acts_on_all ||
         effect.joint + 1 == finding.joint;
}

/// Parameters of the findings, else of the robot file.
VectorXd base_values(const OpenFinding& finding, const DescribedRobot& robot,
                     const RobotSource& source) {
  const auto size = static_cast<Index>(robot.linear.parameters.size());
  VectorXd found = VectorXd::Constant(size, std::numeric_limits<double>::quiet_NaN());
  for (Index i = 0; i < size; ++i) {
    const auto own =
        finding.base_parameters.find(robot.linear.parameters[static_cast<std::size_t>(i)].name);
    if (own != finding.base_parameters.end()) found[i] = own->second;
  }
  if (found.allFinite()) return found;
  const VectorXd written = file_values(
      robot, source,
      "since the findings do not have all base parameters of it: 'dynid fit' finds them");
  for (Index i = 0; i < size; ++i) {
    if (!std::isfinite(found[i])) found[i] = written[i];
  }
  return found;
}

void set_noise(SeparationReport& report) {
  const Index n = report.robot.linear.joints();
  const std::vector<double>& floor = report.finding.noise_floor;
  if (!report.options.noise.empty()) {
    report.noise = one_or_each(report.options.noise, n, "--noise");
    report.noise_from = "as told";
    return;
  }
  const bool known = static_cast<Index>(floor.size()) == n &&
                     std::all_of(floor.begin(), floor.end(),
                                 [](double sigma) { return std::isfinite(sigma) && sigma > 0; });
  report.noise = known ? VectorXd(Eigen::Map<const VectorXd>(floor.data(), n)) : VectorXd::Ones(n);
  report.noise_from =
      known ? "the noise floor of the findings" : "not known: 1 (--noise says it better)";
}

/// Below a hundredth of its largest speed a joint says nothing of friction
/// (docs/reference/diagnosis.md).
VectorXd still_speeds(const MotionLimits& limits) {
  constexpr double kPart = 0.01;
  const VectorXd without =
      (limits.acceleration.array() * (limits.upper - limits.lower).array() / 2).sqrt();
  VectorXd speeds = limits.speed;
  for (Index j = 0; j < speeds.size(); ++j) {
    if (!std::isfinite(speeds[j])) speeds[j] = without[j];
  }
  return kPart * speeds;
}

/// As many periods as tell the names apart, with room for a machine that is not as it was thought.
int periods_that_separate(const Separation& of_one) {
  constexpr double kRoom = 1.5;
  constexpr int kMostPeriods = 20;
  const double needed = std::ceil(kRoom * kSeparated / of_one.least);
  return static_cast<int>(std::clamp(needed, double{kUsualPeriods}, double{kMostPeriods}));
}

}  // namespace

Contest contest_of(const OpenFinding& finding, const std::string& path, const DescribedRobot& robot,
                   const std::vector<std::string>& effect_folders) {
  const int n = robot.linear.joints();
  const std::string where = fmt::format("{}: findings[{}]", path, finding.number - 1);
  if (finding.joints != n) {
    throw std::invalid_argument(fmt::format("{}: joints: found {}, expected {}, as {} has", path,
                                            finding.joints, n, robot.linear.name));
  }
  for (const auto& [key, joint] :
       {std::pair{"joint", finding.joint}, std::pair{"other_joint", finding.other}}) {
    if (joint <= n) continue;
    throw std::invalid_argument(
        fmt::format("{}.{}: found {}, expected at most {}, the joints of {}", where, key, joint, n,
                    robot.linear.name));
  }
  const EffectCatalogue catalogue = effect_catalogue(effect_folders);
  check_families(finding, where, catalogue);
  const std::vector<EffectInstance> possible = competing_effects(robot, catalogue, {});
  Contest contest{finding_effect(finding, where, possible, catalogue), {}};
  for (const EffectInstance& effect : possible) {
    if (is_rival(effect, finding)) contest.rivals.push_back(effect);
  }
  if (contest.rivals.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: aliases: found {}, of which none but its own can be on {}", where,
                    fmt::join(finding.aliases, ", "), place_text(finding)));
  }
  return contest;
}

SeparationReport make_separation_report(
    const RobotSource& robot, const ExciteOptions& options,
    const std::function<void(const std::string&, std::size_t, std::size_t)>& progress) {
  SeparationReport report;
  report.options = options;
  report.finding = read_open_finding(options.findings);
  report.robot = describe_robot(robot, OpenParameters::kAbsentRows);
  if (report.finding.robot != report.robot.linear.name) {
    report.notes.push_back(fmt::format("{}: the findings are of '{}', the file is of '{}'",
                                       options.findings, report.finding.robot,
                                       report.robot.linear.name));
  }
  Contest contest = contest_of(report.finding, options.findings, report.robot, options.effects);
  RobotLimits limits = limits_of(report.robot, asked_limits(options));
  report.limits = std::move(limits.limits);
  report.notes.insert(report.notes.end(), limits.notes.begin(), limits.notes.end());
  const PeriodOfRows period = period_of_rows(options);
  report.duration = period.duration;
  report.samples = period.samples;
  if (!period.note.empty()) report.notes.push_back(period.note);
  set_noise(report);
  report.effect = contest.finding;
  for (const std::string& family : report.finding.aliases) {
    if (family != report.finding.family) report.rivals.push_back(family);
  }

  SeparationProblem problem;
  problem.model = report.robot.linear;
  problem.robot = effect_robot(report.robot);
  problem.beta = base_values(report.finding, report.robot, robot);
  problem.finding = std::move(contest.finding);
  problem.rivals = std::move(contest.rivals);
  problem.noise = report.noise;
  problem.still_speed = still_speeds(report.limits);
  problem.rate = period.samples / period.duration;
  SeparatingOptions search;
  search.duration = period.duration;
  search.seed = options.seed;
  search.seconds = options.seconds;
  search.evaluations = options.evaluations;
  search.check_rate = kCheckRate;
  search.progress = progress;
  report.designed = separate(problem, report.limits, search);
  if (!report.designed.found) return report;
  const PlannedMotion& motion = report.designed.motion;
  report.periods = options.periods.value_or(periods_that_separate(report.designed.separation));
  report.trajectory =
      repeated(motion.at(instants(motion, period.samples)), report.periods, period.duration);
  return report;
}

}  // namespace dyngen::runtime

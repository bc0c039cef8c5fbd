// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/programme_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/tools/dynid/excite/excite_values.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A programme goes through whole ranges at stated speeds: nothing is assumed of them.
void refuse_without_limits(const DescribedRobot& robot) {
  Diagnostics diagnostics(robot.file.file_name, robot.file.source_text);
  for (const RowKey key : {RowKey::kQmin, RowKey::kQmax, RowKey::kVmax}) {
    const Row& row = robot.file.row(key);
    const std::string word(row_keyword(key));
    if (!row.present) {
      diagnostics.error(robot.file.last_word, 1,
                        fmt::format("there is no row '{}', expected one with a number for each "
                                    "joint: --archetype goes through these limits",
                                    word));
      continue;
    }
    for (std::size_t j = 0; j < row.values.size(); ++j) {
      if (!row.values[j].unknown || robot.model.joints[j].coordinate < 0) continue;
      diagnostics.error(
          row.values[j].position, row.values[j].length,
          fmt::format("found no limit in row '{}', expected a number: --archetype goes through it",
                      word));
    }
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

ProgrammeOptions programme_options(const ExciteOptions& options) {
  ProgrammeOptions asked;
  asked.kind = options.archetype == "speeds"  ? ProgrammeKind::kSpeeds
               : options.archetype == "poses" ? ProgrammeKind::kPoses
                                              : ProgrammeKind::kSweeps;
  asked.hold = options.hold;
  asked.count = options.count;
  for (const int joint : options.joints) asked.joints.push_back(joint - 1);
  asked.posture = Eigen::Map<const VectorXd>(options.posture.data(),
                                             static_cast<Index>(options.posture.size()));
  return asked;
}

void take_larger(LimitShares& all, const LimitShares& own) {
  const auto larger = [](VectorXd& a, const VectorXd& b) {
    a = a.size() == 0 ? b : VectorXd(a.cwiseMax(b));
  };
  larger(all.position, own.position);
  larger(all.speed, own.speed);
  larger(all.acceleration, own.acceleration);
  larger(all.torque, own.torque);
  all.distance = std::min(all.distance, own.distance);
}

/// Shares of the whole programme, some rows at a time.
LimitShares shares_of(const ProgrammeReport& report) {
  constexpr double kRowsAtOnce = 4096;
  LimitShares all;
  all.distance = std::numeric_limits<double>::infinity();
  const double rows = std::ceil(report.duration * kProgrammeCheckRate);
  for (double first = 0; first < rows; first += kRowsAtOnce) {
    const auto count = static_cast<Index>(std::min(kRowsAtOnce, rows - first));
    const VectorXd time =
        (VectorXd::LinSpaced(count, 0, static_cast<double>(count - 1)).array() + first) /
        kProgrammeCheckRate;
    take_larger(all,
                limit_shares(report.robot.linear, report.limits, report.programme.motion.at(time)));
  }
  return all;
}

/// Which limit is passed; empty: none.
std::string passed_limit(const ProgrammeReport& report) {
  const LimitShares& shares = report.shares;
  const auto joint_over = [&](const VectorXd& own, const char* what) -> std::string {
    Index joint = 0;
    if (own.maxCoeff(&joint) <= 1) return {};
    return fmt::format("joint {} uses {:.3f} of its limit of {}", joint + 1, own[joint], what);
  };
  for (const auto& [own, what] :
       {std::pair{&shares.position, "position"}, std::pair{&shares.speed, "speed"},
        std::pair{&shares.acceleration, "acceleration"}, std::pair{&shares.torque, "torque"}}) {
    std::string text = joint_over(*own, what);
    if (!text.empty()) return text + "; --limits or another --posture leaves more room";
  }
  if (shares.distance < 0) {
    return fmt::format(
        "the tool's point is {:.4f} m inside the box; --limits or another --posture may avoid it",
        -shares.distance);
  }
  return {};
}

}  // namespace

ProgrammeReport make_programme_report(const RobotSource& source, const ExciteOptions& options) {
  ProgrammeReport report;
  report.options = options;
  report.robot = describe_robot(source, OpenParameters::kAbsentRows);
  refuse_without_limits(report.robot);
  RobotLimits limits = limits_of(report.robot, asked_limits(options));
  report.limits = std::move(limits.limits);
  report.notes = std::move(limits.notes);
  report.asked = programme_options(options);
  report.programme = steady_programme(report.limits, report.asked);
  report.samples =
      static_cast<int>(std::ceil(report.programme.motion.duration * options.rate - 1e-9));
  report.duration = report.samples / options.rate;
  report.periods = options.periods.value_or(1);
  report.shares = shares_of(report);
  report.message = passed_limit(report);
  report.found = report.message.empty();
  if (!report.found) return report;
  const VectorXd time = VectorXd::LinSpaced(report.samples, 0, report.samples - 1.0) / options.rate;
  report.trajectory = repeated(report.programme.motion.at(time), report.periods, report.duration);
  return report;
}

std::vector<ProgrammeLine> programme_lines(const ProgrammeReport& report) {
  std::vector<ProgrammeLine> lines;
  for (const ProgrammeStep& step : report.programme.steps) {
    const auto own = std::find_if(lines.begin(), lines.end(), [&](const ProgrammeLine& line) {
      return line.joint == step.joint;
    });
    const double speed = std::abs(step.speed);
    if (own == lines.end()) {
      lines.push_back({step.joint, 1, speed, speed, step.seconds, step.seconds});
      continue;
    }
    ++own->steps;
    own->slowest = std::min(own->slowest, speed);
    own->fastest = std::max(own->fastest, speed);
    own->shortest = std::min(own->shortest, step.seconds);
    own->longest = std::max(own->longest, step.seconds);
  }
  return lines;
}

}  // namespace dyngen::runtime

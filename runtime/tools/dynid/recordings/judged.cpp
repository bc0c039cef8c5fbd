// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/recordings/judged.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include "gen/symbols/exact.h"
#include "runtime/tools/dynid/robot/row_values.h"

namespace dyngen::runtime {
namespace {

constexpr std::array<RowKey, 3> kGravityRows = {RowKey::kGx, RowKey::kGy, RowKey::kGz};

/// The model of the same file with other numbers in gx, gy and gz.
std::shared_ptr<const LinearModel> model_with_gravity(RobotFile file,
                                                      const Eigen::Vector3d& gravity) {
  for (std::size_t axis = 0; axis < kGravityRows.size(); ++axis) {
    Row& row = file.rows[static_cast<std::size_t>(kGravityRows[axis])];
    FieldValue value;
    constexpr int kHundredths = 100;
    value.value = GiNaC::numeric(std::lround(kHundredths * gravity[static_cast<long>(axis)])) /
                  GiNaC::numeric(kHundredths);
    row.present = true;
    row.values = {value};
  }
  auto robot = std::make_shared<DescribedRobot>(
      describe_robot(std::move(file), OpenParameters::kAbsentRows));
  return {robot, &robot->linear};
}

double reach_of(const RobotModel& model) {
  double reach = 0;
  for (const JointModel& joint : model.joints) {
    for (const Quantity* length : {&joint.d, &joint.r}) {
      if (!length->unknown) reach += std::abs(to_double(length->value));
    }
  }
  return reach;
}

}  // namespace

JudgedRobot judged_robot(const DescribedRobot& robot) {
  JudgedRobot judged;
  judged.model = &robot.linear;
  judged.lowest = row_values(robot, RowKey::kQmin);
  judged.highest = row_values(robot, RowKey::kQmax);
  judged.most_torque = row_values(robot, RowKey::kTaumax);
  judged.reach = reach_of(robot.model);
  for (std::size_t axis = 0; axis < kGravityRows.size(); ++axis) {
    judged.gravity[static_cast<long>(axis)] = to_double(robot.model.gravity[axis].value);
  }
  judged.with_gravity = [file = robot.file](const Eigen::Vector3d& gravity) {
    return model_with_gravity(file, gravity);
  };
  return judged;
}

std::vector<std::string> judge_recordings(const DescribedRobot& robot,
                                          const std::vector<MotionSource>& sources,
                                          const ToolOptions& options, ProgressLine& progress) {
  progress.show("judging recordings", 0, 1);
  // numbers that are held may be what is wrong: the recordings are judged beside a fit of all
  std::optional<DescribedRobot> open;
  if (robot.linear.held) open.emplace(describe_robot(robot.file, OpenParameters::kAbsentRows));
  const JudgedRobot judged = judged_robot(open ? *open : robot);
  std::vector<std::string> words;
  std::string refused, sentence;
  for (Remark& remark : judge(judged, sources)) {
    if (options.as_recorded) remark.refused = false;
    if (remark.refused) {
      refused += remark.words() + "\n";
      sentence += (sentence.empty() ? "" : "; ") + remark.text;
    } else {
      progress.clear();
      words.push_back(remark.words());
      std::cerr << words.back() << "\n";
    }
  }
  if (!refused.empty()) {
    throw ImplausibleError(
        refused +
            "dynid: recordings cannot be meant as they stand, so nothing was fitted "
            "to them\n(--as-recorded believes them)",
        "These recordings cannot be meant as they stand: " + sentence + ".");
  }
  return words;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "tests/studies/study_robot.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "gen/model/chi.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using runtime::OpenParameters;

VectorXd values(std::initializer_list<double> list) {
  return Eigen::Map<const VectorXd>(std::data(list), static_cast<Index>(list.size()));
}

/// A row of 14 parameters of every link, as DescribedRobot::standard.
VectorXd standard_of(const NumericRobot& robot) {
  constexpr Index kRow = kChiCount;
  VectorXd chi(kRow * static_cast<Index>(robot.size()));
  for (std::size_t j = 0; j < robot.size(); ++j) {
    const NumericJoint& joint = robot.joints[j];
    auto row = chi.segment(kRow * static_cast<Index>(j), kRow);
    for (Index k = 0; k < 10; ++k) row[k] = joint.inertial[static_cast<std::size_t>(k)];
    row.tail(4) << joint.IA, joint.Fv, joint.Fs, joint.off;
  }
  return chi;
}

/// Gear and encoder of each joint as the last digit on the joint's side.
double lines(double per_turn) { return 2 * std::numbers::pi / per_turn; }

void set_puma3(StudyRobot& robot) {
  robot.limits = {values({0, 1.57, -1.57}), values({1.8, 1.4, 1.6}), values({1.4, 1.0, 1.6}),
                  values({4, 3, 5})};
  robot.loop.encoder_step = values({lines(250e3), lines(430e3), lines(215e3)});
  robot.loop.torque_noise = values({1.0, 1.5, 0.7});
}

void set_ur10e(StudyRobot& robot) {
  robot.limits = {values({0, -1.4, 1.2, -1.0, 0.3, 0}), values({1.8, 1.0, 1.3, 1.6, 1.8, 2.2}),
                  values({1.5, 1.5, 2.2, 2.2, 2.2, 2.2}), values({4, 3, 5, 7, 8, 8})};
  robot.loop.encoder_step = VectorXd::Constant(6, lines(1 << 17));
  robot.loop.torque_noise = values({3.0, 3.0, 1.5, 0.5, 0.5, 0.5});
}

void set_panda(StudyRobot& robot) {
  robot.limits = {values({0, 0, 0, -1.6, 0, 1.9, 0}), values({2.2, 1.3, 2.2, 1.2, 2.2, 1.5, 2.2}),
                  values({1.7, 1.7, 1.7, 1.7, 2.0, 2.0, 2.0}), values({7, 5, 7, 8, 10, 12, 12})};
  robot.loop.encoder_step = VectorXd::Constant(7, lines(1 << 20));
  robot.loop.torque_noise = values({0.4, 0.5, 0.3, 0.4, 0.15, 0.12, 0.08});
}

}  // namespace

const std::vector<std::string>& study_robot_names() {
  static const std::vector<std::string> names = {"puma3", "ur10e", "panda"};
  return names;
}

StudyRobot study_robot(const std::string& name) {
  const std::string path = fmt::format("tests/studies/robots/{}.robot", name);
  StudyRobot robot;
  robot.name = name;
  if (name == "puma3") {
    set_puma3(robot);
  } else if (name == "ur10e") {
    set_ur10e(robot);
  } else if (name == "panda") {
    set_panda(robot);
  } else {
    throw std::invalid_argument(fmt::format("robot '{}': expected puma3, ur10e or panda", name));
  }
  // the PUMA's zeros are grouped into other parameters; the others' say nothing
  robot.described = runtime::describe_robot(
      std::string(DYNGEN_SOURCE_DIR "/") + path,
      name == "puma3" ? OpenParameters::kAsWritten : OpenParameters::kEverything);
  robot.truth = numeric_robot(read_model(path));
  robot.beta = robot.described.grouping * standard_of(robot.truth);
  set_gains(robot.truth, robot.limits.centre, 3, robot.loop);
  return robot;
}

}  // namespace dyngen::test

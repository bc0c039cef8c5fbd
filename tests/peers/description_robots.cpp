// SPDX-License-Identifier: MIT
#include "tests/peers/description_robots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

constexpr int kSamples = 3;

ByJoint random_state(std::mt19937& random, const std::vector<std::string>& joints, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  ByJoint result;
  for (const std::string& joint : joints) result[joint] = uniform(random);
  return result;
}

}  // namespace

struct OwnRobot::Parts {
  RobotFile file;
  RobotModel model;
  NumericRobot robot;
};

OwnRobot::OwnRobot(const RobotFile& file) : parts_(std::make_unique<Parts>()) {
  parts_->file = file;
  parts_->model = build_model(file);
  parts_->robot = numeric_robot(parts_->model);
  for (NumericJoint& joint : parts_->robot.joints) joint.Fs = 0;
}

OwnRobot::OwnRobot(const std::string& text, const std::string& name)
    : OwnRobot(parse_robot(text, name)) {}

OwnRobot::~OwnRobot() = default;

std::vector<std::string> OwnRobot::joints() const {
  std::vector<std::string> names;
  for (const JointModel& joint : parts_->model.joints) {
    if (joint.coordinate >= 0) names.push_back(joint.name);
  }
  return names;
}

ByJoint OwnRobot::torque(const ByJoint& q, const ByJoint& dq, const ByJoint& ddq) const {
  const std::vector<JointModel>& joints = parts_->model.joints;
  const std::vector<double> all = id<double>(parts_->robot, values(q), values(dq), values(ddq));
  ByJoint result;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (joints[j].coordinate >= 0) result[joints[j].name] = all[j];
  }
  for (const EffectRow& effect : parts_->file.effects) {
    std::map<std::string, double> settings;
    for (const EffectRow::Setting& own : effect.settings) {
      settings[own.key] = to_double(own.value.value);
    }
    const std::string& joint = joints[static_cast<std::size_t>(settings.at("joint")) - 1].name;
    result[joint] += settings.at("k") * q.at(joint) + settings.at("c");
  }
  return result;
}

std::vector<double> OwnRobot::values(const ByJoint& own) const {
  std::vector<double> result;
  for (const JointModel& joint : parts_->model.joints) {
    result.push_back(joint.coordinate < 0 ? 0 : own.at(joint.name));
  }
  return result;
}

void expect_same_torques(const OwnRobot& own, const TorqueRobot& peer, const std::string& what,
                         double tolerance) {
  std::mt19937 random(5);
  for (int sample = 0; sample < kSamples; ++sample) {
    const ByJoint q = random_state(random, own.joints(), 2),
                  dq = random_state(random, own.joints(), 2),
                  ddq = random_state(random, own.joints(), 3);
    const ByJoint found = own.torque(q, dq, ddq), expected = peer.torque(q, dq, ddq);
    double size = 0;
    for (const auto& [name, torque] : expected) size = std::max(size, std::fabs(torque));
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (const auto& [name, torque] : expected) {
      ASSERT_NEAR(found.at(name), torque, tolerance * size) << what << ", " << name;
    }
  }
}

}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
// Robots made up at random: what is made of their URDF against plain mechanics of their links.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/robot_output/robot_tree.h"
#include "tests/gen/robot_input/description_text.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

constexpr unsigned kRobots = 100;
constexpr double kTolerance = 1e-9;  // of the largest torque

/// A state in +-2 rad, +-2 rad/s, +-3 rad/s^2.
std::vector<double> random_values(std::mt19937& random, std::size_t count, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> values(count);
  for (double& value : values) value = uniform(random);
  return values;
}

std::vector<double> ordered(const std::vector<double>& values, const std::vector<int>& order) {
  std::vector<double> result;
  for (const int place : order) result.push_back(values[static_cast<std::size_t>(place)]);
  return result;
}

double largest(const std::vector<double>& values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::fabs(value));
  return size;
}

/// id without dry friction, by the judge of generated code.
std::vector<double> judged(const RobotModel& model, const std::vector<double>& q,
                           const std::vector<double>& dq, const std::vector<double>& ddq) {
  NumericRobot robot = numeric_robot(model);
  for (NumericJoint& joint : robot.joints) joint.Fs = 0;
  const std::vector<double> all =
      id<double>(robot, per_joint(model, q), per_joint(model, dq), per_joint(model, ddq));
  std::vector<double> result;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (model.joints[j].coordinate >= 0) result.push_back(all[j]);
  }
  return result;
}

void expect_torques(const RobotModel& model, const std::vector<MadeLink>& links,
                    const std::string& what) {
  const std::vector<int> order = depth_first(links);
  ASSERT_EQ(static_cast<std::size_t>(model.coordinate_count), order.size()) << what;
  std::mt19937 random(7);
  for (int sample = 0; sample < 5; ++sample) {
    const auto q = random_values(random, order.size(), 2);
    const auto dq = random_values(random, order.size(), 2);
    const auto ddq = random_values(random, order.size(), 3);
    const std::vector<double> expected = ordered(torques_of(links, q, dq, ddq), order);
    const std::vector<double> found =
        judged(model, ordered(q, order), ordered(dq, order), ordered(ddq, order));
    const double size = largest(expected);
    for (std::size_t j = 0; j < order.size(); ++j) {
      ASSERT_NEAR(found[j], expected[j], kTolerance * size) << what << ", joint " << j + 1;
    }
  }
}

TEST(Conversion, TorquesOfRandomUrdfsAreThoseOfTheirLinks) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotModel model = build_model(parse_robot(urdf_of(links), "made.urdf"));
    expect_torques(model, links, fmt::format("seed {}", seed));
  }
}

TEST(Conversion, GeneratedCodeHasTheTorquesToo) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    RobotModel model = build_model(parse_robot(urdf_of(links), "made.urdf"));
    const std::vector<int> order = depth_first(links);
    GeneratorOptions options = with_short_search({});
    options.functions = {"id_rigid"};
    const EvaluatedModel evaluated(model, options);
    std::mt19937 random(11);
    MotionSample sample;
    const auto q = random_values(random, order.size(), 2);
    const auto dq = random_values(random, order.size(), 2);
    const auto ddq = random_values(random, order.size(), 3);
    sample.q = ordered(q, order);
    sample.dq = ordered(dq, order);
    sample.ddq = ordered(ddq, order);
    std::vector<MadeLink> rigid = links;
    for (MadeLink& link : rigid) link.damping = 0;
    const std::vector<double> expected = ordered(torques_of(rigid, q, dq, ddq), order);
    const std::vector<double> found = evaluated.call("id_rigid", sample);
    for (std::size_t j = 0; j < order.size(); ++j) {
      EXPECT_NEAR(found[j], expected[j], kTolerance * largest(expected)) << "seed " << seed;
    }
  }
}

/// The links between two, with those that fixed joints hang on them.
std::vector<int> path_to(const std::vector<MadeLink>& links, int tip) {
  std::vector<int> path;
  for (int link = tip; link >= 0; link = links[static_cast<std::size_t>(link)].parent) {
    path.insert(path.begin(), link);
  }
  return path;
}

TEST(Conversion, TheTipIsTheLastFrame) {
  int tips = 0;
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const int tip = static_cast<int>(links.size()) - 1;
    std::vector<int> moving;  // coordinates of the chain
    int coordinate = 0;
    std::vector<int> place(links.size(), -1);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].type != 2) place[i] = coordinate++;
    }
    for (const int link : path_to(links, tip)) {
      if (place[static_cast<std::size_t>(link)] >= 0) {
        moving.push_back(place[static_cast<std::size_t>(link)]);
      }
    }
    if (moving.empty()) continue;
    ++tips;
    RobotSource source("made.urdf");
    source.tip = links.back().name;
    const RobotModel model = build_model(parse_robot(urdf_of(links), source));
    std::mt19937 random(seed);
    const auto q = random_values(random, static_cast<std::size_t>(coordinate), 2);
    const auto frames =
        forward_kinematics<double>(numeric_robot(model), per_joint(model, ordered(q, moving)));
    const Eigen::Matrix4d expected = frame_of(links, q, tip).matrix();
    EXPECT_LT((frames.back() - expected).cwiseAbs().maxCoeff(), 1e-12 * 10) << "seed " << seed;
  }
  EXPECT_GT(tips, 50);
}

/// The chain the other way round: the base is the tip and the tip the base.
TEST(Conversion, AChainMayBeRootedElsewhere) {
  for (unsigned seed = 3; seed <= 60; seed += 3) {  // chains
    const std::vector<MadeLink> links = made_robot(seed);
    int coordinates = 0;
    for (const MadeLink& link : links) coordinates += link.type == 2 ? 0 : 1;
    RobotSource source("made.urdf");
    source.base = links.back().name;
    source.tip = links.front().name;
    const RobotModel model = build_model(parse_robot(urdf_of(links), source));
    ASSERT_EQ(model.coordinate_count, coordinates);
    std::mt19937 random(seed);
    const auto q = random_values(random, static_cast<std::size_t>(coordinates), 2);
    std::vector<double> reversed(q.rbegin(), q.rend());
    const auto frames =
        forward_kinematics<double>(numeric_robot(model), per_joint(model, reversed));
    const Eigen::Matrix4d expected =
        frame_of(links, q, static_cast<int>(links.size()) - 1).inverse().matrix();
    EXPECT_LT((frames.back() - expected).cwiseAbs().maxCoeff(), 1e-11) << "seed " << seed;
  }
}

TEST(Conversion, RoundTripsKeepTheTorques) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotFile first = parse_robot(urdf_of(links), "made.urdf");
    const RobotFile own = parse_robot_file(first.text, "made.robot");
    const RobotModel model = build_model(own);
    for (const bool urdf : {true, false}) {
      const WrittenRobot written = urdf ? urdf_text(own, model) : mjcf_text(own, model);
      const RobotFile back = parse_robot(written.text, urdf ? "back.urdf" : "back.xml");
      expect_torques(build_model(back), links, fmt::format("seed {}, {}", seed, written.text));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace dyngen::test

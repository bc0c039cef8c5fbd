// SPDX-License-Identifier: MIT
#include "tests/support/body_robots.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "tests/support/central_inertia.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

/// Random numbers with a fixed meaning: the engine's bits are standard, a distribution's are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double within(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

double random_angle(Random& random) {
  const double quarter = std::acos(-1.0) / 2;
  return random.below(3) == 0 ? random.within(-3, 3) : quarter * (random.below(4) - 1);
}

double random_length(Random& random) { return random.below(2) == 0 ? 0 : random.within(-0.5, 0.5); }

NumericRobot random_robot(std::uint64_t seed, bool tree) {
  Random random(seed);
  NumericRobot robot;
  robot.standard = random.below(3) == 0;
  const bool drives = random.below(2) == 0;
  const int joints = tree ? 3 + random.below(6) : 1 + static_cast<int>(seed % 8);
  for (int j = 1; j <= joints; ++j) {
    NumericJoint joint;
    const int kind = random.below(10);
    joint.sigma = kind < 7 ? 0 : kind < 9 ? 1 : 2;
    if (j == joints && kind == 9) joint.sigma = 0;  // something must move
    joint.parent = tree ? random.below(j) : j - 1;
    joint.alpha = random_angle(random);
    joint.theta = random_angle(random);
    joint.d = random_length(random);
    joint.r = random_length(random);
    joint.inertial = random_body(random.seed());
    if (drives && joint.sigma != 2) {
      joint.IA = random.within(0, 1);
      joint.Fs = random.within(0, 1);
      joint.Fv = random.within(0, 1);
      joint.off = random.within(-1, 1);
    }
    robot.joints.push_back(joint);
  }
  for (double& component : robot.base_acceleration) component = random.within(-10, 10);
  return robot;
}

std::vector<NamedRobot> random_robots(int count, bool tree) {
  std::vector<NamedRobot> robots;
  for (int seed = 0; seed < count; ++seed) {
    robots.push_back({(tree ? "tree " : "chain ") + std::to_string(seed),
                      random_robot(static_cast<std::uint64_t>(seed), tree)});
  }
  return robots;
}

/// A tensor that some body without negative mass has about its centre: principal moments obey the
/// triangle inequality if and only if the covariance below has no negative eigenvalue.
bool is_solid(const NumericJoint& joint) {
  if (!is_body(joint)) return false;
  const CentralInertia link = central_inertia(joint);
  return link.xx >= 0 && link.yy >= 0 && link.zz >= 0;
}

}  // namespace

std::array<double, 10> random_body(std::uint64_t seed) {
  Random random(seed);
  const double mass = random.within(0.5, 5);
  const bool lined_up = random.below(2) == 0;
  Eigen::Vector3d com(random.within(-0.2, 0.2), random.within(-0.2, 0.2), random.within(-0.2, 0.2));
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (lined_up) {
    for (int k = 0; k < 3; ++k) {
      if (k != random.below(3)) com[k] = 0;
    }
  } else {
    turn = Eigen::Quaterniond(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1), 1.5)
               .normalized()
               .toRotationMatrix();
  }
  const Eigen::Vector3d spread(random.within(0.01, 0.1), random.within(0.01, 0.1),
                               random.within(0.01, 0.1));
  // Covariance about the origin, then J = tr(S) 1 - S.
  const Eigen::Matrix3d S =
      mass * (turn * spread.cwiseAbs2().asDiagonal() * turn.transpose() + com * com.transpose());
  const Eigen::Matrix3d J = S.trace() * Eigen::Matrix3d::Identity() - S;
  const Eigen::Vector3d moment = mass * com;
  return {J(0, 0), J(0, 1),   J(0, 2),   J(1, 1),   J(1, 2),
          J(2, 2), moment[0], moment[1], moment[2], mass};
}

std::vector<NamedRobot> random_chains() { return random_robots(16, false); }

std::vector<NamedRobot> random_trees() { return random_robots(10, true); }

std::vector<NamedRobot> robots_of_files() {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(std::string(DYNGEN_SOURCE_DIR "/robots"))) {
    if (entry.path().extension() == ".robot") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::vector<NamedRobot> robots;
  std::uint64_t seed = 1;
  for (const std::string& name : names) {
    const RobotModel model = read_model("robots/" + name);
    NumericRobot robot = numeric_robot(with_random_values(model, seed));
    for (std::size_t j = 0; j < robot.size(); ++j) {
      const auto& chi = model.joints[j].chi;
      const bool unknown = std::any_of(chi.begin(), chi.begin() + kInertialCount,
                                       [](const Quantity& quantity) { return quantity.unknown; });
      ++seed;
      if (unknown || !is_solid(robot.joints[j])) robot.joints[j].inertial = random_body(seed);
    }
    robots.push_back({name, std::move(robot)});
  }
  return robots;
}

}  // namespace dyngen::test

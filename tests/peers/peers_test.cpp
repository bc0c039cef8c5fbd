// SPDX-License-Identifier: MIT
// Generated functions against libraries that nobody here wrote: Orocos KDL, MuJoCo and DART.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>

#include "tests/peers/link_frames.h"
#include "tests/peers/peer.h"
#include "tests/support/body_robots.h"
#include "tests/support/model_bridge.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

// All sides work in double. Of the largest value of a function on a robot, errors of some 1e-15 per
// joint add up; forward dynamics multiplies them by the condition of the mass matrix.
constexpr double kTolerance = 1e-10;
constexpr int kSamples = 6;

/// What is compared on a robot, as far as the generator writes it: poses and Jacobians of the last
/// link and of one in the middle.
std::vector<std::string> function_names(const NumericRobot& robot) {
  const std::string middle = "_" + std::to_string((robot.size() + 1) / 2);
  std::vector<std::string> names = {"id",          "id_rigid",   "gravity",  "coriolis",
                                    "mass_matrix", "fd",         "jacobian", "jacobian" + middle,
                                    "fk",          "fk" + middle};
  std::erase_if(names, [](const std::string& name) { return find_function(name) == nullptr; });
  return names;
}

/// "fk" of "fk_3".
std::string kind_of(const std::string& function) {
  return std::string(parse_function_name(function).spec->name);
}

PeerInput input_of(const MotionSample& sample) {
  PeerInput input{sample.q, sample.dq, sample.ddq, {}, {}, 0};
  for (std::size_t k = 0; k < sample.wrench.size(); ++k) input.wrench[k] = sample.wrench[k];
  return input;
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The peer's answer with what it does not know of the joints: each of them adds to its own row.
/// None if it cannot answer.
std::optional<std::vector<double>> answer(const Peer& peer, const NumericRobot& robot,
                                          const std::string& function, PeerInput input) {
  const bool rigid = function == "id_rigid";
  const auto call = peer.calls.find(rigid ? "id" : kind_of(function));
  input.link = parse_function_name(function).link;
  if (call == peer.calls.end()) return std::nullopt;
  const std::vector<std::size_t> moving = moving_joints(robot);
  const auto friction = [&](std::size_t i) {
    const NumericJoint& joint = robot.joints[moving[i]];
    const double viscous = joint.Fv * input.dq[i], held = peer.holds_viscous ? viscous : 0;
    return (rigid ? 0 : joint.Fs * sign(input.dq[i]) + joint.off + viscous) - held;
  };
  const auto rotor = [&](std::size_t i) {
    return peer.holds_rotor ? 0 : robot.joints[moving[i]].IA;
  };
  if (function == "fd") {
    for (std::size_t i = 0; i < moving.size(); ++i) {
      if (rotor(i) != 0) return std::nullopt;
      input.tau[i] -= friction(i);
    }
  }
  std::vector<double> result = call->second(input);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (function == "id" || rigid) result[i] += friction(i) + rotor(i) * input.ddq[i];
    if (function == "mass_matrix") result[i * moving.size() + i] += rotor(i);
  }
  return result;
}

/// The largest errors by function, over robots.
class Errors {
 public:
  void add(const std::string& function, const RelativeError& error, const std::string& robot) {
    EXPECT_LT(error.value(), kTolerance) << function << " of " << robot;
    double& largest = largest_[kind_of(function)];
    largest = std::max(largest, error.value());
  }
  void print(const std::string& peer) const {
    std::cout << peer << ":";
    for (const auto& [function, error] : largest_) {
      std::cout << fmt::format(" {} {:.0e}", function, error);
    }
    std::cout << "\n";
  }

 private:
  std::map<std::string, double> largest_;
};

int coordinates(const NumericRobot& robot) { return static_cast<int>(moving_joints(robot).size()); }

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::fabs(value));
  return result;
}

/// Parts of the torque are judged against all of it: they may vanish on a robot.
bool is_torque(const std::string& function) {
  return function.starts_with("id") || function == "gravity" || function == "coriolis";
}

/// The generated function's error on a sample, judged by the peer. @return false if it cannot tell
bool add_error(RelativeError& error, const std::string& function, const EvaluatedModel& generated,
               const Peer& peer, const NumericRobot& robot, MotionSample sample) {
  PeerInput input = input_of(sample);
  sample.tau = input.tau = *answer(peer, robot, "id", input);
  const std::optional<std::vector<double>> expected = answer(peer, robot, function, input);
  if (!expected) return false;
  error.add(generated.call(function, sample), *expected);
  if (is_torque(function)) error.add(largest(input.tau), largest(input.tau));
  return true;
}

/// Over random samples.
std::optional<RelativeError> error_of(const std::string& function, const EvaluatedModel& generated,
                                      const Peer& peer, const NumericRobot& robot) {
  RelativeError error;
  for (MotionSample& sample : random_samples(coordinates(robot), kSamples, 3)) {
    sample.wrench.clear();  // not an argument here
    if (!add_error(error, function, generated, peer, robot, sample)) return std::nullopt;
  }
  return error;
}

GeneratorOptions options_of(const NumericRobot& robot, ParameterMode mode) {
  GeneratorOptions options;
  options.functions = function_names(robot);
  options.parameters = mode;
  return options;
}

/// Largest errors by peer.
using ErrorsByPeer = std::map<std::string, Errors>;

void print(const ErrorsByPeer& errors) {
  for (const auto& [peer, of_peer] : errors) of_peer.print(peer);
}

/// The peers that take the robot.
std::vector<PeerKind> peers_of(const NumericRobot& robot) {
  bool chain = true;
  for (std::size_t j = 0; j < robot.size(); ++j) {
    chain = chain && robot.joints[j].parent == static_cast<int>(j);
  }
  std::vector<PeerKind> kinds = peer_kinds();
  std::erase_if(kinds, [&](const PeerKind& kind) { return !chain && !kind.trees; });
  return kinds;
}

void compare(const std::vector<NamedRobot>& robots, ParameterMode mode) {
  ErrorsByPeer errors;
  for (const auto& [name, robot] : robots) {
    const EvaluatedModel generated(robot_model(robot), options_of(robot, mode));
    for (const PeerKind& kind : peers_of(robot)) {
      const Peer peer = kind.make(robot);
      for (const std::string& function : function_names(robot)) {
        const std::optional<RelativeError> error = error_of(function, generated, peer, robot);
        if (error) errors[kind.name].add(function, *error, name);
      }
    }
  }
  print(errors);
}

/// Gravity, a wrench on the last link and a payload are arguments of the generated functions; the
/// peer gets a robot with that gravity, whose last link holds the payload too.
void compare_arguments(const std::vector<NamedRobot>& robots) {
  ErrorsByPeer errors;
  for (std::size_t r = 0; r < robots.size(); r += 3) {
    const auto& [name, robot] = robots[r];
    GeneratorOptions options = options_of(robot, ParameterMode::kBaked);
    options.gravity = options.wrench = options.payload = true;
    const EvaluatedModel generated(robot_model(robot), options);
    for (const PeerKind& kind : peers_of(robot)) {
      std::map<std::string, RelativeError> of_robot;
      for (int k = 0; k < 3; ++k) {
        MotionSample sample = random_samples(coordinates(robot), 2, r).back();
        sample.gravity = {1.0 + k, 2.0 - k, -3.0 * k};
        sample.wrench = {10.0 * k, -20, 30, 5, -4.0 * k, 3};
        const std::array<double, 10> payload = random_body(r + static_cast<std::size_t>(k));
        sample.payload.assign(payload.begin(), payload.end());
        NumericRobot loaded = robot;
        std::copy_n(sample.gravity.begin(), 3, loaded.base_acceleration.begin());
        for (std::size_t i = 0; i < 10; ++i) loaded.joints.back().inertial[i] += payload[i];
        const Peer peer = kind.make(loaded);
        for (const std::string& function : function_names(robot)) {
          RelativeError error = of_robot[function];
          if (add_error(error, function, generated, peer, loaded, sample)) {
            of_robot[function] = error;
          }
        }
      }
      for (const auto& [function, error] : of_robot) {
        if (std::isfinite(error.value())) errors[kind.name].add(function, error, name);
      }
    }
  }
  print(errors);
}

TEST(Peers, AgreeOnRandomChains) { compare(random_chains(), ParameterMode::kBaked); }

TEST(Peers, AgreeOnRandomTrees) { compare(random_trees(), ParameterMode::kBaked); }

TEST(Peers, AgreeOnTheRobotFiles) { compare(robots_of_files(), ParameterMode::kRuntime); }

TEST(Peers, AgreeWithGravityWrenchAndPayloadAsArguments) {
  compare_arguments(random_chains());
  compare_arguments(random_trees());
}

/// A chain of revolute and prismatic joints in which every number matters to every function.
NumericRobot robot_to_spoil() {
  NumericRobot robot;
  for (int j = 0; j < 4; ++j) {
    NumericJoint joint;
    joint.sigma = j == 2 ? 1 : 0;
    joint.parent = j;
    joint.alpha = 0.3 + 0.2 * j;
    joint.d = 0.1 + 0.1 * j;
    joint.theta = 0.4;
    joint.r = 0.2;
    joint.inertial = random_body(static_cast<std::uint64_t>(100 + j));
    robot.joints.push_back(joint);
  }
  robot.base_acceleration = {1, 2, 9.81};
  return robot;
}

TEST(Peers, DisagreeOnAWrongModel) {
  const NumericRobot robot = robot_to_spoil();
  const EvaluatedModel generated(robot_model(robot), options_of(robot, ParameterMode::kBaked));
  std::vector<NumericRobot> wrong(4, robot);
  wrong[0].joints[1].d *= 1 + 1e-6;
  wrong[1].joints[1].alpha += 1e-6;
  wrong[2].joints[3].inertial[6] *= 1 + 1e-6;
  wrong[3].base_acceleration[2] *= 1 + 1e-6;
  for (const PeerKind& kind : peer_kinds()) {
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      const Peer peer = kind.make(wrong[i]);
      for (const std::string& function : function_names(robot)) {
        const bool of_bodies = kind_of(function) != "fk" && kind_of(function) != "jacobian";
        const bool of_gravity = function == "id" || function == "gravity" || function == "fd";
        if ((i == 2 && !of_bodies) || (i == 3 && !of_gravity)) continue;
        const std::optional<RelativeError> error = error_of(function, generated, peer, robot);
        if (!error) continue;
        EXPECT_GT(error->value(), 10 * kTolerance)
            << function << " of " << kind.name << ", wrong model " << i;
      }
    }
  }
}

/// Judges must agree before they judge: every function of every two libraries, with a wrench on
/// the last link.
TEST(Peers, AgreeAmongThemselves) {
  std::vector<NamedRobot> robots = random_chains();
  const std::vector<NamedRobot> trees = random_trees(), files = robots_of_files();
  robots.insert(robots.end(), files.begin(), files.end());
  robots.insert(robots.end(), trees.begin(), trees.end());
  ErrorsByPeer errors;
  for (const auto& [name, robot] : robots) {
    std::vector<Peer> peers;
    for (const PeerKind& kind : peers_of(robot)) peers.push_back(kind.make(robot));
    const Peer& reference = peers.front();
    for (const std::string& function : function_names(robot)) {
      for (const Peer& peer : peers) {
        RelativeError error;
        for (const MotionSample& sample : random_samples(coordinates(robot), kSamples, 3)) {
          PeerInput input = input_of(sample);
          const std::vector<double> torque = *answer(reference, robot, "id", input);
          input.tau = torque;
          const auto expected = answer(reference, robot, function, input);
          const auto actual = answer(peer, robot, function, input);
          if (!expected || !actual) break;
          error.add(*actual, *expected);
          const double scale = is_torque(function) ? largest(torque) : 1;
          error.add(scale, scale);
        }
        if (std::isfinite(error.value())) errors[peer.name].add(function, error, name);
      }
    }
  }
  print(errors);
}

}  // namespace
}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/bench/peers.h"
#include "tests/bench/speed_robots.h"

namespace dyngen::bench {

/// A robot with its states and the peers that are there.
struct Contest {
  explicit Contest(SpeedRobot contested);

  SpeedRobot robot;
  test::NumericRobot rigid;  ///< without rotor inertia, friction and offset: what the peers have
  States states;
  Rows<double> batch;
  Rows<float> batch_float;
  std::vector<std::pair<std::string, Peer>> peers;
};

/// `id` as a program, interpreted over all states at once; torques joint by joint.
class EvaluatedId {
 public:
  explicit EvaluatedId(const Contest& contest);
  const std::vector<double>& operator()();

 private:
  const Program& program_;
  const std::vector<double>& chi_;
  Rows<double> rows_;
  std::vector<double> tau_;
};

/// Prints how far all functions are from the judge, which is written apart from the generator.
/// @return false if one is too far
bool verify(const Contest& contest);

/// Registers all functions of all who have them. The contest must live as long as they run.
void add_benchmarks(const Contest& contest);

}  // namespace dyngen::bench

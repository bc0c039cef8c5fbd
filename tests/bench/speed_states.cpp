// SPDX-License-Identifier: MIT
#include "tests/bench/speed_states.h"

#include <numbers>
#include <random>

namespace dyngen::bench {

States random_states(std::size_t joints) {
  std::mt19937_64 random(20240607);
  const auto draw = [&](double limit) {
    std::uniform_real_distribution<double> uniform(-limit, limit);
    std::vector<double> values(kStates * joints);
    for (double& value : values) value = uniform(random);
    return values;
  };
  States states;
  states.joints = joints;
  states.q = draw(std::numbers::pi);
  states.dq = draw(3.0);
  states.ddq = draw(10.0);
  states.tau = draw(20.0);
  return states;
}

}  // namespace dyngen::bench

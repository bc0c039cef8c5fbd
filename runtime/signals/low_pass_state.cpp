// SPDX-License-Identifier: MIT
#include "runtime/signals/low_pass_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

void both_ways(const LowPass& filter, const EndTreatment& ends, Eigen::VectorXd& x) {
  PassState state = start_state(filter, x.data(), x.size(), ends.line_samples);
  pass_forward(filter, state, x.data(), x.size());
  pass_backward(filter, x.data(), x.size(), ends.line_samples);
}

}  // namespace

LowPassStates low_pass_states(const LowPass& filter, const Eigen::MatrixXd& q) {
  const Eigen::Index N = q.rows();
  if (N < 3) {
    throw std::invalid_argument(
        fmt::format("low_pass_states(): {} samples, at least 3 are needed", N));
  }
  const EndTreatment ends = end_treatment(filter);
  const Eigen::Index padding = std::min(ends.padding, N - 1);
  const double T = filter.sample_time;
  LowPassStates states{q, q, q};
  for (Eigen::Index j = 0; j < q.cols(); ++j) {
    const Eigen::VectorXd extended = extend_odd(q.col(j), padding);
    // The outermost samples have one neighbour: they are left out.
    const Eigen::Index inner = extended.size() - 2;
    Eigen::VectorXd position = extended.segment(1, inner), velocity(inner), acceleration(inner);
    for (Eigen::Index k = 0; k < inner; ++k) {
      velocity[k] = central_first(extended[k], extended[k + 2], T);
      acceleration[k] = central_second(extended[k], extended[k + 1], extended[k + 2], T);
    }
    both_ways(filter, ends, position);
    both_ways(filter, ends, velocity);
    both_ways(filter, ends, acceleration);
    states.q.col(j) = position.segment(padding - 1, N);
    states.dq.col(j) = velocity.segment(padding - 1, N);
    states.ddq.col(j) = acceleration.segment(padding - 1, N);
  }
  return states;
}

}  // namespace dyngen::runtime

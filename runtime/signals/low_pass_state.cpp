// SPDX-License-Identifier: MIT
#include "runtime/signals/low_pass_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

constexpr std::array<double, kDifferenceReach> kFirst = {5.0 / 6, -5.0 / 21, 5.0 / 84, -5.0 / 504,
                                                         1.0 / 1260};
constexpr std::array<double, kDifferenceReach> kSecond = {5.0 / 3, -5.0 / 21, 5.0 / 126,
                                                          -5.0 / 1008, 1.0 / 3150};

void both_ways(const LowPass& filter, const EndTreatment& ends, Eigen::VectorXd& x) {
  PassState state = start_state(filter, x.data(), x.size(), ends.line_samples);
  pass_forward(filter, state, x.data(), x.size());
  pass_backward(filter, x.data(), x.size(), ends.line_samples);
}

}  // namespace

double wide_first_difference(const double* middle, double sample_time) {
  double sum = 0;
  for (Eigen::Index i = kDifferenceReach; i >= 1; --i) {
    sum += kFirst[static_cast<std::size_t>(i - 1)] * (middle[i] - middle[-i]);
  }
  return sum / sample_time;
}

double wide_second_difference(const double* middle, double sample_time) {
  double sum = 0;
  for (Eigen::Index i = kDifferenceReach; i >= 1; --i) {
    const double bend = (middle[i] - *middle) - (*middle - middle[-i]);
    sum += kSecond[static_cast<std::size_t>(i - 1)] * bend;
  }
  return sum / (sample_time * sample_time);
}

LowPassStates low_pass_states(const LowPass& filter, const Eigen::MatrixXd& q) {
  const Eigen::Index N = q.rows();
  if (N < 3) {
    throw std::invalid_argument(
        fmt::format("low_pass_states(): {} samples, at least 3 are needed", N));
  }
  const EndTreatment ends = end_treatment(filter);
  const Eigen::Index padding = std::min(ends.padding, N - 1);
  const Eigen::Index reach = padding >= kDifferenceReach ? kDifferenceReach : 1;
  const double T = filter.sample_time;
  LowPassStates states{q, q, q};
  for (Eigen::Index j = 0; j < q.cols(); ++j) {
    const Eigen::VectorXd extended = extend_odd(q.col(j), padding);
    // The outermost samples have no neighbours: they are left out.
    const Eigen::Index inner = extended.size() - 2 * reach;
    Eigen::VectorXd position = extended.segment(reach, inner), velocity(inner), acceleration(inner);
    for (Eigen::Index k = 0; k < inner; ++k) {
      const double* const here = extended.data() + k + reach;
      if (reach == kDifferenceReach) {
        velocity[k] = wide_first_difference(here, T);
        acceleration[k] = wide_second_difference(here, T);
      } else {
        velocity[k] = (here[1] - here[-1]) / (2 * T);
        acceleration[k] = ((here[1] - *here) - (*here - here[-1])) / (T * T);
      }
    }
    both_ways(filter, ends, position);
    both_ways(filter, ends, velocity);
    both_ways(filter, ends, acceleration);
    states.q.col(j) = position.segment(padding - reach, N);
    states.dq.col(j) = velocity.segment(padding - reach, N);
    states.ddq.col(j) = acceleration.segment(padding - reach, N);
  }
  return states;
}

}  // namespace dyngen::runtime

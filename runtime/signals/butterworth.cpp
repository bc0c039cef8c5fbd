// SPDX-License-Identifier: MIT
#include "runtime/signals/butterworth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

// Of the peak of the impulse response: what a pass has forgotten is below rounding.
constexpr double kPaddingForgotten = 1e-15;

/// Decay of the impulse response of a section, a sample.
double pole_radius(const LowPass::Section& section) {
  const double g = section.g;
  if (section.order == 1) return std::abs((1 - g) / (1 + g));
  const double gk = g * section.damping;
  return std::sqrt((1 - gk + g * g) / (1 + gk + g * g));
}

/// The coefficients of a section, one division earlier than the loop.
struct Loop {
  double a1, a2, a3;
  int order;
};

struct Loops {
  std::array<Loop, 4> loops;
  std::size_t count;
};

Loops loops_of(const LowPass& filter) {
  Loops result{};
  result.count = filter.sections.size();
  for (std::size_t s = 0; s < result.count; ++s) {
    const auto& [g, damping, order] = filter.sections[s];
    Loop& loop = result.loops[s];
    loop.order = order;
    loop.a1 = order == 1 ? 0.0 : 1 / (1 + g * (g + damping));
    loop.a2 = order == 1 ? g / (1 + g) : g * loop.a1;
    loop.a3 = g * loop.a2;
  }
  return result;
}

double step(const Loops& filter, PassState& state, double value) {
  for (std::size_t s = 0; s < filter.count; ++s) {
    const Loop& loop = filter.loops[s];
    double& first = state[2 * s];
    double& second = state[2 * s + 1];
    if (loop.order == 1) {
      const double rise = loop.a2 * (value - first);
      value = first + rise;
      first = value + rise;
      continue;
    }
    const double difference = value - second;
    const double rise = loop.a1 * first + loop.a2 * difference;
    value = second + loop.a2 * first + loop.a3 * difference;
    first = 2 * rise - first;
    second = 2 * value - second;
  }
  return value;
}

struct FittedLine {
  double value, slope;
};

/// The line through x[0], x[stride], ... by least squares: its value at x[0], its rise a sample.
FittedLine fit_line(const double* x, Eigen::Index count, Eigen::Index stride) {
  if (count < 2) return {count == 0 ? 0 : x[0], 0};
  const double centre = static_cast<double>(count - 1) / 2;
  double mean = 0, moment = 0, inertia = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double away = static_cast<double>(i) - centre;
    const double rise = x[i * stride] - x[0];
    mean += rise;
    moment += away * rise;
    inertia += away * away;
  }
  const double slope = moment / inertia;
  return {x[0] + mean / static_cast<double>(count) - slope * centre, slope};
}

}  // namespace

LowPass design_butterworth(int order, double cutoff_hz, double sample_time) {
  if (order < 1 || order > 8) {
    throw std::invalid_argument(fmt::format("design_butterworth(): order {} is not 1..8", order));
  }
  if (!(sample_time > 0) || !std::isfinite(sample_time)) {
    throw std::invalid_argument(
        fmt::format("design_butterworth(): sample_time {} s is not positive", sample_time));
  }
  if (!(cutoff_hz > 0) || !(cutoff_hz < 0.5 / sample_time)) {
    throw std::invalid_argument(
        fmt::format("design_butterworth(): cutoff_hz {} is not between 0 and {} Hz, half the "
                    "sampling frequency",
                    cutoff_hz, 0.5 / sample_time));
  }
  LowPass filter{order, cutoff_hz, sample_time, {}};
  const double g = std::tan(std::numbers::pi * cutoff_hz * sample_time);
  for (int i = 0; i < order / 2; ++i) {
    filter.sections.push_back({g, 2 * std::sin((2 * i + 1) * std::numbers::pi / (2 * order)), 2});
  }
  if (order % 2 == 1) filter.sections.push_back({g, 0, 1});
  return filter;
}

PassState line_state(const LowPass& filter, double value, double slope) {
  PassState state{};
  for (std::size_t s = 0; s < filter.sections.size(); ++s) {
    const auto& [g, damping, order] = filter.sections[s];
    // A section delays a line by (damping or 1)/(2 g) samples; an integrator holds half a step
    // less.
    value -= slope * (order == 1 ? 1 : damping) / (2 * g);
    state[2 * s] = order == 1 ? value - slope / 2 : slope / (2 * g);
    state[2 * s + 1] = order == 1 ? 0 : value - slope / 2;
  }
  return state;
}

PassState start_state(const LowPass& filter, const double* samples, Eigen::Index count,
                      Eigen::Index line_samples) {
  const FittedLine line = fit_line(samples, std::min(count, line_samples), 1);
  return line_state(filter, line.value, line.slope);
}

void pass_forward(const LowPass& filter, PassState& state, double* samples, Eigen::Index count) {
  const Loops loops = loops_of(filter);
  PassState local = state;
  for (Eigen::Index i = 0; i < count; ++i) samples[i] = step(loops, local, samples[i]);
  state = local;
}

void pass_backward(const LowPass& filter, double* samples, Eigen::Index count,
                   Eigen::Index line_samples) {
  if (count == 0) return;
  const Loops loops = loops_of(filter);
  const FittedLine line = fit_line(samples + count - 1, std::min(count, line_samples), -1);
  PassState state = line_state(filter, line.value, line.slope);
  for (Eigen::Index i = count - 1; i >= 0; --i) samples[i] = step(loops, state, samples[i]);
}

EndTreatment end_treatment(const LowPass& filter) {
  const Eigen::Index padding =
      std::max<Eigen::Index>(8, settling_samples(filter, kPaddingForgotten));
  return {padding, std::max<Eigen::Index>(2, padding / 16)};
}

Eigen::VectorXd extend_odd(const Eigen::Ref<const Eigen::VectorXd>& column, Eigen::Index padding) {
  const Eigen::Index N = column.size();
  Eigen::VectorXd extended(N + 2 * padding);
  extended.segment(padding, N) = column;
  for (Eigen::Index i = 1; i <= padding; ++i) {
    extended[padding - i] = 2 * column[0] - column[i];
    extended[padding + N - 1 + i] = 2 * column[N - 1] - column[N - 1 - i];
  }
  return extended;
}

Eigen::MatrixXd zero_phase(const LowPass& filter, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  if (columns.rows() == 0) return result;
  const EndTreatment ends = end_treatment(filter);
  const Eigen::Index padding = std::min(ends.padding, columns.rows() - 1);
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    Eigen::VectorXd x = extend_odd(columns.col(j), padding);
    PassState state = start_state(filter, x.data(), x.size(), ends.line_samples);
    pass_forward(filter, state, x.data(), x.size());
    pass_backward(filter, x.data(), x.size(), ends.line_samples);
    result.col(j) = x.segment(padding, columns.rows());
  }
  return result;
}

Eigen::Index settling_samples(const LowPass& filter, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1)) {
    throw std::invalid_argument(
        fmt::format("settling_samples(): tolerance {} is not between 0 and 1", tolerance));
  }
  double radius = 1e-3;
  for (const auto& section : filter.sections) radius = std::max(radius, pole_radius(section));
  // Pairs of poles that beat against each other hold on a little longer than the slowest alone.
  const auto horizon = static_cast<Eigen::Index>(1.5 * std::log(tolerance) / std::log(radius)) + 50;
  const Loops loops = loops_of(filter);
  PassState state{};
  std::vector<double> response(static_cast<std::size_t>(horizon));
  double peak = 0;
  for (std::size_t i = 0; i < response.size(); ++i) {
    response[i] = std::abs(step(loops, state, i == 0 ? 1.0 : 0.0));
    peak = std::max(peak, response[i]);
  }
  Eigen::Index settled = horizon;
  while (settled > 0 && response[static_cast<std::size_t>(settled - 1)] <= tolerance * peak) {
    --settled;
  }
  return settled;
}

}  // namespace dyngen::runtime

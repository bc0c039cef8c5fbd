// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace dyngen::runtime {

/// A digital Butterworth low-pass: the analogue one, bilinear with its cut-off prewarped, as a
/// chain of sections of order two and, if the order is odd, one of order one.
///
/// The sections are integrator loops (trapezoidal), not polynomials in z: their gain at rest is one
/// by construction, whatever the rounding, and a cut-off at 1e-4 of the sampling frequency costs no
/// digits.
struct LowPass {
  struct Section {
    double g = 0;        ///< tan(pi cutoff sample_time): gain of an integrator
    double damping = 0;  ///< 1/Q of a section of order two
    int order = 2;       ///< 1 or 2
  };
  int order = 0;
  double cutoff_hz = 0;    ///< -3 dB of one pass; -6 dB of zero_phase
  double sample_time = 0;  ///< s
  std::vector<Section> sections;
};

/// @param order        1..8
/// @param cutoff_hz    Hz, where one pass has the gain sqrt(1/2); in (0, 1/(2 sample_time))
/// @param sample_time  s, > 0
/// @throws std::invalid_argument  if one of them is out of its range
LowPass design_butterworth(int order, double cutoff_hz, double sample_time);

/// Forward and backward: no phase, gain |H|^2. Each column is one signal; each end is continued by
/// its odd reflection for as long as the filter remembers (at most N-1 samples), and both passes
/// start in the steady state of a line fitted there. So a straight line passes exactly.
///
/// @param columns  (N x n) finite, any N      @return (N x n)
Eigen::MatrixXd zero_phase(const LowPass& filter, const Eigen::MatrixXd& columns);

/// Samples until the impulse response of one pass stays below `tolerance` times its peak.
///
/// @param tolerance  in (0, 1)
/// @throws std::invalid_argument  if it is not
Eigen::Index settling_samples(const LowPass& filter, double tolerance);

/// What the passes below remember of one column: two numbers a section.
using PassState = std::array<double, 8>;

/// The state just before a sample `value` of a line that rises by `slope` a sample and has been
/// passing forever.
PassState line_state(const LowPass& filter, double value, double slope);

/// One causal pass, in place, over samples[0], samples[1], ...; continues from `state`.
void pass_forward(const LowPass& filter, PassState& state, double* samples, Eigen::Index count);

/// The anticausal pass, in place, over samples[count-1] down to samples[0]; begins in the steady
/// state of the line fitted to the last `line_samples` of them.
void pass_backward(const LowPass& filter, double* samples, Eigen::Index count,
                   Eigen::Index line_samples);

/// The state of a forward pass that begins with the line fitted to the first `line_samples`.
PassState start_state(const LowPass& filter, const double* samples, Eigen::Index count,
                      Eigen::Index line_samples);

/// How the ends of a run are treated: both numbers depend on the filter alone.
struct EndTreatment {
  Eigen::Index padding = 0;       ///< samples of odd reflection, if the run is longer than that
  Eigen::Index line_samples = 0;  ///< samples of the line that a pass begins with
};
EndTreatment end_treatment(const LowPass& filter);

/// A column with `padding` samples of odd reflection at each end: 2 x[0] - x[i], 2 x[N-1] -
/// x[N-1-i].
///
/// @param padding  0..N-1      @return (N + 2 padding)
Eigen::VectorXd extend_odd(const Eigen::Ref<const Eigen::VectorXd>& column, Eigen::Index padding);

}  // namespace dyngen::runtime

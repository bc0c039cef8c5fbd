// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/joint_noise.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// A line of the spectrum of (e_t - e_(t - P)) / sqrt(2) of one run, P its period; or of the
/// difference of two recordings.
struct DifferenceLine {
  double frequency = 0;  ///< cycles for a sample
  double passed = 0;     ///< 1 - cos 2 pi f P: what the difference has of the density of e
  double power = 0;      ///< periodogram: its expectation is passed * density
};

/// Low lines, beside the harmonics of the period, where the difference has half of the density or
/// more: of what a process leaves of the difference, times the process's density. About equations
/// that do not count, noise of high lines would be in low ones; white noise there is as much at
/// all.
/// @param difference  0 where it does not count   @param counted  1 or 0
/// @param period      samples; infinite: of two recordings, each with noise of its own
/// @param process     about that of the difference, with an innovation
std::vector<DifferenceLine> difference_lines(const Eigen::VectorXd& difference,
                                             const Eigen::VectorXd& counted, double period,
                                             const AutoregressiveNoise& process,
                                             const NoiseRules& rules = {});

/// What the differences of one joint over neighbouring periods are, of all runs.
struct JointDifferences {
  std::vector<DifferenceLine> lines;
  Eigen::VectorXd covariance;   ///< (lags), from lag 0
  AutoregressiveNoise process;  ///< of that covariance
  double samples = 1;           ///< that they come from
};

/// Lengths in samples.
struct DifferenceLengths {
  double period = 0;   ///< a mean over runs, where their periods are not one
  double longest = 0;  ///< of the runs
};

/// Noise of each joint: an autoregressive process, and parts of first order beside it where noise
/// is slower than a process of 40 lags tells, as 1/f noise is, or thousands of times smaller at low
/// frequencies than noise of accelerations is at high ones: white, of 2 samples' memory, and from 8
/// on a factor of 4 apart. Their variances are those of the greatest likelihood of the lines
/// (Whittle 1953).
/// @return processes alone unless the likelihood of all joints pays for such parts
std::vector<JointNoise> noise_of_differences(const std::vector<JointDifferences>& joints,
                                             const DifferenceLengths& lengths,
                                             const NoiseRules& rules = {});

}  // namespace dyngen::runtime

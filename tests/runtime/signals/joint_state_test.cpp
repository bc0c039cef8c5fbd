// SPDX-License-Identifier: MIT
#include "runtime/signals/joint_state.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

#include "tests/runtime/signals/test_motion.h"

namespace dyngen::runtime {
namespace {

constexpr double kSampleTime = 2e-4;
constexpr double kStep = 9.5e-5 / 45;  // of the third axis of a Staeubli TX40

/// rms of the difference, where the run still has samples.
double error(const Motion& got, const Eigen::MatrixXd& value, const Eigen::MatrixXd& truth) {
  const auto first = static_cast<Eigen::Index>(std::llround(got.time[0] / got.sample_time));
  return std::sqrt((value - truth.middleRows(first, value.rows())).squaredNorm() /
                   static_cast<double>(value.size()));
}

TEST(JointState, EveryMethodFindsVelocityAndAccelerationOfAMultisine) {
  const TestMotion motion = test_motion(50'000, kSampleTime, 2);
  Recording recording = test_recording(motion, kStep);
  const double dq = std::sqrt(motion.dq.squaredNorm() / static_cast<double>(motion.dq.size()));
  const double ddq = std::sqrt(motion.ddq.squaredNorm() / static_cast<double>(motion.ddq.size()));
  std::cout << fmt::format("{:<32}{:>12}{:>12}   of rms {:.3g} rad/s, {:.3g} rad/s^2\n", "method",
                           "dq", "ddq", dq, ddq);
  struct Row {
    const char* name;
    JointStateOptions options;
    double largest;  // error of the acceleration, of its rms
  };
  JointStateOptions low_pass, low_pass_40, filter, smoother, smoother_step, spectral, spectral_5;
  low_pass_40.cutoff_hz = 40;
  filter.method = StateMethod::kKalmanFilter;
  smoother.method = smoother_step.method = StateMethod::kKalmanSmoother;
  smoother_step.encoder_step = kStep;
  spectral.method = spectral_5.method = StateMethod::kSpectral;
  spectral_5.cutoff_hz = 5;
  for (const auto& [name, options, largest] :
       {Row{"low-pass, chosen cut-off", low_pass, 0.01}, Row{"low-pass, 40 Hz", low_pass_40, 0.01},
        Row{"Kalman filter, all chosen", filter, 0.1},
        Row{"Kalman smoother, all chosen", smoother, 0.02},
        Row{"Kalman smoother, step given", smoother_step, 0.02},
        Row{"spectral, chosen cut-off", spectral, 0.01},
        Row{"spectral, 5 Hz", spectral_5, 0.001}}) {
    const JointStates states = joint_states(recording, options);
    ASSERT_EQ(states.runs.size(), 1U);
    const Motion& run = states.runs[0];
    const double velocity = error(run, run.dq, motion.dq);
    const double acceleration = error(run, run.ddq, motion.ddq);
    std::cout << fmt::format("{:<32}{:>12.3g}{:>12.3g}   {} s cut\n", name, velocity, acceleration,
                             run.time[0]);
    for (const auto& message : states.messages) std::cout << "    " << message << "\n";
    EXPECT_LT(velocity, 0.1 * largest * dq + 1e-3 * dq) << name;
    EXPECT_LT(acceleration, largest * ddq) << name;
    EXPECT_LT(error(run, run.q, motion.q), 1e-3) << name;
  }
}

TEST(JointState, TorqueIsAsMeasuredAndStaysBesideItsSample) {
  const TestMotion motion = test_motion(4000, 1e-3, 2);
  JointStateOptions options;
  options.cutoff_hz = 30;
  options.trim = 0.1;
  const JointStates states = joint_states(test_recording(motion, 1e-5), options);
  ASSERT_EQ(states.runs.size(), 1U);
  const Motion& run = states.runs[0];
  ASSERT_EQ(run.samples(), 3800);
  EXPECT_EQ(run.tau(0, 0), 100);
  EXPECT_EQ(run.tau(3799, 1), 3899);
  EXPECT_EQ(run.time[0], motion.time[100]);
  EXPECT_NEAR(run.sample_time, 1e-3, 1e-15);
  EXPECT_EQ(states.cutoff.hz, 30);
}

TEST(JointState, NoFilterCrossesFromRunToRun) {
  const TestMotion motion = test_motion(4000, 1e-3, 1);
  Recording recording = test_recording(motion, 1e-5);
  recording.run_starts = {0, 1500, 1505};
  recording.q.middleRows(1500, 2500).array() += 5;
  recording.time.tail(2500).array() += 10;
  for (const auto method : {StateMethod::kLowPass, StateMethod::kKalmanSmoother}) {
    JointStateOptions options;
    options.method = method;
    options.cutoff_hz = 30;
    const JointStates states = joint_states(recording, options);
    ASSERT_EQ(states.runs.size(), 2U);
    EXPECT_TRUE(std::find(states.messages.begin(), states.messages.end(),
                          "run 2 is left out: 5 samples") != states.messages.end());
    EXPECT_LT(states.runs[0].dq.cwiseAbs().maxCoeff(), 3);
    Recording alone = rows_of(recording, 1505, 2495);
    const JointStates same = joint_states(alone, options);
    EXPECT_EQ(states.runs[1].ddq, same.runs.at(0).ddq);
  }
}

TEST(JointState, RecordedStatesAreTakenAsTheyAre) {
  const TestMotion motion = test_motion(4000, 1e-3, 2);
  Recording recording = test_recording(motion, 1e-5);
  JointStateOptions options;
  options.method = StateMethod::kRecorded;
  EXPECT_THROW(joint_states(recording, options), std::invalid_argument);
  recording.dq = motion.dq;
  const JointStates differentiated = joint_states(recording, options);
  ASSERT_EQ(differentiated.runs.size(), 1U);
  EXPECT_LT(error(differentiated.runs[0], differentiated.runs[0].dq, motion.dq), 1e-15);
  EXPECT_LT(error(differentiated.runs[0], differentiated.runs[0].ddq, motion.ddq), 0.2);
  recording.ddq = motion.ddq;
  const JointStates states = joint_states(recording, options);
  EXPECT_EQ(states.runs.at(0).q, recording.q);
  EXPECT_EQ(states.runs.at(0).ddq, motion.ddq);
}

TEST(JointState, SpectralSaysWhenTheRunIsNotPeriodic) {
  const TestMotion motion = test_motion(3700, 1e-3, 1);
  JointStateOptions options;
  options.method = StateMethod::kSpectral;
  options.cutoff_hz = 20;
  EXPECT_NE(joint_states(test_recording(motion, 0), options).messages.back().find("whole periods"),
            std::string::npos);
}

TEST(JointState, AJointAtRestHasNoVelocityWithAnyMethod) {
  TestMotion motion = test_motion(4000, 1e-3, 2);
  motion.q.col(1).setConstant(0.7);
  for (const auto method : {StateMethod::kLowPass, StateMethod::kKalmanFilter,
                            StateMethod::kKalmanSmoother, StateMethod::kSpectral}) {
    JointStateOptions options;
    options.method = method;
    const JointStates states = joint_states(test_recording(motion, 0.0), options);
    ASSERT_EQ(states.runs.size(), 1U);
    EXPECT_LT(states.runs[0].dq.col(1).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((states.runs[0].q.col(1).array() - 0.7).abs().maxCoeff(), 1e-12);
  }
}

TEST(JointState, WhatIsNotUniformOrDoesNotFitIsRefused) {
  const TestMotion motion = test_motion(200, 1e-3, 2);
  const Recording good = test_recording(motion, 1e-5);
  Recording jittered = good;
  jittered.time[50] += 1e-4;
  EXPECT_THROW(joint_states(jittered), std::invalid_argument);
  Recording short_tau = good;
  short_tau.tau = good.tau.topRows(199);
  EXPECT_THROW(joint_states(short_tau), std::invalid_argument);
  JointStateOptions options;
  options.order = 9;
  EXPECT_THROW(options.validate(), std::invalid_argument);
  options.order = 4;
  options.cutoff_hz = -1;
  EXPECT_THROW(joint_states(good, options), std::invalid_argument);
  options.cutoff_hz = 600;  // above half of the sampling frequency
  EXPECT_THROW(joint_states(good, options), std::invalid_argument);
}

TEST(JointState, RunsTooShortAreLeftOutWithAMessage) {
  const Recording recording = test_recording(test_motion(200, 1e-3, 1), 1e-5);
  JointStateOptions options;
  options.cutoff_hz = 30;
  options.trim = 0.1;
  const JointStates states = joint_states(recording, options);
  EXPECT_TRUE(states.runs.empty());
  EXPECT_NE(states.messages.back().find("left out"), std::string::npos);
  EXPECT_TRUE(joint_states(Recording{}, options).runs.empty());
}

}  // namespace
}  // namespace dyngen::runtime

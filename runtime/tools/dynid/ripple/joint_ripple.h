// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "gen/tool/progress_line.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/report/document.h"
#include "runtime/ripple/ripple.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// A run at full rate with the torque that the slow model leaves.
struct RippleRun {
  double sample_time = 0;      ///< s
  Eigen::MatrixXd q, dq, ddq;  ///< (N x n)
  Eigen::MatrixXd residual;    ///< (N x n); NaN of a joint without torque
  bool cut_off = false;        ///< what was recorded after it is left out
};

/// Samples that are looked at: two minutes at 1 kHz take some seconds for six joints.
inline constexpr Eigen::Index kMostRippleSamples = 120000;

/// Runs of recordings in memory, up to kMostRippleSamples.
/// @param beta  of the rigid robot
std::vector<RippleRun> ripple_runs(const LinearModel& model, const Eigen::VectorXd& beta,
                                   const std::vector<MotionSource>& sources);

/// The same with effects, of which those that are ripples stay in the residual.
std::vector<RippleRun> ripple_runs(const EffectRecordings& data, const EffectPoint& point);

/// A ripple that an effect has: of the robot file or of a finding.
struct EffectRipple {
  int joint = 0;  ///< from 0
  std::string name;
  double order = 0;
  double amplitude = 0, phase = 0;  ///< NaN: it is no torque of its own
};
std::vector<EffectRipple> ripples_in(const std::vector<EffectInstance>& effects);

/// Ripple of one joint and what effects say of it.
struct JointRipple {
  RippleResult result;
  std::vector<std::string> found_as;  ///< of each line: the effect that has the order; empty: none
  std::vector<std::string> remarks;
};

/// Ripple of all joints.
struct JointRipples {
  std::vector<JointRipple> joints;   ///< empty: nothing was looked at
  std::vector<std::string> remarks;  ///< of the recordings

  [[nodiscard]] bool any() const { return !joints.empty(); }
};

/// @param gears  turns of the motor for one of each joint; may be empty
JointRipples ripples_of(const LinearModel& model, const std::vector<RippleRun>& runs,
                        const std::vector<double>& gears, const std::vector<EffectRipple>& effects,
                        const RippleRules& rules, ProgressLine& progress);

/// Whether a line is a row `cogging` of the robot file: a torque of the position that both
/// directions share, and that no effect has yet.
bool makes_row(const JointRipple& ripple, std::size_t line);

/// The effects of these rows.
std::vector<EffectInstance> ripple_effects(const JointRipples& ripples, const RobotModel& model,
                                           const EffectCatalogue& catalogue);

/// What is said of them in the robot file, lines of a comment; empty: there are none.
std::vector<std::string> ripple_comment(const JointRipples& ripples);

/// One line of the answer.
struct RippleTextLine {
  int joint = 0;  ///< from 0
  std::string quantity, value, interval, note;
};
std::vector<RippleTextLine> ripple_lines(const JointRipples& ripples);

/// The table for a terminal; empty: nothing was looked at.
std::string ripple_text(const JointRipples& ripples);

/// The section of a page: the table, the order spectrum of each joint, sentences.
ReportSection ripple_section(const JointRipples& ripples);

}  // namespace dyngen::runtime

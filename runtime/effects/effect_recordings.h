// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/effects/work_count.h"
#include "runtime/estimation/rows.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/model/linear_model.h"
#include "runtime/signals/decimation.h"

namespace dyngen::runtime {

/// The name of a variable (d_*, payload_*, contact_*, wrench_*), and the link of the robot file,
/// from 1, that the effect is on; 0 of scope robot.
using TangentKey = std::pair<std::string, int>;
using TangentColumns = std::map<TangentKey, Eigen::MatrixXd>;

/// A derivative of every joint's torque, (N x n), at a motion and given parameters, and all others
/// that come out with it. wrench_*: column j is of joint j's own wrench.
/// @param further  rad or m: the joint's position, or the constant of the table, that is wanted by
///                 is further than the motion or the robot says; other derivatives know no such
///                 place
using TangentFunction =
    std::function<TangentColumns(const TangentKey& wanted, const JointMotion& motion,
                                 const Eigen::VectorXd& beta, double further)>;

/// What effects ask of a robot besides its linear model.
struct EffectRobot {
  TangentFunction tangents;  ///< may be empty: then effects that read them are refused
  /// (n) kg m^2 or kg: rotor inertias that the model has joined with the links', so that they are
  /// taken off the load. May be empty: none are known.
  Eigen::VectorXd joined_rotors{};
};

/// Samples [from, to) of a run.
struct SampleRange {
  Eigen::Index from = 0, to = 0;
};

/// An earlier run with the same motion.
struct EarlierRun {
  std::size_t run = 0;  ///< its place
  double lag = 0;       ///< s: time t of the later motion is t + lag of the earlier one
};

/// A run of a recording as effects see it: all samples, and the equations of the model alone.
struct EffectRun {
  int recording = 0;  ///< its place, from 0; negative: of none that events were found in
  Motion motion;
  Eigen::VectorXd time;           ///< (N) s from the recording's first sample
  Eigen::VectorXd position_step;  ///< (n) rad or m of the encoder; 0: not known
  Decimator decimator;            ///< the parallel filter
  RowBlock rows;                  ///< behind it; tau is 0 where none was recorded
  /// (n) stiction intervals of each joint, ascending: its friction may be any torque there. Its
  /// equations count; the evidence projects out what any torque there would change. Empty: none.
  std::vector<std::vector<SampleRange>> unknown{};
  /// Of a run whose motion does not repeat in itself.
  std::optional<EarlierRun> earlier{};
};

/// Recordings of one robot, with all that effects and their estimation read.
struct EffectRecordings {
  LinearModel model;
  EffectRobot robot;
  std::vector<EffectRun> runs;  ///< those that give at least one equation
  double row_time = 0;          ///< s between equations; the mean where recordings differ
  /// (n) joints whose equations are all left out: nothing is said of them. Empty: none.
  std::vector<bool> masked{};
  /// What is computed of them is added here; nothing: it is not counted.
  std::shared_ptr<WorkCount> work{};

  [[nodiscard]] int joints() const { return model.joints(); }
  [[nodiscard]] bool acts_in(const EffectInstance& effect, std::size_t run) const {
    return effect.recording < 0 || effect.recording == runs[run].recording;
  }
  [[nodiscard]] bool is_masked(int joint) const {
    return !masked.empty() && masked[static_cast<std::size_t>(joint)];
  }
  /// Adds to the work, if it is counted; as WorkCount::add().
  void count_work(Eigen::Index rows, Eigen::Index columns, Eigen::Index each) const {
    if (work) work->add(rows, columns, each);
  }
  /// Equations of each joint, over all runs.
  [[nodiscard]] Eigen::Index equations() const;
};

/// The equations of recordings, filtered and decimated as rows_of() does it.
///
/// A joint at zero velocity has no equations, as in rows_of(): stiction can take any value up to
/// its breakaway level. Where effects have states, those samples are kept.
/// @param remembering  (n) joints that keep all equations unless options.still_speed says at which
///                     speed they are left out (>= 0); empty: all of them
/// @throws std::invalid_argument  if a recording has another number of joints
/// @throws TooLittleDataError          if no run is longer than the parallel filter
EffectRecordings effect_recordings(LinearModel model, EffectRobot robot,
                                   const std::vector<MotionSource>& sources,
                                   const RowOptions& options,
                                   const std::vector<bool>& remembering = {});

/// Place among the parameters of a joint's kViscous, kCoulomb, kRotorInertia; -1: the model has
/// none.
int parameter_of(const LinearModel& model, int joint, ParameterKind kind);

/// A joint's kViscous, kCoulomb, kRotorInertia: in beta, or held; 0: the model has none.
double parameter_value(const LinearModel& model, const Eigen::VectorXd& beta, int joint,
                       ParameterKind kind);

/// Sizes of a joint in the recordings. @param joint  -1: the largest of all joints
/// Fc, Fv and Ia are not less than 0.
EffectScales scales_of(const EffectRecordings& data, const Eigen::VectorXd& beta, int joint);

}  // namespace dyngen::runtime

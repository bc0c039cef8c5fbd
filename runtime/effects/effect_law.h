// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen::runtime {

/// How the value of a parameter of an effect is found.
enum class EffectRole {
  kLinear,   ///< torque is linear in it
  kShape,    ///< anything else: found from its start value
  kScanned,  ///< a shape with many local minima: held where a number is given, else scanned
  kGiven     ///< a property of the machine: never estimated
};

enum class EffectKind { kAlgebraic, kStateful, kTangent, kAlignment };
enum class EffectScope { kJoint, kPair, kRobot };
enum class AlignmentOperator { kNone, kDelay, kLag };

struct EffectParameter {
  std::string name;
  std::string unit;  ///< SI, for a revolute joint: "N m"
  std::string meaning;
  EffectRole role = EffectRole::kLinear;
  bool logarithmic = false;
  int grid = 0;  ///< of kScanned: how many values are tried
};

/// Sizes of a joint and a recording, by which bounds, starts and typical values are given.
struct EffectScales {
  double Fc = 0, Fv = 0, Ia = 0;  ///< of the joint: N m, N m s/rad, kg m^2
  double v_max = 0, v90 = 0;      ///< largest speed; the speed that 90 % of the samples are below
  double q_range = 0;             ///< rad or m between the extreme positions
  double tau_max = 0;             ///< largest torque
  double duration = 0;            ///< s
  double position_step = 0;       ///< rad or m; of the encoder
  double temp_range = 0;          ///< K by which the recorded temperature changes
};

/// Values of all parameters at once, (np) each.
struct EffectSizes {
  Eigen::VectorXd min, max;  ///< -inf and inf where there are no bounds
  Eigen::VectorXd start, typical;
};

/// left <= right of the estimate, where it is a requirement, a falsifier or a usual range.
struct EffectCondition {
  std::string spelling;         ///< "vs <= 0.25*v90"
  std::string text;             ///< why
  std::vector<int> parameters;  ///< places of those that it reads
  /// right - left: not negative if it holds
  std::function<double(const Eigen::VectorXd& parameters, const EffectScales& scales)> slack;
};

/// Torque of an effect and its derivatives; what is not wanted stays empty.
struct EffectTorque {
  Eigen::MatrixXd torque;  ///< (N x outputs) N m or N
  /// (N x outputs * np): derivative of output o by parameter p in column o * np + p
  Eigen::MatrixXd by_parameter;
  /// (N x outputs * nv): by variable v, what the states remember of it left out; of Fc, Fv and Ia
  /// with it
  Eigen::MatrixXd by_variable;
  Eigen::MatrixXd by_initial;  ///< (N x outputs * states)
};

struct EffectWanted {
  bool by_parameter = false, by_variable = false, by_initial = false;
  bool torque = true;
  /// With by_parameter: derivatives by parameters of role kLinear; those by others are 0.
  bool linear_only = false;
  /// Derivatives by parameters with the states as they are. Exact for those of role kLinear, on
  /// which no state of a catalogue's effect depends, and several times as fast.
  bool states_held = false;
};

/// A physical effect as estimation and simulation see it, made of its effect file.
///
/// Elementwise in the variables it names: it knows no robot. An effect that acts on all joints is
/// evaluated for each of them with the derivatives of that joint's torque.
struct EffectLaw {
  std::string name, family, title;
  EffectKind kind = EffectKind::kAlgebraic;
  EffectScope scope = EffectScope::kJoint;
  AlignmentOperator alignment = AlignmentOperator::kNone;
  int alignment_parameter = -1;  ///< its place in parameters
  /// A parameter's place, or -1: derivatives of the model are taken where the joint's position, or
  /// the constant of the table, is further by half of it. What a change of it makes of the torque
  /// is then right to the second order.
  int midpoint = -1;
  bool acts_on_all = false;
  /// Of what acts on all joints: a force on the joint's link, which joints beyond do not carry.
  bool acts_inward = false;
  bool revolute_only = false;
  bool dissipates = false;
  bool proportional = false;  ///< no torque where all parameters of role kLinear are 0
  std::vector<EffectParameter> parameters;
  std::vector<std::string> variables;  ///< "qd", "tau_load", ...: columns of what evaluate() reads
  std::vector<std::string> states;     ///< names
  int outputs = 1;                     ///< torques: 2 of a pair
  std::vector<std::string> aliases;    ///< families
  std::vector<std::string> contains;   ///< families that are this one at some parameters
  std::vector<std::string> tests;      ///< of the name, by the words of effect files
  std::vector<EffectCondition> requirements, falsifiers;
  std::vector<EffectCondition> usual;  ///< ranges of such machines; values beyond them are rare

  std::function<EffectSizes(const EffectScales& scales)> sizes;

  /// Of consecutive samples of one run.
  /// @param variables    (N x nv)             @param parameters  (np)
  /// @param sample_time  s
  /// @param state        (states) before the first sample; becomes that after the last one. Empty
  ///                     without states
  std::function<EffectTorque(const Eigen::MatrixXd& variables, const Eigen::VectorXd& parameters,
                             double sample_time, Eigen::VectorXd& state,
                             const EffectWanted& wanted)>
      evaluate;

  /// (states) at the first sample of a run that nothing is known before: what a link that does not
  /// swing has. variables: (nv) of that sample. Empty: all 0.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& variables)> start;

  /// Torque at given states, and dz/dt of them, for one moment: what a simulation integrates.
  /// variables: (nv), z: (states), torque: (outputs), rate: (states; 0 beyond a limit). A sign of
  /// something else than the joint's own velocity is smooth within 1e-3 (rad/s or m/s).
  /// May keep buffers: one thread at a time.
  std::function<void(const double* variables, const double* parameters, const double* z,
                     double* torque, double* rate)>
      moment;

  [[nodiscard]] int size() const { return static_cast<int>(parameters.size()); }
  /// Usual ranges that an estimate is beyond.
  [[nodiscard]] std::vector<const EffectCondition*> unusual(const Eigen::VectorXd& values,
                                                            const EffectScales& scales) const;
  /// Whether a variable is among those that it names.
  [[nodiscard]] bool reads(std::string_view variable) const;
};

/// A shape that no recording as short can show: its bounds leave no value, and would if the
/// recording were longer. @return its place; -1: none
int slower_than_recording(const EffectLaw& law, const EffectScales& scales);

/// What a run of a law begins with: its start, or 0. @param variables  (N x nv) of the run
Eigen::VectorXd first_states(const EffectLaw& law, const Eigen::MatrixXd& variables);

/// An effect of one robot with its numbers.
struct EffectInstance {
  EffectLaw law;
  int joint = -1;              ///< coordinate, from 0; -1 of scope robot and of fixed links
  int link = 0;                ///< of the robot file, from 1: what `joint` moves; 0 of scope robot
  int other = -1;              ///< of scope pair
  Eigen::VectorXd parameters;  ///< (np); NaN: unknown
  /// Of an event: the recording in which alone it acts, as EffectRun::recording; -1: in all.
  int recording = -1;
};

}  // namespace dyngen::runtime

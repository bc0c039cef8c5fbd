// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "runtime/evidence/joint_columns.h"

namespace dyngen::runtime {

/// A quantity that torque may depend on, of a joint or of the recording.
struct StructureVariable {
  enum class Kind {
    kPosition,
    kVelocity,
    kAcceleration,
    kLoad,     ///< inertial torque of the model
    kTime,     ///< s from the recording's first sample
    kDistance  ///< travelled since the joint's last reversal, rad or m
  };
  Kind kind = Kind::kPosition;
  int joint = -1;  ///< coordinate, from 0; -1 of the time

  bool operator==(const StructureVariable&) const = default;
};

/// "q2", "qd2", "qdd2", "tau_load2", "distance2", "t"; joints from 1.
std::string variable_name(const StructureVariable& variable);
/// The variable of such a name; none if there is none.
std::optional<StructureVariable> variable_of_name(const std::string& name);

/// Torque of a joint without the name of an effect.
struct GenericStructure {
  enum class Form {
    kFunction,  ///< any smooth function of one or two variables: piecewise linear between quantiles
                ///< of the recordings, for two variables the products of coarser ones
    kFriction,  ///< the same times the sign of the joint's velocity
    kSpeeds,    ///< a function of the product of two velocities, or that product times a coarse
                ///< function of a third variable
    kImpulses,  ///< stiction impulses: where the joint reverses or stops, stiction of any value up
                ///< to its breakaway level, which is no function of the motion
    kLine,      ///< a sinusoid that goes on by itself, in every run with a phase of its own
    kWave,      ///< a sinusoid of a sum of two positions
    kRepeats    ///< whatever comes back in every period, up to some frequency
  };
  int joint = 0;                             ///< coordinate, from 0
  std::vector<StructureVariable> variables;  ///< none of impulses, lines and what repeats
  Form form = Form::kFunction;
  /// Of a line its Hz, of what repeats the highest, and of a wave what it turns by with each of its
  /// positions, 1/rad or 1/m: once that is known.
  Eigen::Vector2d frequency = Eigen::Vector2d::Zero();

  [[nodiscard]] std::vector<std::string> names() const;
  /// Whether it says what the torque depends on: what only repeats stands back behind all others.
  [[nodiscard]] bool is_specific() const { return form != Form::kRepeats; }
};

/// Those that are looked at for every joint: its own position, velocity, acceleration, load, time
/// and distance since reversal, position, velocity and acceleration of the others, friction that
/// depends on these, pairs of positions, of velocities and of a velocity with a position, products
/// of velocities alone and with a position, impulses at reversals, lines, waves and what repeats.
std::vector<GenericStructure> generic_structures(int joints);

/// The same of recordings, in their order: without those on masked joints, or of variables of such
/// joints.
std::vector<GenericStructure> structures_of(const EffectRecordings& data);

/// Impulses at each reversal of a joint.
GenericStructure impulses_at_reversals(int joint);

/// Sign of the velocity as positions show it, at all samples of a run. @return (N)
Eigen::VectorXd travelled_sign_of(const EffectRecordings& data, std::size_t run, int joint);

/// A variable at all samples of a run. @return (N)
Eigen::VectorXd variable_values(const EffectRecordings& data, EffectSignals& signals,
                                std::size_t run, const StructureVariable& variable);

/// The same at the equations of all runs, one after the other. @return (equations)
Eigen::VectorXd values_at_equations(const EffectRecordings& data, EffectSignals& signals,
                                    const StructureVariable& variable);

}  // namespace dyngen::runtime

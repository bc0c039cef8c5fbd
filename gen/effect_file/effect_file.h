// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gen/diagnostic/diagnostic.h"
#include "gen/effect_file/effect_expression.h"

namespace dyngen {

enum class EffectKind {
  kAlgebraic,  ///< torque of the present motion
  kStateful,   ///< with states that remember
  kTangent,    ///< made of derivatives of the rigid model
  kAlignment   ///< the recorded torque comes late
};

/// What one row `effect` of a robot file belongs to.
enum class EffectScope {
  kJoint,  ///< joint=
  kPair,   ///< joint= and other=
  kRobot
};

/// How the value of a parameter is found.
enum class ParameterRole {
  kLinear,   ///< torque is linear in it
  kShape,    ///< anything else: found from its start value
  kScanned,  ///< a shape with many local minima: held where a number is given, else scanned
  kGiven     ///< a property of the machine: never estimated
};

struct EffectParameter {
  std::string name;
  ParameterRole role = ParameterRole::kLinear;
  std::string unit;
  /// Bounds, start and typical size: expressions in the scales (effect_scales()); `typical` is what
  /// such machines have.
  std::optional<EffectExpression> min, max;
  EffectExpression start, typical;
  int grid = 0;              ///< of kScanned: how many values are tried between min and max
  bool logarithmic = false;  ///< the scale on which values of it are alike
  std::string meaning;
  SourcePosition position;

  /// Where no start is written, the typical size is it: one mistake is said once.
  [[nodiscard]] bool has_own_start() const {
    return start.position.line != typical.position.line ||
           start.position.column != typical.position.column;
  }
};

/// dz/dt = rate, held between min and max where these are given.
struct EffectState {
  std::string name;
  std::string unit;
  std::optional<EffectExpression> min, max;
  std::optional<EffectExpression> start;  ///< at the first sample; none: 0
  EffectExpression rate;
  SourcePosition position;
};

/// Another family, and what it has to do with the effect: what it may be mistaken for and how the
/// two are told apart, or what it is a part of.
struct RelatedFamily {
  std::string family;
  std::string text;
  SourcePosition position;
};

/// left <= right must hold of the estimate (require), or the name is not believed (falsifier), or
/// is less likely (usual).
struct EffectCondition {
  EffectExpression left, right;
  std::string text;  ///< why, for people
  SourcePosition position;
};

/// A test on data that a name must pass, by the name of the test.
struct EffectTest {
  std::string test;
  std::string text;
  SourcePosition position;
};

enum class AlignmentOperator { kDelay, kLag };

/// A physical effect as its file says: the one definition from which it is emitted, fitted,
/// simulated and documented. docs/reference/effect_file.md has the grammar.
struct EffectFile {
  std::string file_name;
  std::string name;
  std::string family;
  std::string title;
  EffectKind kind = EffectKind::kAlgebraic;
  EffectScope scope = EffectScope::kJoint;
  bool revolute_only = false;
  bool dissipates = false;  ///< with the joint's friction it never drives the joint
  std::vector<EffectParameter> parameters;
  std::vector<EffectState> states;
  std::vector<std::pair<std::string, EffectExpression>> lets;
  /// Torque that the actuator needs in addition, N m or N. One; two of a pair: of `joint` and of
  /// `other`. With derivatives of the rigid model in it, it is one for every joint of the robot.
  std::vector<EffectExpression> torque;
  std::optional<AlignmentOperator> alignment;
  std::string alignment_parameter;
  /// A parameter by half of which derivatives of the model are taken further on; or empty.
  std::string midpoint;
  std::vector<EffectCondition> requirements;
  std::vector<EffectCondition> falsifiers;
  std::vector<EffectCondition> usual;  ///< ranges of such machines: values beyond them are rare
  std::vector<EffectTest> tests;
  std::vector<RelatedFamily> aliases;
  std::vector<RelatedFamily> contains;  ///< families that are this effect at some parameters
  std::string hidden;                   ///< what hides it
  std::string separates;                ///< what tells it from others
  std::string source;                   ///< literature
  std::string plot;                     ///< the variable in which its signature is drawn
  /// Variables that its equations read, without parameters and states, in the table's order.
  std::vector<std::string> variables;

  /// Made of derivatives of the rigid model: it acts on every joint.
  [[nodiscard]] bool acts_on_all() const;
  /// Made of forces and moments on a link (contact_*) alone: joints beyond the link carry nothing.
  [[nodiscard]] bool acts_inward() const;
  /// Algebraic or stateful, and everything that it reads is known in a controller.
  [[nodiscard]] bool runs_in_controller() const;
};

/// Families of effects, as files, reports and JSON name them.
const std::vector<std::string_view>& effect_families();

/// A quantity of the joint or the recording by which sizes are given: Fc, v_max, ...
struct EffectScale {
  std::string_view name, unit, meaning;
};
const std::vector<EffectScale>& effect_scales();

/// Tests that a name can be made to pass, with what they ask.
const std::vector<std::pair<std::string_view, std::string_view>>& effect_tests();

/// Reads an effect file and checks it: names, units, which parameters torque is linear in, what its
/// kind may read.
/// @throws ModelError  with up to 20 positioned messages
EffectFile parse_effect_file(const std::string& text, std::string file_name);
EffectFile read_effect_file(const std::string& path);

}  // namespace dyngen

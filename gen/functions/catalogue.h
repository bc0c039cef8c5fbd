// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// One side of an array; of the model or fixed.
enum class Extent { kOne, kThree, kFour, kSix, kJoints, kChi, kBeta, kFolded };
int extent_size(Extent extent, const CodeModel& code);

/// An output array, row-major.
struct OutputSpec {
  std::string_view array;  ///< "tau", "M"
  Extent rows = Extent::kJoints;
  Extent columns = Extent::kOne;
  std::string_view unit{};  ///< for the comment; empty: torque of each joint
};

/// What a function may read besides the motion, if the options ask for it.
struct ExtraInputs {
  bool gravity = false;  ///< gravity[3]
  bool wrench = false;   ///< wrench[6]
  bool payload = false;  ///< payload[10]
  bool weights = false;  ///< A[n x nbeta], wherever there are any
  bool load = false;     ///< w[6]: force and moment in the axes of frame 0
};

/// What functions of torque read.
inline constexpr ExtraInputs kAllInputs = {.gravity = true, .wrench = true, .payload = true};

/// What a function has to do with the effects of a robot.
enum class EffectPart {
  kIn,       ///< they are in its result
  kLeftOut,  ///< it is that of the model without them
  kNone      ///< it knows nothing of torque
};

/// A function that dyngen can write: the one place that knows its name, inputs and meaning.
///
/// A function of one link's frame (`of_link()`) has a name for each link: "fk" speaks of the last
/// link of the file, "fk_3" of link 3.
struct FunctionSpec {
  std::string_view name;                 ///< without the prefix
  std::vector<std::string_view> inputs;  ///< "q", "dq", "ddq", "tau": one value per coordinate
  std::vector<OutputSpec> outputs;
  ExtraInputs reads;
  std::string_view summary;
  void (*write)(Trace&, const CodeModel&) = nullptr;
  void (*write_of_link)(Trace&, const CodeModel&, int link) = nullptr;  ///< instead of `write`
  /// Why a robot has no such function; empty if it has. Null: every robot has it.
  std::string (*why_absent)(const CodeModel&) = nullptr;
  bool is_missed = false;  ///< a robot without it is told so, though nobody asked for it
  EffectPart effects = EffectPart::kLeftOut;
  /// The inputs of a robot with effects; null: they are `inputs` on every robot.
  std::vector<std::string_view> (*inputs_of)(const CodeModel&) = nullptr;

  [[nodiscard]] bool of_link() const { return write_of_link != nullptr; }
};

/// All functions, in the order in which they are emitted.
const std::vector<FunctionSpec>& function_catalogue();

/// folded = fold(chi): the function that goes with folded functions, and stands after them. Nobody
/// asks for it by its name.
const FunctionSpec& fold_spec();

/// A function as it is asked for: "id", "fk" or "fk_3".
struct FunctionName {
  const FunctionSpec* spec = nullptr;
  int link = 0;  ///< that the name ends in; 0 if none

  [[nodiscard]] std::string text() const;
};

/// @return no spec if the catalogue has no such function; whether the robot has the link is not
/// asked here
FunctionName parse_function_name(std::string_view name);

/// @return null if there is none of this name ("fk_3" is "fk")
const FunctionSpec* find_function(std::string_view name);

/// "id, gravity": for messages.
std::string catalogue_names();

/// An argument of an emitted function.
struct Argument {
  std::string name;
  int rows = 1;
  int columns = 1;
  bool output = false;
  bool shared = false;  ///< a batch has one of it for all samples
  bool state = false;   ///< not an array: what effects remember, read and written

  [[nodiscard]] int size() const { return rows * columns; }
};

/// True if the function has the argument s: effects with states are in it. It has no batch then.
bool has_state(const FunctionSpec& spec, const CodeModel& code);

/// The arguments in the order of the C function: s, q, dq, ddq or tau, A, w, gravity, wrench,
/// payload, chi (or folded), outputs. The one definition of a function's signature.
std::vector<Argument> arguments(const FunctionSpec& spec, const CodeModel& code);

/// The same function over many samples, structure of arrays: the name with this ending.
inline constexpr std::string_view kBatchEnding = "_batch";

}  // namespace dyngen

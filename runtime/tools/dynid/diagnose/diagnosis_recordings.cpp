// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/diagnosis_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/recordings/reader.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"

namespace dyngen::runtime {
namespace {

/// Why an effect cannot be taken for known; empty: it can.
std::string objection(const EffectInstance& effect, bool open) {
  if (!effect.parameters.allFinite()) {
    return "has no numbers: expected some, since a diagnosis takes the effects of the file for "
           "known ('dynid fit' finds them)";
  }
  if (effect.law.kind == EffectKind::kTangent || effect.law.kind == EffectKind::kAlignment) {
    return "cannot be taken off a recording: expected effects of a joint's motion, so leave the "
           "row out and let the diagnosis find it";
  }
  const auto& variables = effect.law.variables;
  if (open && std::any_of(variables.begin(), variables.end(), depends_on_model)) {
    return "reads friction or load that the file leaves open: expected numbers in all rows of the "
           "file, or leave the row out and let the diagnosis find it";
  }
  return {};
}

}  // namespace

MotionSource unexplained_motion(const std::string& path, const MotionOptions& options,
                                std::vector<Notice>* repairs) {
  std::vector<Notice> own;
  std::vector<Notice>& told = repairs == nullptr ? own : *repairs;
  Recording recording = read_recording(path, {}, &told);
  if (recording.tau_sim.size() == 0) {
    throw std::invalid_argument(fmt::format(
        "{}: there are no columns tausim1 .. tausim{}: --residual-only explains what another "
        "simulator leaves of the recorded torque, and expects that simulator's torques there",
        path, recording.joints()));
  }
  recording.tau -= recording.tau_sim;
  MotionSource source = motion_of(std::move(recording), options);
  source.condition.repairs = told;
  return source;
}

KnownEffects known_effects(const RobotSource& source, const EffectCatalogue& catalogue) {
  const DescribedRobot fitted = describe_robot(source, OpenParameters::kAbsentRows);
  const auto& parameters = fitted.linear.parameters;
  const bool open =
      std::any_of(parameters.begin(), parameters.end(),
                  [](const LinearParameter& parameter) { return !parameter.value.has_value(); });
  KnownEffects known{describe_robot(source, OpenParameters::kAsWritten), {}};
  known.effects = effect_instances(known.robot.model, catalogue);
  const RobotFile& file = known.robot.file;
  Diagnostics diagnostics(file.file_name, file.source_text);
  for (std::size_t i = 0; i < known.effects.size(); ++i) {
    const std::string why = objection(known.effects[i], open);
    if (why.empty()) continue;
    const std::string& name = known.effects[i].law.name;
    diagnostics.error(file.effects[i].position, static_cast<int>(name.size()),
                      fmt::format("effect '{}' {}", name, why));
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
  return known;
}

namespace {

/// One joint state without them: see without_effects().
MotionSource taken_off(const MotionSource& source, const KnownEffects& known) {
  auto pieces = std::make_shared<std::vector<StreamPiece>>();
  source.pieces([&](const StreamPiece& piece) {
    const Motion& motion = piece.motion;
    Recording recording;
    recording.time = motion.time;
    recording.q = motion.q;
    recording.dq = motion.dq;
    recording.ddq = motion.ddq;
    recording.tau = motion.tau;
    recording.temperature = motion.temperature;
    recording.run_starts = {0};
    pieces->push_back(piece);
    pieces->back().motion.tau =
        2 * motion.tau - recorded_torque(known.robot, known.effects, recording);
  });
  return with_pieces(source, [pieces](const std::function<void(const StreamPiece&)>& visit) {
    for (const StreamPiece& piece : *pieces) visit(piece);
  });
}

}  // namespace

MotionSource without_effects(const MotionSource& source, const KnownEffects& known) {
  if (known.effects.empty()) return source;
  return made_of(source, [known](const MotionSource& state) { return taken_off(state, known); });
}

}  // namespace dyngen::runtime

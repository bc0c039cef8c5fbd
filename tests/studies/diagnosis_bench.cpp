// SPDX-License-Identifier: MIT
#include "tests/studies/diagnosis_bench.h"

#include <fmt/format.h>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/diagnosis/equation_sets/equation_sets.h"
#include "runtime/tools/dynid/effects/robot_tangents.h"

namespace dyngen::test {

using Eigen::MatrixXd;
using runtime::EffectInstance;
using runtime::EffectLaw;
using runtime::EffectRecordings;
using runtime::MotionSource;
using runtime::Recording;

runtime::MotionOptions case_motion_options() {
  runtime::MotionOptions options;
  options.average_periods = false;
  return options;
}

MotionSource source_of(const Bench& bench, const CaseMotion& motion, const MatrixXd& torque,
                       std::size_t place) {
  Recording recording = motion.truth;
  recording.file_name = place < kTrainRecordings
                            ? fmt::format("train{}", place + 1)
                            : fmt::format("heldout{}", place - kTrainRecordings + 1);
  recording.q = motion.encoder;
  recording.dq.resize(0, 0);
  recording.ddq.resize(0, 0);
  recording.tau = torque + bench.error[place].topRows(torque.rows());
  return runtime::motion_of(std::move(recording), case_motion_options());
}

EffectRecordings plain_recordings(const Bench& bench, const EffectLaw* law, int joint) {
  std::vector<MotionSource> sources;
  for (std::size_t r = 0; r < kTrainRecordings; ++r) {
    sources.push_back(source_of(bench, bench.plain[r], bench.plain[r].truth.tau, r));
  }
  std::vector<bool> remembering(static_cast<std::size_t>(bench.robot.joints()), false);
  if (law != nullptr && !law->states.empty() && joint >= 0) {
    remembering[static_cast<std::size_t>(joint)] = true;
  }
  return runtime::effect_recordings(bench.robot.told.linear,
                                    runtime::effect_robot(bench.robot.told), sources,
                                    runtime::diagnosis_rows(sources, 0), remembering);
}

std::vector<MatrixXd> torque_in(const Bench& bench, const EffectInstance& effect, int only) {
  CaseSettings open = bench.settings;
  open.closed_loop = false;  // all of it, on the motion as it is
  std::vector<MatrixXd> result;
  for (std::size_t r = 0; r < kTrainRecordings; ++r) {
    const bool in = only < 0 || only == static_cast<int>(r);
    result.push_back(recorded_share(bench.robot, open, bench.plain[r],
                                    in ? std::vector{effect} : std::vector<EffectInstance>{}));
  }
  return result;
}

}  // namespace dyngen::test

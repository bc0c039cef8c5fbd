// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/within_rounding.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

constexpr double kOfStep = 0.25;  // of an encoder: an error that is no rounding

}  // namespace

bool within_rounding(const EffectRecordings& data, const Hypothesis& hypothesis,
                     const EffectInstance& estimate) {
  if (!is_position_error(hypothesis) || estimate.joint < 0) return false;
  double step = 0;
  for (const EffectRun& run : data.runs) step = std::max(step, run.position_step[estimate.joint]);
  double squares = 0;
  for (const int p : hypothesis.linear) {
    squares += estimate.parameters[p] * estimate.parameters[p];
  }
  return std::sqrt(squares) < kOfStep * step;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
// From a recording to base parameters, with a model of one's own.
#include <cstdio>

#include "../pendulum_model.h"
#include "runtime/identification/fit.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/identification/summary.h"
#include "runtime/model/linear_model.h"
#include "runtime/recordings/recording.h"
#include "runtime/signals/joint_state.h"
#include "runtime/signals/motion.h"

using namespace dyngen::runtime;

int main() {
  constexpr int kSamples = 10000;
  Recording run;
  run.file_name = "made.csv";
  run.time.resize(kSamples);
  run.q.resize(kSamples, 1);
  run.tau.resize(kSamples, 1);
  run.run_starts = {0};
  for (int k = 0; k < kSamples; ++k) {
    run.time[k] = 0.002 * k;
    const pendulum::State state = pendulum::motion_at(run.time[k]);
    run.q(k, 0) = state.q;
    pendulum::id(&state.q, &state.dq, &state.ddq, &run.tau(k, 0));
    run.tau(k, 0) += 0.01 * ((k * 7919) % 101 - 50) / 50;  // what stands for noise
  }

  // joint state alone
  const JointStates states = joint_states(run);
  for (const Motion& motion : states.runs) {
    std::printf("%ld samples behind %.1f Hz\n", static_cast<long>(motion.samples()),
                states.cutoff.hz);
  }

  // the whole way
  const LinearModel model = pendulum_model();
  const MotionSource source = motion_of(run, {});
  FitData data;
  data.summary = summarise(model, source, RowOptions{});
  data.rows = rows_of(model, source, RowOptions{});
  const MethodFit fit = fit_methods(model, data, FitOptions{}).front();
  const Eigen::Vector3d truth(pendulum::kInertia, pendulum::kMoment, pendulum::kViscous);
  for (int p = 0; p < model.size(); ++p) {
    std::printf("%s = %.4f +- %.4f %s\n",
                model.parameters[static_cast<std::size_t>(p)].name.c_str(), fit.estimate.beta[p],
                fit.interval * fit.stddev()[p],
                model.parameters[static_cast<std::size_t>(p)].unit.c_str());
  }
  return (fit.estimate.beta - truth).norm() < 0.02 ? 0 : 1;
}

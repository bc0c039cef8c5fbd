// SPDX-License-Identifier: MIT
// A recording is written, read back, and looked at.
#include <cstdio>
#include <vector>

#include "../pendulum.h"
#include "runtime/recordings/clipping.h"
#include "runtime/recordings/notice.h"
#include "runtime/recordings/periods.h"
#include "runtime/recordings/quantisation.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/recording.h"
#include "runtime/recordings/time_base.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"

using namespace dyngen::runtime;

int main() {
  constexpr int kSamples = 4000;
  Recording run;
  run.time.resize(kSamples);
  run.q.resize(kSamples, 1);
  run.tau.resize(kSamples, 1);
  run.run_starts = {0};
  for (int k = 0; k < kSamples; ++k) {
    run.time[k] = 0.005 * k;
    const pendulum::State state = pendulum::motion_at(run.time[k]);
    run.q(k, 0) = state.q;
    pendulum::id(&state.q, &state.dq, &state.ddq, &run.tau(k, 0));
  }
  write_recording(run, "recording.csv");

  std::vector<Notice> notices;
  const Recording read = read_recording("recording.csv", {}, &notices);
  for (const Notice& notice : notices) std::printf("%s\n", notice.text().c_str());
  const TimeBase time_base = examine_time_base(read);
  const Periods periods = find_periods(read);
  const bool steps = find_quantisation(read.q.col(0)).step > 0 && !time_base.uniform;
  const bool clipped = find_clipping(read.tau.col(0)).clipped;

  const Trajectory trajectory = read_trajectory("recording.csv");
  double q = 0, dq = 0, ddq = 0;
  motion_at(trajectory, 1.0025, &q, &dq, &ddq);
  try {
    read_recording("no_such_file.csv");
    return 2;
  } catch (const RecordingError&) {
  }
  return read.q == run.q && time_base.uniform && periods.count == 4 && !steps && !clipped &&
                 std::abs(q - pendulum::motion_at(1.0025).q) < 1e-4
             ? 0
             : 1;
}

// SPDX-License-Identifier: MIT
// Measured robots, where they are at hand.
#include <gtest/gtest.h>

#include "runtime/recordings/clipping.h"
#include "runtime/recordings/periods.h"
#include "runtime/recordings/quantisation.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/time_base.h"
#include "tests/support/shared_data.h"

namespace dyngen::test {
namespace {

using runtime::Recording;

TEST(RealRecordings, Tx40IsUniform) {
  const std::string name = "tx40/tx40.csv";
  const auto path = shared_data(name);
  if (!path) GTEST_SKIP() << skip_sentence(name);
  std::vector<runtime::Notice> notices;
  const Recording recording = runtime::read_recording(*path, {}, &notices);
  EXPECT_TRUE(notices.empty());
  EXPECT_EQ(recording.samples(), 45000);
  EXPECT_EQ(recording.joints(), 6);
  EXPECT_EQ(recording.run_starts.size(), 1U);
  const runtime::TimeBase base = runtime::examine_time_base(recording);
  EXPECT_TRUE(base.uniform) << base.message;
  EXPECT_EQ(base.sample_time, 0.0002);
  // 3.2e-5 rad on the motor, gear 32
  const runtime::Quantisation encoder = runtime::find_quantisation(recording.q.col(0));
  EXPECT_NEAR(encoder.step, 9.99e-7, 3e-9);
  EXPECT_FALSE(encoder.print_resolution);
  EXPECT_EQ(runtime::find_periods(recording).samples, 0);
  for (const auto& column : recording.tau.colwise()) {
    EXPECT_FALSE(runtime::find_clipping(column).clipped);
  }
}

TEST(RealRecordings, DoublePendulumIsJittered) {
  const std::string name = "dfki/a_0.csv";
  const auto path = shared_data(name);
  if (!path) GTEST_SKIP() << skip_sentence(name);
  const Recording recording = runtime::read_recording(*path);
  EXPECT_EQ(recording.joints(), 2);
  EXPECT_EQ(recording.dq.cols(), 2);
  const runtime::TimeBase base = runtime::examine_time_base(recording);
  EXPECT_FALSE(base.uniform) << base.message;
  EXPECT_NEAR(base.sample_time, 0.002, 2e-4);
  const Recording even = runtime::resample(recording, base.sample_time);
  EXPECT_TRUE(runtime::examine_time_base(even).uniform);
}

}  // namespace
}  // namespace dyngen::test

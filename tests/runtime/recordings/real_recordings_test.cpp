// SPDX-License-Identifier: MIT
// Measured robots, where they are at hand.
#include <gtest/gtest.h>

#include "runtime/recordings/clipping.h"
#include "runtime/recordings/periods.h"
#include "runtime/recordings/quantisation.h"
#include "runtime/recordings/reader.h"
#include "runtime/recordings/time_base.h"
#include "tests/runtime/recordings/recording_texts.h"
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
  // Its motor angles beyond 10 rad were printed to 1e-3 rad; gears 32 and 45.
  const runtime::Quantisation second = runtime::find_quantisation(recording.q.col(1));
  EXPECT_NEAR(second.step, 1e-3 / 32, 1e-7);
  EXPECT_FALSE(second.print_resolution);
  EXPECT_NEAR(runtime::find_quantisation(recording.q.col(2)).step, 1e-3 / 45, 1e-7);
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
  // 16 bits over 25 rad, on position
  EXPECT_NEAR(runtime::find_quantisation(recording.q.col(0)).step, 25.0 / 65535, 1e-6);
  const Recording even = runtime::resample(recording, base.sample_time);
  EXPECT_TRUE(runtime::examine_time_base(even).uniform);
}

/// Nothing is repaired but a time that stands twice in one of them.
TEST(RealRecordings, AreLeftAsTheyAre) {
  int read = 0;
  for (const std::string name : {"kr300/train_1.csv.gz",
                                 "kr300/train_2.csv.gz",
                                 "kr300/heldout_1.csv.gz",
                                 "xl330/kp400_lift_and_drop.csv.gz",
                                 "xl330/kp400_sin_sin.csv.gz",
                                 "xl330/kp400_sin_time_square.csv.gz",
                                 "xl330/kp400_up_and_down.csv.gz",
                                 "tx40/tx40.csv",
                                 "dfki/a_0.csv",
                                 "dfki/a_1.csv",
                                 "dfki/a_2.csv",
                                 "dfki/a_3.csv",
                                 "dfki/c_0.csv",
                                 "dfki/c_1.csv",
                                 "dfki/c_2.csv",
                                 "dfki/c_3.csv",
                                 "dfki_friction/off_1.csv.gz",
                                 "dfki_friction/off_2.csv.gz",
                                 "dfki_friction/off_3.csv.gz",
                                 "dfki_friction/compensated.csv.gz"}) {
#ifndef DYNGEN_WITH_ZLIB
    if (name.ends_with(".gz")) continue;
#endif
    const auto path = shared_data(name);
    if (!path) continue;
    ++read;
    std::vector<runtime::Notice> notices;
    const Recording repaired = runtime::read_recording(*path, {}, &notices);
    runtime::ReadOptions raw;
    raw.repair_signals = false;
    const Recording recording = runtime::read_recording(*path, raw);
    EXPECT_TRUE(same(repaired, recording)) << name;
    const std::size_t expected = name == "dfki_friction/compensated.csv.gz" ? 1 : 0;
    EXPECT_EQ(notices.size(), expected) << name << (notices.empty() ? "" : notices[0].text());
  }
  if (read == 0) GTEST_SKIP() << skip_sentence("kr300, xl330, tx40, dfki");
}

}  // namespace
}  // namespace dyngen::test

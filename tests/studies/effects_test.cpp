// SPDX-License-Identifier: MIT
// Few recordings of docs/explanation/studies.md.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/studies/effect_recovery.h"

namespace dyngen::test {
namespace {

class Recovery : public testing::TestWithParam<const char*> {};

TEST_P(Recovery, FindsWhatWasPutIn) {
  const EffectCatalogue catalogue;
  const EffectRecovery recovery =
      recover(effect_study_robot(), *catalogue.find(GetParam()), {.recordings = 2});
  std::printf("%s: worst %.2f standard deviations, seeds from 1\n", GetParam(), recovery.worst());
  EXPECT_EQ(recovery.failure, "");
  EXPECT_EQ(recovery.unseen, 0);
  ASSERT_FALSE(recovery.errors.empty());
  // of a handful of errors none should be beyond 3.5 of its deviations: 1 in 2000 each
  EXPECT_LT(recovery.worst(), 3.5);
}

INSTANTIATE_TEST_SUITE_P(Effects, Recovery,
                         testing::Values("stribeck", "load_friction", "dahl", "joint_elasticity",
                                         "coulomb_coupling", "time_delay", "payload_change"),
                         [](const auto& own) { return std::string(own.param); });

TEST(WhatNoMotionShows, IsSaid) {
  const EffectCatalogue catalogue;
  for (const char* name : {"constant_offset", "payload", "global_torque_gain"}) {
    const EffectRecovery recovery =
        recover(effect_study_robot(), *catalogue.find(name), {.recordings = 1});
    EXPECT_EQ(recovery.unseen, 1) << name;
  }
}

}  // namespace
}  // namespace dyngen::test

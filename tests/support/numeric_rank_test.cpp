// SPDX-License-Identifier: MIT
#include "tests/support/numeric_rank.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/oracle_data.h"

namespace dyngen::test {
namespace {

struct Counts {
  std::string robot;
  int inertial, inertial_and_rotor, gravity;
};

// Found with exact arithmetic: tests/data/oracles/ORACLES.md, "Base parameters".
const Counts kCounts[] = {
    {"planar2r", 6, 7, 4},
    {"rp", 6, 7, 3},
    {"scara_rrpr", 8, 11, 1},
    {"stanford", 33, 37, 9},
    {"rx90", 36, 40, 10},
    {"ur10e", 36, 40, 10},
    {"panda7", 43, 48, 12},
    {"puma560_akb_mdh", 36, 40, 10},
    {"puma560_corke_std", 36, 40, 10},
    {"puma3", 15, 16, 4},
    {"sarcos", 45, 50, 14},
};

NumericRobot load(const std::string& name) {
  if (name == "puma3") return load_puma3();
  if (name == "sarcos") return load_sarcos();
  return load_oracle(name).robot;
}

void expect_rank(const NumericRank& found, int expected, const char* what) {
  EXPECT_EQ(found.rank, expected) << what;
  // The decision is clear: what is kept is far above what is dropped.
  EXPECT_GT(found.last_kept, 1e-4) << what;
  EXPECT_LT(found.first_dropped, 1e-14) << what;
}

void expect_ranks(const BaseParameterRanks& found, const Counts& expected) {
  expect_rank(found.inertial, expected.inertial, "inertial");
  expect_rank(found.inertial_and_rotor, expected.inertial_and_rotor, "inertial and IA");
  expect_rank(found.gravity, expected.gravity, "gravity");
}

class NumericRankOf : public testing::TestWithParam<Counts> {};

TEST_P(NumericRankOf, EqualsTheExactCount) {
  expect_ranks(base_parameter_ranks(load(GetParam().robot)), GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, NumericRankOf, testing::ValuesIn(kCounts),
                         [](const auto& test) { return test.param.robot; });

TEST(NumericRank, DoesNotDependOnTheConvention) {
  for (const Counts& expected : kCounts) {
    if (expected.robot == "puma3" || expected.robot == "sarcos") continue;
    const Oracle oracle = load_oracle(expected.robot);
    if (!oracle.standard) continue;  // stored in one convention only
    SCOPED_TRACE(expected.robot);
    expect_ranks(base_parameter_ranks(*oracle.standard), expected);
  }
}

// The Sarcos base leans; upright, two first moments of link 1 are not felt.
TEST(NumericRank, GravityAlongJointOneHidesTwoParametersOfTheSarcos) {
  NumericRobot robot = load_sarcos();
  robot.base_acceleration = {0, 0, 9.81};
  EXPECT_EQ(base_parameter_ranks(robot).gravity.rank, 12);
}

}  // namespace
}  // namespace dyngen::test

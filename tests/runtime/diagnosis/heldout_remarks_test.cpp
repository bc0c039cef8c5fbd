// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/heldout_remarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dyngen::runtime {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::Not;

HeldoutResidual residual(const Vector3d& after, const Vector3d& visited) {
  return {Vector3d(1, 1, 1), after, Vector3d(0.5, 0.5, 0.5), visited};
}

std::vector<std::string> remarks_of(const HeldoutResidual& rms) {
  return heldout_remarks(rms, rms);
}

TEST(HeldoutRemarks, AreOfJointsThatArePredictedWorse) {
  const auto remarks = remarks_of(residual({1.3, 0.9, 1.01}, {0.4, 0.4, 0.4}));
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_THAT(remarks.front(), HasSubstr("joint 1: held-out"));
  EXPECT_THAT(remarks.front(), HasSubstr("40 % of them are within"));
}

TEST(HeldoutRemarks, BlameNoPositionsWhereAllWereVisited) {
  const auto remarks = remarks_of(residual({0.9, 1.3, 0.9}, {1, 1, 1}));
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_THAT(remarks.front(), HasSubstr("joint 2"));
  EXPECT_THAT(remarks.front(), Not(HasSubstr("within")));
}

TEST(HeldoutRemarks, SayWhereReversalsAreMostOfIt) {
  const HeldoutResidual all{Vector3d(9, 9, 1), Vector3d(9, 9, 0.9), Vector3d(0.5, 0.5, 0.5), {}};
  const HeldoutResidual judged{
      Vector3d(1, 9, 1), Vector3d(0.6, 9, 0.9), Vector3d(0.5, 0.5, 0.5), {}};
  const auto remarks = heldout_remarks(all, judged);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks.front(),
            "joint 1: most of it is near reversals, where friction can take any value; 0.6 without "
            "them");
}

TEST(HeldoutRemarks, OfABetterModelAreNone) {
  EXPECT_TRUE(remarks_of(residual({0.9, 0.9, 0.9}, {0.4, 1, 1})).empty());
  EXPECT_TRUE(remarks_of({}).empty());
}

}  // namespace
}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
// That a null is null, and that what is left out is there.
#include "tests/blind/cases/case.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::string kArms = DYNGEN_SOURCE_DIR "/tests/blind/arms";

/// What a refit leaves of the torque where nothing is noisy, rms over rms, the worst joint.
double left_share(const Case& made) {
  std::vector<MatrixXd> columns;
  std::vector<VectorXd> torque;
  for (const Recording& each : made.training) {
    MatrixXd own = base_columns(made.machine, each.log), tau = torque_rows(known_torque(each));
    for (MatrixXd* rows : {&own, &tau}) leave_out_rest(each.log, *rows);
    columns.push_back(own);
    torque.emplace_back(tau);
  }
  const std::vector<VectorXd> left = Refit(std::move(columns)).residual(torque);
  double worst = 0;
  for (Index j = 0; j < made.machine.joints(); ++j) {
    double above = 0, below = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Index samples = made.training[i].log.q.rows();
      above += left[i].segment(j * samples, samples).squaredNorm();
      below += torque[i].segment(j * samples, samples).squaredNorm();
    }
    worst = std::max(worst, std::sqrt(above / below));
  }
  return worst;
}

CaseOptions quiet(const std::string& kind, std::uint64_t seed) {
  CaseOptions options;
  options.kind = kind;
  options.seed = seed;
  options.noisy = false;
  return options;
}

CaseOptions single(const std::string& family, double lambda, std::uint64_t seed) {
  CaseOptions options;
  options.kind = "single";
  options.family = family;
  options.lambda = lambda;
  options.seed = seed;
  return options;
}

/// Accelerations that positions give, less the simulation's, rms over rms, the worst joint: what
/// the integrator errs. Not where a joint turns or rests: acceleration jumps there.
double acceleration_error(const Case& made) {
  double worst = 0;
  for (Index j = 0; j < made.machine.joints(); ++j) {
    double above = 0, below = 0;
    for (const Recording& each : made.training) {
      const Log& log = each.log;
      for (Index k = 2; k + 2 < log.q.rows(); ++k) {
        bool smooth = true;
        for (Index i = k - 2; i <= k + 2; ++i) {
          for (Index other = 0; other < log.q.cols(); ++other) {
            smooth &= log.sign(i, other) == log.sign(k, other) && std::abs(log.sign(i, other)) == 1;
          }
        }
        if (!smooth) continue;
        const double by_q = (-log.q(k - 2, j) + 16 * log.q(k - 1, j) - 30 * log.q(k, j) +
                             16 * log.q(k + 1, j) - log.q(k + 2, j)) *
                            log.rate * log.rate / 12;
        above += std::pow(by_q - log.ddq(k, j), 2);
        below += std::pow(log.ddq(k, j), 2);
      }
    }
    worst = std::max(worst, std::sqrt(above / below));
  }
  return worst;
}

// Of arms, loops and engines drawn at random: what the integrator and sticking leave.
TEST(Simulation, OfANullLeavesLessThanTwoThousandths) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto made = make_case(quiet("null", seed), kArms);
    ASSERT_TRUE(made) << seed;
    const double share = left_share(*made);
    const double error = acceleration_error(*made);
    std::cout << fmt::format("seed {}: {} {} {}: {:.2g} {:.2g}\n", seed, made->arm, made->engine,
                             made->loop, share, error);
    EXPECT_LT(share, 2e-3) << seed;
    EXPECT_LT(error, 2e-3) << seed;
  }
}

// The regressor sees what the plant does not show: the same bodies, by the other engine.
TEST(Simulation, OfWhatIsHiddenLeavesLessThanTwoThousandths) {
  for (std::uint64_t seed = 20; seed < 23; ++seed) {
    const auto made = make_case(quiet("hidden", seed), kArms);
    ASSERT_TRUE(made) << seed;
    EXPECT_LT(left_share(*made), 2e-3) << seed << " " << made->truths.front().family;
    EXPECT_GT(made->sizes.front(), 0);
  }
}

TEST(Simulation, HasTheWantedStrength) {
  const auto made = make_case(single("load_friction", 40, 3), kArms);
  ASSERT_TRUE(made);
  EXPECT_GT(made->lambdas.front(), 40 / 1.3);
  EXPECT_LT(made->lambdas.front(), 40 * 1.3);
  EXPECT_GT(made->absorbed.front(), 0);
  EXPECT_LT(made->absorbed.front(), 1);
  // some of it is at rests, some too fast for filtered positions
  EXPECT_GT(made->filtered, 0.05 * made->lambdas.front());
  EXPECT_LT(made->filtered, made->lambdas.front());
  ASSERT_EQ(made->heldout_oracle.size(), made->heldout_base.size());
}

TEST(Simulation, LatenessShowsMostlyInJolts) {
  CaseOptions options = single("time_delay", 80, 5);
  options.arm = "planar2";
  const auto made = make_case(options, kArms);
  ASSERT_TRUE(made);
  EXPECT_LT(made->filtered, 0.5 * made->lambdas.front());
}

// Arms that come to rest under a noisy encoder let go and hold on again.
TEST(Simulation, FrictionNeverPushes) {
  for (const std::uint64_t seed : {2605200U, 4U, 5U}) {
    CaseOptions options;
    options.arm = "twisted4";
    options.seed = seed;
    const auto made = make_case(options, kArms);
    ASSERT_TRUE(made) << seed;
    for (const auto* part : {&made->training, &made->heldout}) {
      for (const Recording& each : *part) {
        const Eigen::ArrayXXd along = each.log.sign.array() * each.log.dq.array();
        EXPECT_GT(along.minCoeff(), -1e-6) << seed;
      }
    }
  }
}

TEST(Simulation, IsTheSameTwice) {
  CaseOptions options;
  options.seed = 11;
  const auto first = make_case(options, kArms), second = make_case(options, kArms);
  ASSERT_TRUE(first && second);
  for (std::size_t i = 0; i < first->training.size(); ++i) {
    EXPECT_EQ(first->training[i].log.recorded, second->training[i].log.recorded);
    EXPECT_EQ(first->training[i].torque_noise, second->training[i].torque_noise);
    EXPECT_EQ(first->training[i].encoder_error, second->training[i].encoder_error);
  }
}

}  // namespace
}  // namespace blind

// SPDX-License-Identifier: MIT
/// What scans are made of: work for several threads, sinusoids that are turned on.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "runtime/diagnosis/scans/in_parallel.h"
#include "runtime/diagnosis/scans/turning.h"

namespace dyngen::runtime {
namespace {

TEST(InParallel, DoesEachPieceOnce) {
  constexpr std::size_t kPieces = 1000, kThreads = 3;
  std::vector<std::atomic<int>> done(kPieces);
  std::vector<double> told;
  in_parallel(
      kPieces, kThreads,
      [&](std::size_t piece, std::size_t thread) {
        EXPECT_LT(thread, kThreads);
        ++done[piece];
      },
      [&](double begun) { told.push_back(begun); });
  for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
  for (std::size_t i = 1; i < told.size(); ++i) EXPECT_GT(told[i], told[i - 1]);
  in_parallel(0, kThreads, [](std::size_t, std::size_t) { FAIL() << "there is no work"; });
}

TEST(InParallel, PassesOnWhatAPieceThrows) {
  // Alone, a thread begins nothing after the piece that throws. Another one may begin some before
  // it is told, which takes as long as it takes: its pieces are slow, so that all of them would
  // last 10 s.
  for (const std::size_t threads : {1u, 2u}) {
    std::atomic<std::size_t> done = 0;
    const auto work = [&](std::size_t piece, std::size_t) {
      ++done;
      if (piece == 3) throw std::invalid_argument("piece 3");
      if (piece > 3) std::this_thread::sleep_for(std::chrono::microseconds(100));
    };
    EXPECT_THROW(in_parallel(100000, threads, work), std::invalid_argument);
    EXPECT_LT(done, 100000u) << threads;
    if (threads == 1) {
      EXPECT_EQ(done, 4u);
    }
  }
}

TEST(Turning, IsCosineAndSineOfRisingMultiples) {
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(7, -3, 4);
  Turning turning(x, 2.5, 0.3);
  for (int n = 0; n < 1000; ++n, turning.next()) {
    const Eigen::ArrayXd angle = (2.5 + 0.3 * n) * x;
    ASSERT_LT((turning.cosine() - angle.cos()).abs().maxCoeff(), 1e-11) << n;
    ASSERT_LT((turning.sine() - angle.sin()).abs().maxCoeff(), 1e-11) << n;
  }
}

}  // namespace
}  // namespace dyngen::runtime

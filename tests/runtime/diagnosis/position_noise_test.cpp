// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/position_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/diagnosis/views/views.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Noise of the accelerations of joint 2, as a filter of noisy positions leaves it above all.
std::vector<MotionSource> with_noise(std::vector<MotionSource> sources, double deviation,
                                     unsigned seed) {
  for (MotionSource& source : sources) {
    ++seed;
    source.pieces = [all = source.pieces, deviation,
                     seed](const std::function<void(const StreamPiece&)>& visit) {
      std::mt19937_64 random(seed);
      std::normal_distribution<double> normal;
      all([&](StreamPiece piece) {
        for (double& acceleration : piece.motion.ddq.col(1)) {
          acceleration += deviation * normal(random);
        }
        visit(piece);
      });
    };
  }
  return sources;
}

/// Second differences of the acceleration of joint 2, of which a spring in its gear is made.
VectorXd second_differences(const Motion& motion) {
  const auto a = motion.ddq.col(1);
  const Index inner = a.size() - 2;
  VectorXd c = VectorXd::Zero(a.size());
  c.segment(1, inner) = a.head(inner) - 2 * a.segment(1, inner) + a.tail(inner);
  return c;
}

JointColumns columns_of(const EffectRecordings& data, EffectSignals& /*signals*/) {
  VectorXd all(data.equations());
  Index start = 0;
  for (const EffectRun& run : data.runs) {
    all.segment(start, run.motion.samples()) = second_differences(run.motion);
    start += run.motion.samples();
  }
  JointColumns columns;
  columns.joints = {1};
  columns.parts = {all};
  return columns;
}

/// What such columns explain of recordings with an effect of theirs, and what of it noise of the
/// accelerations does not make. @param size  N m s^2  @param noise  rad/s^2
/// @param known  whether the torque's noise is known to be all there is
struct Squares {
  double all = 0, without = 0;
};
Squares squares_of(double size, double noise, bool known) {
  std::vector<MotionSource> sources = test::two_recordings({}, 1);
  for (MotionSource& source : sources) {
    source.pieces = [all = source.pieces,
                     size](const std::function<void(const StreamPiece&)>& visit) {
      all([&](StreamPiece piece) {
        piece.motion.tau.col(1) += size * second_differences(piece.motion);
        visit(piece);
      });
    };
  }
  sources = with_noise(sources, noise, 40);
  const EffectRecordings data = test::arm_recordings(sources);
  CompetitionResult result;
  result.fit = fit_effects(data, {});
  result.noise = known
                     ? test::arm_noise()
                     : torque_noise_model(data, residuals_of(data, result.fit.point), {0, 0}, true);
  EffectSignals signals(data);
  const EvidenceSystem system =
      system_beside(data, signals, {}, result, result.fit.point, result.noise, {});
  const Products products = system.products(system.whitened(columns_of(data, signals)), false);
  const PositionNoise with_more(
      [&](double sign) { return test::arm_recordings(with_noise(sources, sign * noise, 80)); });
  return {score_of(products, false).squares,
          with_more.squares_without(products, columns_of, {}, result, {})};
}

TEST(PositionNoise, IsAllOfWhatItMakes) {
  const Squares squares = squares_of(0, 0.3, false);
  EXPECT_GT(squares.all, 500);
  EXPECT_LT(squares.without, 12);
}

TEST(PositionNoise, IsLittleOfAnEffect) {
  const Squares squares = squares_of(40, 1e-3, true);
  EXPECT_GT(squares.all, 200);
  EXPECT_NEAR(squares.without, squares.all, 0.1 * squares.all);
}

TEST(PositionNoise, OfRecordingsThatHaveNoneToAddIsNone) {
  const std::vector<MotionSource> sources = test::two_recordings({}, 1);
  const DiagnosisInput input = test::arm_input(sources, {}, {});
  const Division parts{sources, {}};
  const ViewOptions options{{1, -1}, {}, false};
  EXPECT_FALSE(with_more_noise(input, parts, options, test::arm_recordings(sources), 1));
}

TEST(PositionNoise, IsAddedAndTakenAway) {
  constexpr Index kSamples = 6000;
  constexpr double kOfPositions = 1e-4;
  const Motion exact = test::sines(0.002 * kSamples, 0.002);
  Recording recording;
  recording.time = exact.time;
  recording.q = exact.q;
  recording.tau = Eigen::MatrixXd::Ones(exact.samples(), 2);
  recording.run_starts = {0};
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (double& q : recording.q.reshaped()) q += kOfPositions * normal(random);
  MotionOptions plain;
  plain.average_periods = false;
  const std::vector<MotionSource> sources = {motion_of(std::move(recording), plain)};
  const DiagnosisInput input = test::arm_input(sources, {}, {});
  const Division parts{sources, sources};
  const ViewOptions options{diagnosis_rows(sources, 0), {}, false};
  const EffectRecordings seen = views_of(input, parts, options).train;
  const auto more = with_more_noise(input, parts, options, seen, 1);
  const auto less = with_more_noise(input, parts, options, seen, -1);
  ASSERT_TRUE(more && less);
  const Motion &own = seen.runs[0].motion, &up = more->runs[0].motion, &down = less->runs[0].motion;
  EXPECT_TRUE((0.5 * (up.q + down.q)).isApprox(own.q, 1e-12));
  EXPECT_TRUE((0.5 * (up.ddq + down.ddq)).isApprox(own.ddq, 1e-9));
  // as much as there is: of what the accelerations are off
  const Index first = static_cast<Index>(std::llround((own.time[0] - exact.time[0]) / 0.002));
  const Eigen::MatrixXd off = own.ddq - exact.ddq.middleRows(first, own.samples());
  EXPECT_NEAR((0.5 * (up.ddq - down.ddq)).norm() / off.norm(), 1, 0.15);
  EXPECT_EQ(more->runs[0].rows.counted, seen.runs[0].rows.counted);
}

}  // namespace
}  // namespace dyngen::runtime

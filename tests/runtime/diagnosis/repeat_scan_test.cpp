// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/repeat_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "runtime/estimation/distributions.h"
#include "runtime/signals/decimation.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPeriodTime = 5;  // s

/// Two runs; what is left of their torque is white noise and, on joint 2, what is added.
struct RepeatCase {
  explicit RepeatCase(unsigned seed, double noise = test::kArmNoise)
      : data(test::arm_recordings(test::two_recordings({}, seed))) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (const EffectRun& run : data.runs) {
      const double dt = run.motion.sample_time * static_cast<double>(run.decimator.factor);
      repeats.push_back(kPeriodTime / dt);
      left.emplace_back(run.rows.Y.rows(), data.joints());
      for (double& e : left.back().reshaped()) e = noise * normal(random);
    }
  }

  /// A sinusoid in each run, with a phase of its own. @param harmonic  cycles a period
  void add(double harmonic, double size) {
    for (std::size_t run = 0; run < left.size(); ++run) {
      for (Index k = 0; k < left[run].rows(); ++k) {
        const double angle = 2 * M_PI * harmonic * static_cast<double>(k) / repeats[run];
        left[run](k, 1) += size * std::sin(angle + static_cast<double>(run));
      }
    }
  }

  [[nodiscard]] RepeatScan scan(int joint) const {
    const EvidenceSystem system(data, left, test::arm_noise(), {});
    return scan_repeats(data, system, joint, repeats, false);
  }
  [[nodiscard]] double p_of(int joint) const {
    const Score score = scan(joint).score;
    return variance_ratio_tail(score.delta_chi2 / score.degrees, score.degrees, 2000);
  }

  EffectRecordings data;
  RunResiduals left;
  std::vector<double> repeats;
};

TEST(RepeatScan, FindsWhatComesBackOnItsJoint) {
  RepeatCase own(1);
  own.add(3, 0.02);
  own.add(7, 0.02);  // 1.4 Hz: within the lowest band
  EXPECT_EQ(own.scan(1).frequency, 2);
  EXPECT_LT(own.p_of(1), 1e-9);
  EXPECT_GT(own.p_of(0), 1e-3);
}

TEST(RepeatScan, DoesNotTakeForThatWhatGoesOnByItself) {
  RepeatCase own(2);
  own.add(3.5, 0.04);
  EXPECT_GT(own.p_of(1), 1e-3);
}

TEST(RepeatScan, MeasuresTheNoiseBesideTheHarmonics) {
  // twice the noise that the model of noise knows: squares would be four times as many
  constexpr unsigned kSeeds = 20;
  double least = 1, mean = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const double p = RepeatCase(seed, 2 * test::kArmNoise).p_of(1);
    least = std::min(least, p);
    mean += p / kSeeds;
  }
  EXPECT_GT(least, 1e-3);
  EXPECT_NEAR(mean, 0.35, 0.2);  // the best of three bands
}

/// Sizes that are found in some equations are said of others: those of another filter.
TEST(HarmonicColumns, AreTheSameTorqueBehindEveryFilter) {
  constexpr double kHighest = 8;  // Hz
  const auto equations = [](Index decimation) {
    return effect_recordings(test::planar_arm(), test::planar_arm_tangents(),
                             test::two_recordings({}, 4), {decimation, -1}, {true, true});
  };
  const auto columns = [](const EffectRecordings& data) {
    std::vector<double> repeats;
    for (const EffectRun& run : data.runs) {
      repeats.push_back(kPeriodTime / run.motion.sample_time /
                        static_cast<double>(run.decimator.factor));
    }
    return harmonic_columns(data, 1, repeats, kHighest).parts.front();
  };
  const EffectRecordings whole = equations(1);
  const MatrixXd all = columns(whole);
  for (const Index decimation : {2, 4, 8}) {
    const EffectRecordings fewer = equations(decimation);
    const MatrixXd found = columns(fewer);
    ASSERT_EQ(found.cols(), all.cols());
    const double rate = 1 / (0.01 * static_cast<double>(decimation));
    Index start = 0, start_all = 0, column = 0;
    for (std::size_t r = 0; r < whole.runs.size(); ++r) {
      const Decimator& filter = fewer.runs[r].decimator;
      const Index rows = fewer.runs[r].rows.Y.rows();
      for (Index k = 1; k <= static_cast<Index>(kHighest * kPeriodTime); ++k) {
        const double frequency = static_cast<double>(k) / kPeriodTime;
        for (int part = 0; part < 2; ++part, ++column) {
          const VectorXd sampled =
              decimate(filter, all.col(column).segment(start_all, whole.runs[r].rows.Y.rows()));
          const VectorXd own = found.col(column).segment(start, rows);
          if (frequency <= 0.4 * rate) {
            EXPECT_LT((own - sampled).cwiseAbs().maxCoeff(), 5e-3) << decimation << " " << k;
          } else {
            EXPECT_TRUE(own.isZero()) << decimation << " " << k;
          }
        }
      }
      start += rows;
      start_all += whole.runs[r].rows.Y.rows();
    }
  }
}

TEST(RepeatScan, WhereNothingRepeatsThereIsNothing) {
  RepeatCase own(3);
  own.repeats.assign(own.repeats.size(), 0);
  const EvidenceSystem system(own.data, own.left, test::arm_noise(), {});
  EXPECT_EQ(scan_repeats(own.data, system, 1, own.repeats, true).score.degrees, 0);
}

}  // namespace
}  // namespace dyngen::runtime

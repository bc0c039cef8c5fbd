// SPDX-License-Identifier: MIT
// That a case that is drawn again is the same, and moves as it is asked to.
#include "tests/blind/cases/asked.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/blind/cases/case.h"

namespace blind {
namespace {

using Eigen::Index;
namespace fs = std::filesystem;

const std::string kArmFolder = DYNGEN_SOURCE_DIR "/tests/blind/arms";

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Asked : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              fmt::format("blind_asked_{}", testing::UnitTest::GetInstance()->random_seed() +
                                                static_cast<long>(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Rows of a motion, `rate` a second.
  fs::path write_motion(const Motion& motion, double rate, double duration) {
    const fs::path path = folder_ / "asked.csv";
    std::ofstream file(path);
    file << "time,q1,q2,qd1,qd2,qdd1,qdd2\n";
    const Index count = static_cast<Index>(std::lround(duration * rate));
    for (Index k = 0; k <= count; ++k) {
      const double t = static_cast<double>(k) / rate;
      const Wanted now = motion.at(t);
      file << fmt::format("{},{},{},{},{},{},{}\n", t, now.q[0], now.q[1], now.dq[0], now.dq[1],
                          now.ddq[0], now.ddq[1]);
    }
    return path;
  }

  fs::path folder_;
};

// Through the manifest's text, with physics of the plant, of the tree, and of the record alone.
TEST_F(Asked, CaseIsTheSameByteForByte) {
  for (const char* const family : {"load_friction", "geometry_error", "kinematic_ripple", ""}) {
    CaseOptions options;
    options.kind = "single";
    options.family = family;
    options.arm = "planar2";
    options.lambda = 80;
    std::optional<Case> made;
    for (options.seed = 5; !made && options.seed < 15;) {
      made = make_case(options, kArmFolder);
      if (!made) ++options.seed;
    }
    ASSERT_TRUE(made) << family;
    write_case(*made, kArmFolder, folder_ / "case");
    const auto entry = nlohmann::json::parse(manifest_entry(*made).dump(1));
    const Redrawn redrawn = redraw(entry, kArmFolder);
    const fs::path again = folder_ / "again.csv";
    write_recording(record_again(redrawn, 0), {}, false, again);
    const std::string first = bytes_of(folder_ / "case" / "train1.csv");
    ASSERT_GT(first.size(), 10000U);
    EXPECT_EQ(bytes_of(again), first) << family;
    write_recording(record_again(redrawn, 3), {}, false, again);
    EXPECT_EQ(bytes_of(again), bytes_of(folder_ / "case" / "held1.csv")) << family;
    EXPECT_NE(bytes_of(again), first);
  }
}

TEST_F(Asked, EntryOfAnotherCaseIsRefused) {
  CaseOptions options;
  options.kind = "single";
  options.arm = "planar2";
  options.family = "load_friction";
  options.seed = 5;
  const auto drawn = draw_case(options, kArmFolder);
  ASSERT_TRUE(drawn);
  nlohmann::json entry = {{"case", "c"},
                          {"kind", "single"},
                          {"wanted_lambda", 80},
                          {"wanted_family", "load_friction"},
                          {"seed", 5},
                          {"arm", "planar2"},
                          {"rate", drawn->rate},
                          {"noise", "white"},
                          {"truths",
                           {{{"family", "load_friction"},
                             {"form", drawn->truths.front().form},
                             {"joint", drawn->truths.front().joint},
                             {"size", 0.05}}}}};
  EXPECT_NO_THROW(redraw(entry, kArmFolder));
  entry["truths"][0]["family"] = "cable";
  EXPECT_THROW(redraw(entry, kArmFolder), std::runtime_error);
}

TEST_F(Asked, MotionIsFollowedWithNoiseOfItsOwn) {
  CaseOptions options;
  options.kind = "null";
  options.arm = "planar2";
  options.seed = 7;
  const auto drawn = draw_case(options, kArmFolder);
  ASSERT_TRUE(drawn);
  const Redrawn redrawn{*drawn, {}, noise_deviation(*drawn)};
  const Motion wanted = fourier_motion(drawn->arm, 4, Random(99));
  const Motion read = read_motion(write_motion(wanted, 100, 8), 2);
  EXPECT_TRUE(read.repeats);
  EXPECT_NEAR(read.duration, 8, 1e-9);
  for (const double t : {-1.2345, 0.0, 0.0037, 3.996, 7.9991}) {
    EXPECT_LT((read.at(t).q - wanted.at(t).q).norm(), 1e-6) << t;
    EXPECT_LT((read.at(t).dq - wanted.at(t).dq).norm(), 1e-4) << t;
    EXPECT_LT((read.at(t).ddq - wanted.at(t).ddq).norm(), 1e-2) << t;
  }
  const Recording recording = record_along(redrawn, read);
  ASSERT_EQ(recording.log.q.rows(), std::lround(8 * drawn->rate));
  double worst = 0;
  for (Index k = 0; k < recording.log.q.rows(); ++k) {
    const Wanted now = wanted.at(static_cast<double>(k) / drawn->rate);
    worst = std::max(worst, (recording.log.q.row(k).transpose() - now.q).norm());
  }
  EXPECT_LT(worst, 0.2);  // the controller's error, not another motion
  const Recording first = record_again(redrawn, 0);
  const Index common = std::min(first.log.q.rows(), recording.log.q.rows());
  EXPECT_GT((first.torque_noise.topRows(common) - recording.torque_noise.topRows(common)).norm(),
            0.5 * first.torque_noise.topRows(common).norm());
  const Recording twice = record_along(redrawn, read);
  EXPECT_EQ(twice.torque_noise, recording.torque_noise);
  EXPECT_EQ(twice.log.recorded, recording.log.recorded);
}

TEST_F(Asked, MotionThatCannotBeIsRefused) {
  const fs::path path = folder_ / "bad.csv";
  const auto message = [&](const std::string& text) {
    std::ofstream(path) << "time,q1,qd1,qdd1\n" << text;
    try {
      read_motion(path, 1);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("0,0,0,0\n0.1,x,0,0\n"), testing::HasSubstr("bad.csv:3: expected 4 numbers"));
  EXPECT_THAT(message("0,0,0\n"), testing::HasSubstr(":2: expected 4"));
  EXPECT_THAT(message("0,0,0,0\n"), testing::HasSubstr("fewer than 3 rows"));
  EXPECT_THAT(message("0,0,0,0\n0.1,0,0,0\n0.3,0,0,0\n"), testing::HasSubstr("equally far apart"));
  EXPECT_THAT(message("0,0,1,0\n0.1,0.1,1,0\n0.2,0.2,1,0\n"), testing::HasSubstr("begins at rest"));
  EXPECT_EQ(message("0,0,0,0\n0.1,0,0,1\n0.2,0.005,0.1,1\n0.3,0.02,0.2,1\n"), "");
  EXPECT_FALSE(read_motion(path, 1).repeats);
  EXPECT_EQ(read_motion(path, 1).at(-1).q[0], 0);
}

}  // namespace
}  // namespace blind

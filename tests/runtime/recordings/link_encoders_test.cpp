// SPDX-License-Identifier: MIT
// Columns ql1 .. qln: positions behind the gears of some or all joints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/writer.h"
#include "tests/runtime/recordings/recording_texts.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test {
namespace {

using runtime::Recording;
using runtime::RecordingError;

using Link = std::function<double(double q, int sample)>;

/// Two joints that swing; ql2 is made of q2.
std::string swinging(const std::string& names, const Link& link) {
  std::string text = "time,q1,q2,tau1,tau2," + names + "\n";
  for (int k = 0; k < 400; ++k) {
    const double t = 0.004 * k, q1 = 0.5 * std::sin(3 * t), q2 = 1.1 * std::sin(2 * t + 0.3);
    text += fmt::format("{:.4f},{:.9f},{:.9f},{:.6f},{:.6f},{:.9f}\n", t, q1, q2, 5 * std::cos(t),
                        3 * std::sin(t), link(q2, k));
  }
  return text;
}

struct Read {
  Recording recording;
  std::vector<std::string> notices;
  std::string error;
};

Read read(const std::string& text, const std::string& name = "two.csv") {
  const std::string path = temporary_path(name);
  std::ofstream(path) << text;
  Read result;
  std::vector<runtime::Notice> notices;
  try {
    result.recording = runtime::read_recording(path, {}, &notices);
  } catch (const RecordingError& error) {
    result.error = error.what();
    const std::size_t at = result.error.find(name);
    if (at != std::string::npos) result.error = result.error.substr(at);
  }
  for (const runtime::Notice& notice : notices) result.notices.push_back(notice.message);
  return result;
}

double twisted(double q, int /*sample*/) { return q - 1e-3; }

TEST(LinkEncoders, SomeJointsAloneMayHaveThem) {
  const Read two = read(swinging("ql2", twisted));
  ASSERT_EQ(two.error, "");
  ASSERT_EQ(two.recording.q_link.cols(), 2);
  EXPECT_FALSE(two.recording.has_link(0));
  ASSERT_TRUE(two.recording.has_link(1));
  EXPECT_TRUE(two.recording.q_link.col(0).array().isNaN().all());
  const Eigen::VectorXd twist = two.recording.q.col(1) - two.recording.q_link.col(1);
  EXPECT_LT((twist.array() - 1e-3).abs().maxCoeff(), 1e-8);
  EXPECT_TRUE(two.notices.empty()) << two.notices.front();
  EXPECT_EQ(two.recording.link_places.at(1), (std::pair<std::size_t, std::size_t>{1, 22}));
}

TEST(LinkEncoders, OtherSpellingsAndUnitsAreRead) {
  const auto degrees = [](double q, int) { return (q - 1e-3) * 180 / std::numbers::pi; };
  const Read two = read(swinging("q_link2 [deg]", degrees));
  ASSERT_EQ(two.error, "");
  ASSERT_TRUE(two.recording.has_link(1));
  EXPECT_NEAR(two.recording.q(7, 1) - two.recording.q_link(7, 1), 1e-3, 1e-8);
}

TEST(LinkEncoders, AreWrittenOfTheJointsThatHaveThem) {
  const Read two = read(swinging("ql2", twisted));
  const std::string path = temporary_path("written.csv");
  runtime::write_recording(two.recording, path);
  std::ifstream file(path);
  std::string header;
  std::getline(file, header);
  EXPECT_EQ(header, "time,q1,q2,tau1,tau2,ql2");
  const Recording again = runtime::read_recording(path);
  EXPECT_EQ(again.q_link.col(1), two.recording.q_link.col(1));
}

TEST(LinkEncoders, AreReadAlikeInChunks) {
  const std::string text = swinging("ql2", twisted);
  const Recording whole = read_text(text).recording;
  auto reader = runtime::RecordingReader::from_text(text, "two.csv");
  Eigen::Index rows = 0;
  for (Recording chunk; reader.next(chunk, 17); rows += chunk.samples()) {
    ASSERT_EQ(chunk.q_link.cols(), 2);
    EXPECT_EQ(chunk.q_link.col(1), whole.q_link.col(1).segment(rows, chunk.samples()));
    EXPECT_TRUE(chunk.q_link.col(0).array().isNaN().all());
  }
  EXPECT_EQ(rows, whole.samples());
}

TEST(LinkEncoders, AreUnwrappedAndFreedOfOutliersAsPositionsAre) {
  const auto wrapped = [](double q, int k) {
    if (k == 200) return 9.0;
    return q > 0.9 ? q - 2 * std::numbers::pi : q;
  };
  const Read two = read(swinging("ql2", wrapped));
  ASSERT_EQ(two.error, "");
  ASSERT_EQ(two.notices.size(), 2U);
  EXPECT_NE(two.notices[0].find("ql2 jumps by a whole turn"), std::string::npos) << two.notices[0];
  EXPECT_EQ(two.notices[1].rfind("ql2 is ", 0), 0U) << two.notices[1];
  EXPECT_NE(two.notices[1].find("interpolated"), std::string::npos) << two.notices[1];
  EXPECT_LT((two.recording.q.col(1) - two.recording.q_link.col(1)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(LinkEncoders, WholeTurnsApartAreTakenOff) {
  const auto turned = [](double q, int) { return q + 4 * std::numbers::pi - 1e-3; };
  const Read two = read(swinging("ql2", turned));
  ASSERT_EQ(two.error, "");
  ASSERT_EQ(two.notices.size(), 1U);
  EXPECT_EQ(two.notices[0], "ql2 is 2 whole turns away from q2; taken off");
  EXPECT_NEAR(two.recording.q(3, 1) - two.recording.q_link(3, 1), 1e-3, 1e-7);
}

TEST(LinkEncoders, AConstantOfAMovingJointIsNone) {
  const Read two = read(swinging("ql2", [](double, int) { return 0.0; }));
  ASSERT_EQ(two.error, "");
  EXPECT_EQ(two.recording.q_link.size(), 0);
  ASSERT_EQ(two.notices.size(), 1U);
  EXPECT_EQ(two.notices[0],
            "ql2 is 0 throughout while q2 moves: the joint has no second encoder; left out");
}

TEST(LinkEncoders, WrongOnesAreRefusedAtTheirName) {
  struct Case {
    const char* claim;
    Link link;
    const char* words;
  };
  const double degrees = 180 / std::numbers::pi;
  const std::vector<Case> cases = {
      {"another sign", [](double q, int) { return -q; },
       "found ql2 that runs against q2 (it moves by -1 of it), expected the same sign: turn one of "
       "them, by 'sign: -1' in a map"},
      {"degrees", [=](double q, int) { return degrees * q; },
       "its values look like degrees beside q2: name the unit, 'ql2 [deg]'"},
      {"turns of the motor", [](double q, int) { return q / 101; },
       "their gear ratios are apart by a factor of 101"},
      {"another zero", [](double q, int) { return q + 0.35; },
       "found ql2 with a zero -0.35 away from that of q2, expected at most 0.1"},
      {"another joint", [](double, int k) { return 0.5 * std::sin(0.05 * k); },
       "found ql2 that does not follow q2"},
  };
  for (const Case& one : cases) {
    const Read two = read(swinging("ql2", one.link));
    EXPECT_EQ(two.error.rfind("two.csv:1:22: error: found ql2", 0), 0U)
        << one.claim << ": " << two.error;
    EXPECT_NE(two.error.find(one.words), std::string::npos) << one.claim << ": " << two.error;
  }
}

TEST(LinkEncoders, MoreThanThereAreJointsAreRefused) {
  EXPECT_EQ(read(swinging("ql3", twisted)).error,
            "two.csv:1:22: error: found column 'ql3', expected ql1 to ql2 for 2 joints");
}

}  // namespace
}  // namespace dyngen::test

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/signals/joint_state.h"
#include "tests/runtime/signals/test_motion.h"

namespace dyngen::runtime {
namespace {

constexpr double kStreamStep = 1e-3;

/// The runs that pieces make.
std::vector<Motion> joined(const std::vector<StreamPiece>& pieces) {
  std::vector<Motion> runs;
  const auto append = [](Eigen::MatrixXd& all, const Eigen::MatrixXd& more) {
    const Eigen::Index rows = all.rows();
    all.conservativeResize(rows + more.rows(), more.cols());
    all.bottomRows(more.rows()) = more;
  };
  for (const auto& [motion, continues_run] : pieces) {
    if (!continues_run) {
      runs.push_back(motion);
      continue;
    }
    Motion& run = runs.back();
    const Eigen::Index rows = run.time.size();
    run.time.conservativeResize(rows + motion.time.size());
    run.time.tail(motion.time.size()) = motion.time;
    append(run.q, motion.q);
    append(run.dq, motion.dq);
    append(run.ddq, motion.ddq);
    append(run.tau, motion.tau);
  }
  return runs;
}

void expect_same(const std::vector<Motion>& got, const std::vector<Motion>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t r = 0; r < got.size(); ++r) {
    ASSERT_EQ(got[r].samples(), expected[r].samples()) << r;
    EXPECT_EQ(got[r].time, expected[r].time) << r;
    EXPECT_EQ(got[r].tau, expected[r].tau) << r;
    EXPECT_LT((got[r].q - expected[r].q).norm(), 1e-9 * expected[r].q.norm()) << r;
    EXPECT_LT((got[r].dq - expected[r].dq).norm(), 1e-9 * expected[r].dq.norm()) << r;
    EXPECT_LT((got[r].ddq - expected[r].ddq).norm(), 1e-9 * expected[r].ddq.norm()) << r;
  }
}

JointStateOptions options_of(int order, double trim) {
  JointStateOptions options;
  options.order = order;
  options.cutoff_hz = 30;
  options.trim = trim;
  return options;
}

TEST(JointStateStream, PiecesOfAnyChunksAreTheWholeInMemory) {
  Recording recording = test_recording(test_motion(9001, kStreamStep, 2), 1e-5);
  for (const int order : {1, 4, 5}) {
    for (const double trim : {-1.0, 0.0, 0.9}) {
      const JointStateOptions options = options_of(order, trim);
      const JointStates whole = joint_states(recording, options);
      for (const Eigen::Index size : {1, 7, 501, 4000, 9000, 20000}) {
        JointStateStream stream(options, kStreamStep);
        std::vector<StreamPiece> pieces;
        for (Eigen::Index from = 0; from < recording.samples(); from += size) {
          const Eigen::Index count = std::min(size, recording.samples() - from);
          for (auto& piece : stream.push(rows_of(recording, from, count), from > 0)) {
            pieces.push_back(std::move(piece));
          }
        }
        if (size < 1000 && trim < 0.5) {
          EXPECT_GT(pieces.size(), 3U);
        }
        for (auto& piece : stream.finish()) pieces.push_back(std::move(piece));
        SCOPED_TRACE(testing::Message() << order << " " << trim << " " << size);
        expect_same(joined(pieces), whole.runs);
      }
    }
  }
}

TEST(JointStateStream, KeepsRunsApartWhereverChunksEnd) {
  // Runs that are long, as short as their reflection or shorter, and too short.
  Recording recording = test_recording(test_motion(6000, kStreamStep, 2), 1e-5);
  const JointStateOptions options = options_of(4, 0.05);
  const Eigen::Index padding =
      end_treatment(design_butterworth(options.order, options.cutoff_hz, kStreamStep)).padding;
  recording.run_starts = {
      0, 2000, 2000 + padding, 2000 + 2 * padding + 1, 2000 + 3 * padding + 3, 4500, 4550, 4700};
  for (std::size_t r = 1; r < recording.run_starts.size(); ++r) {
    const Eigen::Index rest = recording.samples() - recording.run_starts[r];
    recording.time.tail(rest).array() += 1;
    recording.q.bottomRows(rest).array() += 0.5;
  }
  const JointStates whole = joint_states(recording, options);
  ASSERT_EQ(whole.runs.size(), 7U);
  for (const Eigen::Index size : {13, 997, 3001, 6000}) {
    JointStateStream stream(options, kStreamStep);
    std::vector<StreamPiece> pieces;
    for (Eigen::Index from = 0; from < recording.samples(); from += size) {
      const Eigen::Index count = std::min(size, recording.samples() - from);
      Recording chunk = rows_of(recording, from, count);
      bool continues_run = true;
      for (const Eigen::Index start : recording.run_starts) {
        if (start == from) continues_run = false;
        if (start > from && start < from + count) chunk.run_starts.push_back(start - from);
      }
      for (auto& piece : stream.push(chunk, continues_run)) pieces.push_back(std::move(piece));
    }
    for (auto& piece : stream.finish()) pieces.push_back(std::move(piece));
    SCOPED_TRACE(size);
    expect_same(joined(pieces), whole.runs);
    EXPECT_EQ(stream.messages().size(), 1U);
  }
}

TEST(JointStateStream, PiecesComeWhileTheRunGoesOnAndNoneGrows) {
  const Recording chunk = test_recording(test_motion(500, kStreamStep, 1), 1e-5);
  JointStateStream stream(options_of(4, -1), kStreamStep);
  Eigen::Index in = 0, out = 0, largest = 0;
  for (int push = 0; push < 200; ++push) {
    Recording next = chunk;
    next.time.array() += 500 * kStreamStep * push;
    in += next.samples();
    for (const auto& piece : stream.push(next, push > 0)) {
      out += piece.motion.samples();
      largest = std::max(largest, piece.motion.samples());
    }
    EXPECT_LT(in - out, 3000);
  }
  EXPECT_LT(largest, 2000);
}

TEST(JointStateStream, IsRefusedWhatItCannotDo) {
  EXPECT_THROW(JointStateStream({}, kStreamStep), std::invalid_argument);  // no cut-off
  JointStateOptions kalman = options_of(4, 0);
  kalman.method = StateMethod::kKalmanSmoother;
  EXPECT_THROW(JointStateStream(kalman, kStreamStep), std::invalid_argument);
  JointStateStream stream(options_of(4, 0), kStreamStep);
  const Recording recording = test_recording(test_motion(100, kStreamStep, 2), 0);
  stream.push(recording, false);
  EXPECT_THROW(stream.push(recording, true), std::invalid_argument);  // time goes back
  Recording other = test_recording(test_motion(100, kStreamStep, 3), 0);
  other.time.array() += 100 * kStreamStep;
  EXPECT_THROW(stream.push(other, true), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime

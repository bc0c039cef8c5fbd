// SPDX-License-Identifier: MIT
#include "runtime/identification/stretches.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "runtime/recordings/time_base.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRowsOfPass = 20000;  // read at once
constexpr Index kParts = 6;           // of a joint's torque
constexpr Index kSlopeSamples = 10;   // on either side: noise of positions counts less in slopes
constexpr double kFullRate = 1e-3;    // s: worth_of_row()
constexpr double kMostWorth = 4;

using PartMatrix = Eigen::Matrix<double, kParts, kParts>;

/// What a stretch says of each joint.
struct StretchInformation {
  double first = 0, last = 0;  ///< s
  Index rows = 0;
  std::vector<PartMatrix> joints;
};

/// Splits a recording into stretches, the same in each pass: a new one begins with a run, and when
/// the last one is long enough.
class StretchClock {
 public:
  explicit StretchClock(double seconds) : seconds_(seconds) {}

  /// @return number of the stretch of a row, from 0
  std::size_t of_row(double time, bool starts_run) {
    if (!begun_ || starts_run || time - start_ >= seconds_) {
      number_ += begun_ ? 1 : 0;
      start_ = time;
      begun_ = true;
    }
    return number_;
  }

 private:
  double seconds_;
  bool begun_ = false;
  std::size_t number_ = 0;
  double start_ = 0;
};

/// Calls for each row of a recording: chunk, row, its stretch, whether it starts a run.
template <typename Visit>
void go_through(RecordingReader& reader, double seconds, const Visit& visit) {
  StretchClock clock(seconds);
  bool any = false;
  for (Recording chunk; reader.next(chunk, kRowsOfPass);) {
    std::size_t run = 0;
    for (Index k = 0; k < chunk.samples(); ++k) {
      bool starts = false;
      if (run < chunk.run_starts.size() && chunk.run_starts[run] == k) {
        starts = !any || k > 0 || !reader.continues_run();
        ++run;
      }
      any = true;
      visit(chunk, k, clock.of_row(chunk.time[k], starts), starts);
    }
  }
}

/// The first pass.
std::vector<StretchInformation> information_of(RecordingReader& reader, double seconds) {
  std::vector<StretchInformation> all;
  // rows near by, for slopes: a ring of times and positions
  constexpr Index kRing = 2 * kSlopeSamples + 1;
  MatrixXd ring;
  VectorXd times(kRing);
  Index held = 0;
  go_through(
      reader, seconds, [&](const Recording& chunk, Index k, std::size_t stretch, bool starts) {
        if (ring.size() == 0) ring.resize(kRing, chunk.joints());
        if (starts) held = 0;
        if (stretch >= all.size()) {
          all.push_back({chunk.time[k], chunk.time[k], 0,
                         std::vector<PartMatrix>(static_cast<std::size_t>(chunk.joints()),
                                                 PartMatrix::Zero())});
        }
        StretchInformation& own = all.back();
        own.last = chunk.time[k];
        ++own.rows;
        ring.row(held % kRing) = chunk.q.row(k);
        times[held % kRing] = chunk.time[k];
        ++held;
        if (held < kRing) return;
        const Index first = held % kRing, middle = (held + kSlopeSamples) % kRing;
        const Index last = (held - 1) % kRing;
        const double before = times[middle] - times[first], after = times[last] - times[middle];
        if (!(before > 0 && after > 0)) return;
        for (Index j = 0; j < chunk.joints(); ++j) {
          const double q = ring(middle, j);
          const double left = (q - ring(first, j)) / before, right = (ring(last, j) - q) / after;
          const double dq = (left + right) / 2, ddq = 2 * (right - left) / (before + after);
          Eigen::Matrix<double, kParts, 1> x;
          x << ddq, dq, dq > 0 ? 1.0 : dq < 0 ? -1.0 : 0.0, std::sin(q), std::cos(q), 1.0;
          own.joints[static_cast<std::size_t>(j)] += x * x.transpose();
        }
      });
  return all;
}

/// Each part divided by its rms over all stretches.
void normalise(std::vector<StretchInformation>& all) {
  if (all.empty()) return;
  for (std::size_t j = 0; j < all.front().joints.size(); ++j) {
    PartMatrix sum = PartMatrix::Zero();
    double rows = 0;
    for (const StretchInformation& one : all) {
      sum += one.joints[j];
      rows += static_cast<double>(one.rows);
    }
    Eigen::Matrix<double, kParts, 1> scale;
    for (Index i = 0; i < kParts; ++i) {
      scale[i] = sum(i, i) > 0 ? std::sqrt(rows / sum(i, i)) : 0;
    }
    for (StretchInformation& one : all) {
      one.joints[j] = (scale.asDiagonal() * one.joints[j] * scale.asDiagonal()).eval();
    }
  }
}

double log_determinant(const PartMatrix& matrix) {
  const Eigen::LLT<PartMatrix> factor(matrix + PartMatrix::Identity());
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

/// The part of the time in which each stretch has its middle.
std::vector<std::size_t> parts_of_time(const std::vector<StretchInformation>& all, int parts) {
  std::vector<std::size_t> part(all.size(), 0);
  if (all.empty()) return part;
  const double first = all.front().first, length = all.back().last - first;
  for (std::size_t s = 0; s < all.size() && length > 0; ++s) {
    const double share = ((all[s].first + all[s].last) / 2 - first) / length;
    part[s] = static_cast<std::size_t>(std::clamp(share * parts, 0.0, parts - 1.0));
  }
  return part;
}

/// Numbers of the stretches that are taken, ascending.
std::vector<std::size_t> chosen(const std::vector<StretchInformation>& all, Index most_rows,
                                int parts) {
  const std::vector<std::size_t> part = parts_of_time(all, parts);
  std::vector<int> given(static_cast<std::size_t>(parts), 0);
  std::vector<std::size_t> taken;
  std::vector<bool> used(all.size(), false);
  std::vector<PartMatrix> sum(all.empty() ? 0 : all.front().joints.size(), PartMatrix::Zero());
  Index rows = 0;
  for (;;) {
    std::size_t best = all.size();
    double most = -std::numeric_limits<double>::infinity();
    const auto open = [&](std::size_t s) { return !used[s] && rows + all[s].rows <= most_rows; };
    int fewest = std::numeric_limits<int>::max();
    for (std::size_t s = 0; s < all.size(); ++s) {
      if (open(s)) fewest = std::min(fewest, given[part[s]]);
    }
    for (std::size_t s = 0; s < all.size(); ++s) {
      if (!open(s) || given[part[s]] > fewest) continue;
      double value = 0;
      for (std::size_t j = 0; j < sum.size(); ++j)
        value += log_determinant(sum[j] + all[s].joints[j]);
      if (value > most) {
        most = value;
        best = s;
      }
    }
    if (best == all.size()) break;
    used[best] = true;
    ++given[part[best]];
    rows += all[best].rows;
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += all[best].joints[j];
    taken.push_back(best);
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

std::string sentence_of(const Stretches& stretches) {
  constexpr std::size_t kMostNamed = 8;
  std::string list;
  double used = 0;
  for (std::size_t i = 0; i < stretches.times.size(); ++i) {
    const auto& [from, to] = stretches.times[i];
    used += to - from;
    if (i < kMostNamed) {
      list += fmt::format("{}{:.6g} to {:.6g}", i == 0 ? "" : ", ", from, to);
    }
  }
  if (stretches.times.size() > kMostNamed) {
    list += fmt::format(" and {} more, which --json names", stretches.times.size() - kMostNamed);
  }
  return fmt::format(
      "long recording: of {:.6g} s, {} stretch{} with {:.6g} s in all {} used, spread over it (s "
      "since its start): {}",
      stretches.seconds_in_all, stretches.times.size(), stretches.times.size() == 1 ? "" : "es",
      used, stretches.times.size() == 1 ? "is" : "are", list);
}

}  // namespace

double worth_of_row(double sample_time) {
  return std::clamp(sample_time / kFullRate, 1.0, kMostWorth);
}

double numbers_of_rows(Index rows, int joints, double sample_time) {
  return static_cast<double>(rows) * (2 * joints + 1) * worth_of_row(sample_time);
}

Stretches telling_stretches(const RecordingInput& input, const ReadOptions& reading,
                            const StretchOptions& options, std::vector<Notice>* notices) {
  Stretches result;
  RecordingReader first = input.open(reading);
  std::vector<StretchInformation> all = information_of(first, options.seconds);
  normalise(all);
  for (const StretchInformation& one : all) result.seconds_in_all += one.last - one.first;
  Index rows = 0;
  for (const StretchInformation& one : all) rows += one.rows;
  if (!all.empty()) result.start = all.front().first;
  const double sample_time = result.seconds_in_all / static_cast<double>(std::max<Index>(1, rows));
  const double of_row = numbers_of_rows(1, first.joints(), sample_time);
  const std::vector<std::size_t> taken =
      chosen(all, static_cast<Index>(options.most_numbers / of_row), options.parts);

  rows = 0;
  for (const std::size_t s : taken) rows += all[s].rows;
  Recording& out = result.recording;
  RecordingReader again = input.open(reading);
  Index row = 0;
  std::size_t next = 0, last_taken = all.size();
  go_through(again, options.seconds,
             [&](const Recording& chunk, Index k, std::size_t stretch, bool starts) {
               while (next < taken.size() && taken[next] < stretch) ++next;
               if (next >= taken.size() || taken[next] != stretch) return;
               if (row == 0) {
                 out.file_name = chunk.file_name;
                 out.place_word = chunk.place_word;
                 out.time.resize(rows);
                 for (const auto part : kRecordingParts) {
                   const Index columns = (chunk.*part).cols();
                   (out.*part).resize(columns > 0 ? rows : 0, columns);
                 }
               }
               if (stretch != last_taken) {
                 const bool follows = row > 0 && stretch == last_taken + 1 && !starts;
                 if (!follows) {
                   out.run_starts.push_back(row);
                   const double since = chunk.time[k] - result.start;
                   result.times.emplace_back(since, since);
                 }
                 last_taken = stretch;
               }
               result.times.back().second = chunk.time[k] - result.start;
               out.time[row] = chunk.time[k];
               for (const auto part : kRecordingParts) {
                 if ((chunk.*part).cols() > 0) (out.*part).row(row) = (chunk.*part).row(k);
               }
               if (!chunk.lines.empty())
                 out.lines.push_back(chunk.lines[static_cast<std::size_t>(k)]);
               ++row;
             });
  if (notices != nullptr) {
    notices->insert(notices->end(), again.notices().begin(), again.notices().end());
  }
  result.sentence = sentence_of(result);
  return result;
}

}  // namespace dyngen::runtime

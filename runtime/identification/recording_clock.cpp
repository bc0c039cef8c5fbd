// SPDX-License-Identifier: MIT
#include "runtime/identification/recording_clock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace dyngen::runtime {
namespace {

/// s: time stamp of the last sample that is used.
double end_of(const MotionSource& source) {
  double end = source.start;
  source.pieces([&](const StreamPiece& piece) {
    const Eigen::Index samples = piece.motion.samples();
    if (samples > 0) end = std::max(end, piece.motion.time[samples - 1]);
  });
  return end;
}

}  // namespace

ClockedRecordings on_one_clock(std::vector<MotionSource> sources, double longest_pause) {
  std::vector<std::size_t> order(sources.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sources[a].start < sources[b].start;
  });
  ClockedRecordings clocked;
  std::vector<std::string> sentences, names;
  std::string first;
  double origin = 0, end = 0;
  const auto close = [&] {
    if (names.empty()) return;
    sentences.push_back(fmt::format("{} continue{} {}: time counts from the start of {}",
                                    fmt::join(names, ", "), names.size() == 1 ? "s" : "", first,
                                    first));
    names.clear();
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    MotionSource& source = sources[order[i]];
    const double own_start = source.start, own_end = end_of(source);
    if (i > 0 && own_start >= end && own_start - end <= longest_pause) {
      names.push_back(source.name);
      source = made_of(source, [origin](const MotionSource& state) {
        MotionSource moved = state;
        moved.start = origin;
        return moved;
      });
    } else {
      close();
      first = source.name;
      origin = own_start;
    }
    end = own_end;
  }
  close();
  clocked.sources = std::move(sources);
  clocked.sentence = fmt::format("{}", fmt::join(sentences, "; "));
  return clocked;
}

}  // namespace dyngen::runtime

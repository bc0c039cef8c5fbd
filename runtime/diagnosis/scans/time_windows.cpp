// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/scans/time_windows.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBlocks = 120;  // of the longest recording
constexpr int kWindowSurrogates = 16;

/// Time of each equation, s from the recording's first sample, and its recording.
struct EquationPlaces {
  VectorXd times;
  std::vector<int> recordings;
  int count = 0;  // of recordings
};

EquationPlaces places_of(const EffectRecordings& data) {
  EquationPlaces places{VectorXd(data.equations()), {}, 0};
  Index start = 0;
  for (const EffectRun& run : data.runs) {
    const Index first = first_sample(run.decimator);
    for (Index k = 0; k < run.rows.Y.rows(); ++k) {
      places.times[start + k] = run.time[first + k * run.decimator.factor];
      places.recordings.push_back(run.recording);
    }
    start += run.rows.Y.rows();
    places.count = std::max(places.count, run.recording + 1);
  }
  return places;
}

/// Sums of products over blocks of time; of blocks 0 .. b - 1 at place b.
struct Running {
  std::vector<MatrixXd> whole, inner, noise;
  std::vector<VectorXd> rest;
};

Products between(const Running& sums, std::size_t from, std::size_t to) {
  Products products;
  products.whole = sums.whole[to] - sums.whole[from];
  products.rest = sums.rest[to] - sums.rest[from];
  products.noise = sums.noise[to] - sums.noise[from];
  const MatrixXd inner = sums.inner[to] - sums.inner[from];
  products.left = products.whole - inner.transpose() * inner;
  return products;
}

/// Products of a hypothesis that acts all the time, summed over blocks of time.
class BlockSums {
 public:
  BlockSums(const EvidenceSystem& system, const JointColumns& columns, bool surrogates)
      : system_(system),
        columns_(columns),
        surrogates_(surrogates ? std::min(kWindowSurrogates, system.surrogates()) : 0) {}

  /// @param rows  of each block, ascending
  [[nodiscard]] Running over(const std::vector<std::vector<Index>>& rows) const {
    const Index k = columns_.columns();
    Running sums;
    sums.whole.push_back(MatrixXd::Zero(k, k));
    sums.rest.push_back(VectorXd::Zero(k));
    sums.noise.push_back(MatrixXd::Zero(k, surrogates_));
    sums.inner.push_back(MatrixXd::Zero(system_.rank(), k));
    for (const std::vector<Index>& here : rows) {
      MatrixXd whole = sums.whole.back(), noise = sums.noise.back(), inner = sums.inner.back();
      VectorXd rest = sums.rest.back();
      for (std::size_t first = 0; first < here.size();) {
        std::size_t last = first + 1;
        while (last < here.size() && here[last] == here[last - 1] + 1) ++last;
        const Index from = here[first], to = here[last - 1] + 1;
        const Products part = system_.products(columns_, from, to, surrogates_ > 0);
        whole += part.whole;
        rest += part.rest;
        noise += part.noise.leftCols(noise.cols());
        inner += system_.absorbed(columns_, from, to);
        first = last;
      }
      sums.whole.push_back(std::move(whole));
      sums.rest.push_back(std::move(rest));
      sums.noise.push_back(std::move(noise));
      sums.inner.push_back(std::move(inner));
    }
    return sums;
  }

 private:
  const EvidenceSystem& system_;
  const JointColumns& columns_;
  int surrogates_;
};

/// Sums over several parts of the equations are the parts' sums together.
Running together(const std::vector<Running>& parts) {
  Running sums = parts.front();
  for (std::size_t p = 1; p < parts.size(); ++p) {
    for (std::size_t b = 0; b < sums.rest.size(); ++b) {
      sums.whole[b] += parts[p].whole[b];
      sums.rest[b] += parts[p].rest[b];
      sums.noise[b] += parts[p].noise[b];
      sums.inner[b] += parts[p].inner[b];
    }
  }
  return sums;
}

/// Some consecutive blocks of one recording, or of all.
struct Window {
  const Running& sums;
  std::size_t from = 0, to = 0;
  [[nodiscard]] Products products() const { return between(sums, from, to); }
  [[nodiscard]] MatrixXd inner() const { return sums.inner[to] - sums.inner[from]; }
};

/// The products of a window beside another one, which it does not overlap: what the model made of
/// the one is not in the other then.
Products beside(const Window& window, const Window& other) {
  Products products = window.products();
  const Products taken = other.products();
  const MatrixXd common = -window.inner().transpose() * other.inner();
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> left(taken.left);
  products.rest -= common * left.solve(taken.rest);
  products.left -= common * left.solve(common.transpose());
  return products;
}

/// Mean chi-square reduction per degree of freedom in adjacent windows as long as the best one, of
/// all recordings, without those that overlap it; 1 where white noise may have as much.
/// @param recording  the best one's place, -1: all
double squares_elsewhere(const std::vector<Running>& recordings, int recording, const Window& best,
                         const ScanRules& rules) {
  const std::size_t length = best.to - best.from;
  double squares = 0, degrees = 0;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const bool own = recording < 0 || recording == static_cast<int>(r);
    // before the best window up to it, behind it on from it, so that none is lost to an overlap
    for (std::size_t at = own ? best.from % length : 0; at + length <= kBlocks; at += length) {
      if (own && at < best.to && best.from < at + length) continue;
      const Score score = score_of(beside({recordings[r], at, at + length}, best), false);
      squares += score.delta_chi2;
      degrees += score.degrees;
    }
  }
  if (degrees < 1) return 1;
  const double by_chance = 1 + rules.window_deviations * std::sqrt(2 / degrees);  // of white noise
  return squares / degrees < by_chance ? 1 : squares / degrees;
}

}  // namespace

WindowScan scan_windows(const EffectRecordings& data, EffectSignals& signals,
                        const EvidenceSystem& system, const Hypothesis& hypothesis,
                        bool surrogates) {
  WindowScan scan;
  std::size_t best_from = 0, best_to = 0;
  const EquationPlaces places = places_of(data);
  const double longest = places.times.maxCoeff();
  const bool ends = hypothesis.shapes.size() > 1;
  VectorXd always(static_cast<Index>(hypothesis.shapes.size()));
  always[0] = -1;
  if (ends) always[1] = 2 * longest + 1;
  const JointColumns columns =
      hypothesis_columns(data, signals, system, hypothesis, with_shapes(hypothesis, always));
  const double step = longest / kBlocks, longest_push = system.rules().longest_push;
  // rows of a recording are consecutive, so that each block is a few ranges
  std::vector<std::vector<std::vector<Index>>> rows(static_cast<std::size_t>(places.count),
                                                    std::vector<std::vector<Index>>(kBlocks));
  for (Index k = 0; k < places.times.size(); ++k) {
    const auto block =
        static_cast<std::size_t>(std::min<double>(kBlocks - 1, places.times[k] / step));
    rows[static_cast<std::size_t>(places.recordings[static_cast<std::size_t>(k)])][block].push_back(
        k);
  }
  const BlockSums blocks(system, columns, surrogates);
  std::vector<Running> parts;
  for (const auto& own : rows) parts.push_back(blocks.over(own));
  const Running all = together(parts);
  VectorXd largest = VectorXd::Zero(all.noise.front().cols());
  const auto look = [&](const Running& sums, int recording) {
    for (std::size_t from = 0; from < kBlocks; ++from) {
      const std::size_t last =
          ends ? std::min<std::size_t>(kBlocks,
                                       from + static_cast<std::size_t>(longest_push * kBlocks))
               : kBlocks;
      for (std::size_t to = ends ? from + 1 : kBlocks; to <= last; ++to) {
        if (!ends && (from == 0 || from + 3 > kBlocks)) continue;
        Score score = score_of(between(sums, from, to), surrogates);
        if (surrogates) largest = largest.cwiseMax(score.surrogates);
        if (scan.found && score.delta_chi2 <= scan.score.delta_chi2) continue;
        scan.score = std::move(score);
        scan.begin = static_cast<double>(from) * step;
        scan.end = static_cast<double>(to) * step;
        scan.recording = recording;
        best_from = from, best_to = to;
        scan.found = true;
      }
    }
  };
  look(all, -1);
  for (std::size_t p = 0; parts.size() > 1 && p < parts.size(); ++p) {
    look(parts[p], static_cast<int>(p));
  }
  if (scan.found) {
    const Running& own = scan.recording < 0 ? all : parts[static_cast<std::size_t>(scan.recording)];
    scan.elsewhere =
        squares_elsewhere(parts, scan.recording, {own, best_from, best_to}, system.rules());
  }
  // the same number of surrogates as everywhere: those that were not scanned repeat the others
  if (scan.found && largest.size() > 0) {
    VectorXd repeated(system.surrogates());
    for (Index i = 0; i < repeated.size(); ++i) repeated[i] = largest[i % largest.size()];
    scan.score.surrogates = repeated;
  }
  return scan;
}

bool is_jolt(const EvidenceSystem& system, const JointColumns& torque) {
  std::vector<double> gains;
  for (const int joint : torque.joints) {
    const VectorXd rest = system.rest(joint), own = system.left_of(torque, joint).col(0);
    for (Index k = 0; k < own.size(); ++k) {
      gains.push_back(own[k] * (2 * rest[k] - own[k]));  // r^2 - (r - e)^2
    }
  }
  double all = 0, of_few = 0;
  for (const double gain : gains) all += gain;
  const std::size_t few =
      std::min(static_cast<std::size_t>(system.rules().jolt_equations), gains.size());
  std::partial_sort(gains.begin(), gains.begin() + static_cast<std::ptrdiff_t>(few), gains.end(),
                    std::greater<>());
  for (std::size_t i = 0; i < few; ++i) of_few += gains[i];
  return 2 * of_few > all;
}

}  // namespace dyngen::runtime

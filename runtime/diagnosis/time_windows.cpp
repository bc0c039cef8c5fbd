// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/time_windows.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBlocks = 120;          // of the longest recording
constexpr double kLongestPush = 0.3;  // of the recording: what lasts longer is no window
constexpr int kWindowSurrogates = 16;

/// Time of each equation, s from the recording's first sample.
VectorXd equation_times(const EffectRecordings& data) {
  VectorXd times(data.equations());
  Index start = 0;
  for (const EffectRun& run : data.runs) {
    const Index first = first_sample(run.decimator);
    for (Index k = 0; k < run.rows.Y.rows(); ++k) {
      times[start + k] = run.time[first + k * run.decimator.factor];
    }
    start += run.rows.Y.rows();
  }
  return times;
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

}  // namespace

WindowScan scan_windows(const EffectRecordings& data, EffectSignals& signals,
                        const EvidenceSystem& system, const Hypothesis& hypothesis,
                        bool surrogates) {
  WindowScan scan;
  const VectorXd times = equation_times(data);
  const double longest = times.maxCoeff();
  const bool ends = hypothesis.shapes.size() > 1;
  VectorXd always(static_cast<Index>(hypothesis.shapes.size()));
  always[0] = -1;
  if (ends) always[1] = 2 * longest + 1;
  const JointColumns columns =
      hypothesis_columns(data, signals, system, hypothesis, with_shapes(hypothesis, always));
  const double step = longest / kBlocks;
  // rows of a recording are consecutive, so that each block is a few ranges
  std::vector<std::vector<Index>> rows(kBlocks);
  for (Index k = 0; k < times.size(); ++k) {
    rows[static_cast<std::size_t>(std::min<double>(kBlocks - 1, times[k] / step))].push_back(k);
  }
  Running sums;
  const Index k = columns.columns();
  sums.whole.push_back(MatrixXd::Zero(k, k));
  sums.rest.push_back(VectorXd::Zero(k));
  sums.noise.push_back(
      MatrixXd::Zero(k, surrogates ? std::min(kWindowSurrogates, system.surrogates()) : 0));
  sums.inner.push_back(MatrixXd::Zero(system.rank(), k));
  for (int b = 0; b < kBlocks; ++b) {
    MatrixXd whole = sums.whole.back(), noise = sums.noise.back(), inner = sums.inner.back();
    VectorXd rest = sums.rest.back();
    const std::vector<Index>& here = rows[static_cast<std::size_t>(b)];
    for (std::size_t first = 0; first < here.size();) {
      std::size_t last = first + 1;
      while (last < here.size() && here[last] == here[last - 1] + 1) ++last;
      const Index from = here[first], to = here[last - 1] + 1;
      const Products part = system.products(columns, from, to, surrogates);
      const MatrixXd absorbed = system.absorbed(columns, from, to);
      whole += part.whole;
      rest += part.rest;
      noise += part.noise.leftCols(noise.cols());
      inner += absorbed;
      first = last;
    }
    sums.whole.push_back(std::move(whole));
    sums.rest.push_back(std::move(rest));
    sums.noise.push_back(std::move(noise));
    sums.inner.push_back(std::move(inner));
  }
  VectorXd largest = VectorXd::Zero(sums.noise.front().cols());
  for (std::size_t from = 0; from < kBlocks; ++from) {
    const std::size_t last =
        ends ? std::min<std::size_t>(kBlocks,
                                     from + static_cast<std::size_t>(kLongestPush * kBlocks))
             : kBlocks;
    for (std::size_t to = ends ? from + 1 : kBlocks; to <= last; ++to) {
      if (!ends && (from == 0 || from + 3 > kBlocks)) continue;
      Score score = score_of(between(sums, from, to), surrogates);
      if (surrogates) largest = largest.cwiseMax(score.surrogates);
      if (scan.found && score.squares <= scan.score.squares) continue;
      scan.score = std::move(score);
      scan.begin = static_cast<double>(from) * step;
      scan.end = static_cast<double>(to) * step;
      scan.found = true;
    }
  }
  // the same number of surrogates as everywhere: those that were not scanned repeat the others
  if (scan.found && largest.size() > 0) {
    VectorXd all(system.surrogates());
    for (Index i = 0; i < all.size(); ++i) all[i] = largest[i % largest.size()];
    scan.score.surrogates = all;
  }
  return scan;
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/heldout_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnosis/answer/heldout_remarks.h"
#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kHeldoutBlocks = 10;

std::string unit_of(const std::vector<bool>& revolute, Index joint) {
  return revolute[static_cast<std::size_t>(joint)] ? "N m" : "N";
}

/// Whether a mean square is further above its expected value than a ratio of rms and chance tell.
bool above(double square, double expected, double ratio, double fitted, double heldout,
           double chance) {
  if (!(expected > 0) || !std::isfinite(square)) return false;
  const double excess = square / expected;
  return excess > ratio * ratio &&
         variance_ratio_tail(excess, std::max(heldout, 1.0), std::max(fitted, 1.0)) < chance;
}

constexpr const char* kWithoutReversals = " (without the samples near reversals)";

/// How far what is left of a joint's held-out data is above the noise; empty: not far enough.
std::string distance_from_noise(const HeldoutResidual& rms, const HeldoutKnowledge& known, Index j,
                                const AnswerRules& rules) {
  const double floor = rms.floor[j], after = rms.after[j];
  const double expected = 1 + std::max(known.predicted[j], 0.0);
  const auto exceeds = [&](double square, double noise, double ratio) {
    return above(square, noise * expected, ratio, known.fitted_worth[j], known.heldout_worth[j],
                 rules.heldout_chance);
  };
  if (exceeds(after * after, floor * floor, rules.heldout_far)) {
    return fmt::format("beside a noise of {:.4g}", floor);
  }
  if (!exceeds(known.equations[j], 1, rules.heldout_excess)) return {};
  return fmt::format("{:.1f} times the noise in its equations", std::sqrt(known.equations[j]));
}

/// What held-out data of a joint say against the findings.
std::vector<std::string> objections(const HeldoutResidual& rms, const HeldoutKnowledge& known,
                                    Index j, bool found_nothing, const std::string& unit,
                                    const AnswerRules& rules) {
  std::vector<std::string> reasons;
  const std::string far = distance_from_noise(rms, known, j, rules);
  if (!far.empty()) {
    reasons.push_back(fmt::format("{:.4g} {} of joint {}, {}{}", rms.after[j], unit, j + 1, far,
                                  kWithoutReversals));
  }
  const double certainly = student_interval(1 - 2 * rules.heldout_chance, kHeldoutBlocks - 1);
  if (!found_nothing && known.with[j] > (1 + rules.printed_part) * known.without[j] &&
      known.worse[j] > certainly) {
    reasons.push_back(fmt::format("{:.4g} {} of joint {}, {:.4g} without the findings{}",
                                  known.with[j], unit, j + 1, known.without[j],
                                  known.with_reversals ? "" : kWithoutReversals));
  }
  return reasons;
}

}  // namespace

VectorXd worsening(const EffectRecordings& heldout, const RunResiduals& before,
                   const RunResiduals& after) {
  VectorXd result = VectorXd::Zero(heldout.joints());
  for (int j = 0; j < heldout.joints(); ++j) {
    std::vector<double> first, second;  // squared residuals of all samples that count
    for (std::size_t run = 0; run < heldout.runs.size(); ++run) {
      const std::vector<bool> counted = counted_samples(heldout.runs[run], j);
      for (Index k = 0; k < before[run].rows(); ++k) {
        if (!counted[static_cast<std::size_t>(k)]) continue;
        first.push_back(before[run](k, j) * before[run](k, j));
        second.push_back(after[run](k, j) * after[run](k, j));
      }
    }
    const auto samples = static_cast<Index>(first.size());
    if (samples < 4 * kHeldoutBlocks) continue;
    const Eigen::Map<const VectorXd> without(first.data(), samples), with(second.data(), samples);
    VectorXd ratio(kHeldoutBlocks);
    for (Index b = 0; b < kHeldoutBlocks; ++b) {
      const Index begin = b * samples / kHeldoutBlocks, end = (b + 1) * samples / kHeldoutBlocks;
      ratio[b] = std::log(std::max(with.segment(begin, end - begin).sum(), 1e-300) /
                          std::max(without.segment(begin, end - begin).sum(), 1e-300));
    }
    const double mean = ratio.mean();
    const double deviation =
        std::sqrt((ratio.array() - mean).square().sum() / (kHeldoutBlocks - 1) / kHeldoutBlocks);
    if (mean > 0) result[j] = mean / std::max(deviation, 1e-12);
  }
  return result;
}

std::optional<Conclusion> contradicted(const HeldoutResidual& rms, const HeldoutKnowledge& known,
                                       bool found_nothing, const std::vector<bool>& revolute,
                                       const AnswerRules& rules) {
  std::vector<std::string> reasons;
  bool beyond = true;  // every joint's
  for (Index j = 0; j < rms.after.size(); ++j) {
    if (!known.masked.empty() && known.masked[static_cast<std::size_t>(j)]) continue;
    std::vector<std::string> own =
        objections(rms, known, j, found_nothing, unit_of(revolute, j), rules);
    if (own.empty()) continue;
    const bool extrapolated = known.predicted[j] > rules.open_parameters ||
                              (j < rms.visited.size() && rms.visited[j] < 1 - rules.printed_part);
    beyond = beyond && extrapolated;
    std::move(own.begin(), own.end(), std::back_inserter(reasons));
  }
  if (reasons.empty()) return std::nullopt;
  const std::string list = fmt::format("{}", fmt::join(reasons, "; "));
  if (found_nothing && beyond) {
    return Conclusion{
        Verdict::kInsufficientData,
        fmt::format("Nothing above the noise was found, but torque that was held out "
                    "is not predicted, where its motion goes beyond the fitted one or "
                    "parameters are open: {}.",
                    list)};
  }
  return Conclusion{Verdict::kNotExplained,
                    fmt::format("{}held-out torque is not predicted: {}.",
                                found_nothing ? "Nothing above the noise was found, but "
                                              : "Effects were found, but ",
                                list)};
}

}  // namespace dyngen::runtime

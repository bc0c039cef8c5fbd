// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/heldout_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// Whether held-out torque is further above the floor than chance and parameters tell.
bool far_above(double rms, double floor, double predicted, double fitted, double heldout,
               const AnswerRules& rules) {
  if (!(floor > 0) || !std::isfinite(rms)) return false;
  const double ratio = rms * rms / (floor * floor * (1 + std::max(predicted, 0.0)));
  if (ratio <= rules.heldout_excess * rules.heldout_excess) return false;
  return variance_ratio_tail(ratio, std::max(heldout, 1.0), std::max(fitted, 1.0)) <
         rules.heldout_chance;
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
  const double certainly = student_interval(1 - 2 * rules.heldout_chance, kHeldoutBlocks - 1);
  std::vector<std::string> reasons;
  bool beyond = true;  // every joint's
  for (Index j = 0; j < rms.after.size(); ++j) {
    const double floor = rms.floor[j], after = rms.after[j], before = rms.before[j];
    const bool worse =
        !found_nothing && after > (1 + rules.printed_part) * before && known.worse[j] > certainly;
    const bool far = far_above(after, floor, known.predicted[j], known.fitted_worth[j],
                               known.heldout_worth[j], rules);
    if (!worse && !far) continue;
    std::string reason = fmt::format("{:.4g} {} of joint {}", after, unit_of(revolute, j), j + 1);
    if (far) reason += fmt::format(" beside a noise of {:.4g}", floor);
    if (worse) reason += fmt::format(", {:.4g} without the findings", before);
    const bool extrapolated = known.predicted[j] > rules.open_parameters ||
                              (j < rms.visited.size() && rms.visited[j] < 1 - rules.printed_part);
    beyond = beyond && extrapolated;
    reasons.push_back(std::move(reason));
  }
  if (reasons.empty()) return std::nullopt;
  std::string list = fmt::format("{}", fmt::join(reasons, "; "));
  if (known.away_from_stiction) list += " (without the samples near stiction)";
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

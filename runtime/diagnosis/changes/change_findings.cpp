// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/change_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Mean temperature of a joint in the reference and after it; NaN where a recording has none.
std::pair<double, double> mean_temperatures(const EffectRecordings& all,
                                            const std::vector<bool>& later, int joint) {
  std::array<double, 2> sum{}, samples{};
  for (std::size_t run = 0; run < all.runs.size(); ++run) {
    const MatrixXd& temperature = all.runs[run].motion.temperature;
    if (temperature.size() == 0) return {kNotKnown, kNotKnown};
    const std::size_t side = later[run] ? 1 : 0;
    sum[side] += temperature.col(joint).sum();
    samples[side] += static_cast<double>(temperature.rows());
  }
  return {sum[0] / samples[0], sum[1] / samples[1]};
}

/// What warmth says of friction that changed; empty: nothing.
/// @param change  of friction at the usual speed: only its sign counts
/// @param same    K, temperatures that differ by less are one
std::string warmth_caveat(const std::pair<double, double>& temperatures, double change,
                          double same) {
  const auto [before, after] = temperatures;
  if (std::isnan(before)) {
    return change < 0 ? "a warmer arm has less friction too, and no column temp of both sides "
                        "tells that from wear"
                      : "a colder arm has more friction too, and no column temp of both sides "
                        "tells that from wear";
  }
  const double warmer = after - before;
  if (std::abs(warmer) < same || (warmer > 0) == (change > 0)) return {};
  return fmt::format(
      "the joint was {:.3g} degrees {} than in the reference ({:.1f} C after {:.1f} C), which "
      "changes friction in this way too: compare sessions of one temperature before it is called "
      "wear",
      std::abs(warmer), warmer > 0 ? "warmer" : "colder", after, before);
}

class ChangeWriter {
 public:
  ChangeWriter(const ChangeSystem& system, const ChangePosterior& posterior,
               const EffectRecordings& all, const std::vector<bool>& later, double probable)
      : system_(system),
        posterior_(posterior),
        all_(all),
        later_(later),
        probable_(probable),
        estimate_(system.estimate(posterior.best)) {}

  std::vector<Finding> run() {
    std::vector<Finding> findings;
    Index place = 0;
    for (std::size_t i = 0; i < posterior_.best.size(); ++i) {
      const ChangeForm& form = system_.forms()[posterior_.best[i]];
      const bool change = !system_.candidates()[form.candidate].both_sides;
      if (change && posterior_.probability_of_any(system_, form.candidate) >= probable_) {
        findings.push_back(finding(i, place));
      }
      place += form.mix.rows();
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
      return a.evidence.lambda > b.evidence.lambda;
    });
    return findings;
  }

 private:
  Finding finding(std::size_t member, Index first) const {
    const ChangeForm& form = system_.forms()[posterior_.best[member]];
    const ChangeCandidate& own = system_.candidates()[form.candidate];
    Finding finding;
    finding.effect = own.effect;
    finding.since_reference = true;
    finding.formula = own.formula;
    finding.probability = posterior_.probability(system_, form.candidate);
    finding.uncertain = finding.probability < probable_;
    finding.where.share = kNotKnown;
    finding.aliases = own.families;
    std::vector<std::string> elsewhere;
    for (const std::size_t other : posterior_.replacements(system_, form.candidate)) {
      const ChangeCandidate& candidate = system_.candidates()[other];
      if (candidate.families.front() == own.families.front()) {
        elsewhere.push_back(fmt::format("the same of {}", place_of(candidate)));
        continue;
      }
      for (const std::string& family : candidate.families) {
        if (std::find(finding.aliases.begin(), finding.aliases.end(), family) ==
            finding.aliases.end()) {
          finding.aliases.push_back(family);
        }
      }
    }
    finding.elsewhere = fmt::format("{}", fmt::join(elsewhere, ", "));
    finding.parameters = parameters(own, form, first, finding.effect);
    if (own.kind == ChangeCandidate::Kind::kFriction) {
      keep_changed(finding);
      const double change = change_at_usual_speed(finding);
      const std::string caveat = warmth_caveat(mean_temperatures(all_, later_, own.effect.joint),
                                               change, system_.rules().same_temperature);
      if (!caveat.empty()) finding.caveats.push_back(caveat);
    }
    ChangeSet without = posterior_.best;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(member));
    finding.evidence.lambda =
        std::max(0.0, system_.chi_square(posterior_.best) - system_.chi_square(without) -
                          static_cast<double>(form.count));
    finding.evidence.delta_bic =
        -2 * (system_.log_evidence(posterior_.best) - system_.log_evidence(without));
    finding.why = why(own, form, first, finding);
    return finding;
  }

  std::vector<EffectParameterFit> parameters(const ChangeCandidate& own, const ChangeForm& form,
                                             Index first, EffectInstance& effect) const {
    std::vector<EffectParameterFit> fits(static_cast<std::size_t>(effect.law.size()));
    for (int p = 0; p < effect.law.size(); ++p) {
      fits[static_cast<std::size_t>(p)].value = effect.parameters[p];
      fits[static_cast<std::size_t>(p)].held = true;
    }
    for (std::size_t i = 0; i < own.parameters.size(); ++i) {
      EffectParameterFit& fit = fits[static_cast<std::size_t>(own.parameters[i])];
      const Index at = first + static_cast<Index>(i);
      fit.held = !form.point && form.mix.row(static_cast<Index>(i)).isZero(0);
      fit.seen = estimate_.seen[static_cast<std::size_t>(at)];
      fit.value = fit.seen ? estimate_.values[at] : kNotKnown;
      fit.stddev = fit.seen ? estimate_.deviations[at] : 0;
      effect.parameters[own.parameters[i]] = fit.value;
    }
    return fits;
  }

  /// Friction that did not change is no parameter of the change.
  static void keep_changed(Finding& finding) {
    for (std::size_t p = finding.parameters.size(); p-- > 0;) {
      if (!finding.parameters[p].held) continue;
      const auto at = static_cast<std::ptrdiff_t>(p);
      std::vector<EffectParameter>& names = finding.effect.law.parameters;
      finding.formula = names[p].name == "Fc" ? "Fv*qd" : "Fc*sign(qd)";
      names.erase(names.begin() + at);
      finding.parameters.erase(finding.parameters.begin() + at);
    }
    VectorXd& values = finding.effect.parameters;
    values.resize(static_cast<Index>(finding.parameters.size()));
    for (Index p = 0; p < values.size(); ++p) {
      values[p] = finding.parameters[static_cast<std::size_t>(p)].value;
    }
  }

  /// N m or N at the rms of the speed in the later sessions.
  [[nodiscard]] double change_at_usual_speed(const Finding& finding) const {
    double squares = 0, samples = 0, change = 0;
    for (std::size_t run = 0; run < all_.runs.size(); ++run) {
      if (!later_[run]) continue;
      squares += all_.runs[run].motion.dq.col(finding.effect.joint).squaredNorm();
      samples += static_cast<double>(all_.runs[run].motion.samples());
    }
    const double speed = std::sqrt(squares / std::max(samples, 1.0));
    for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
      const bool viscous = finding.effect.law.parameters[p].name == "Fv";
      change += finding.parameters[p].value * (viscous ? speed : 1.0);
    }
    return change;
  }

  static std::string place_of(const ChangeCandidate& own) {
    if (own.kind == ChangeCandidate::Kind::kLoad) {
      return own.effect.joint < 0 ? "the last link"
                                  : fmt::format("the link of joint {}", own.effect.joint + 1);
    }
    return own.effect.joint < 0 ? "the whole robot" : fmt::format("joint {}", own.effect.joint + 1);
  }

  /// "friction_change of joint 2 since the reference: Fc 8.1 -> 6.2 N m (-23 %)".
  std::string why(const ChangeCandidate& own, const ChangeForm& form, Index first,
                  const Finding& finding) const {
    std::vector<std::string> numbers, hidden;
    for (std::size_t i = 0; i < own.parameters.size(); ++i) {
      const EffectParameter& law =
          own.effect.law.parameters[static_cast<std::size_t>(own.parameters[i])];
      const Index at = first + static_cast<Index>(i);
      if (!estimate_.seen[static_cast<std::size_t>(at)]) hidden.push_back(law.name);
      const bool changes = form.point || !form.mix.row(static_cast<Index>(i)).isZero(0);
      if (own.base[i] < 0 || !changes) continue;
      const double before = estimate_.reference[own.base[i]], by = estimate_.values[at];
      numbers.push_back(fmt::format("{} {:.4g} -> {:.4g} {} ({:+.0f} %)", law.name, before,
                                    before + by, law.unit, 100 * by / std::abs(before)));
    }
    std::string text =
        fmt::format("{} of {} since the reference", own.families.front(), place_of(own));
    if (own.kind == ChangeCandidate::Kind::kLoad) {
      const Index mass = first + kBodyParameters - 1;
      const bool seen = estimate_.seen[static_cast<std::size_t>(mass)];
      if (seen) text += estimate_.values[mass] < 0 ? ": a body was taken off" : ": a body came";
    }
    if (!numbers.empty()) text += ": " + fmt::format("{}", fmt::join(numbers, ", "));
    text += fmt::format("; it lowers chi-square by {:.0f}", finding.evidence.lambda);
    if (!hidden.empty()) {
      text += fmt::format("; no motion of these recordings shows {}", fmt::join(hidden, ", "));
    }
    if (!finding.elsewhere.empty()) {
      text += "; these data cannot separate it from " + finding.elsewhere;
    }
    for (const std::string& caveat : finding.caveats) text += "; " + caveat;
    return text;
  }

  const ChangeSystem& system_;
  const ChangePosterior& posterior_;
  const EffectRecordings& all_;
  const std::vector<bool>& later_;
  double probable_;
  ChangeEstimate estimate_;
};

}  // namespace

std::vector<Finding> change_findings(const ChangeSystem& system, const ChangePosterior& posterior,
                                     const EffectRecordings& all, const std::vector<bool>& later,
                                     double probable) {
  return ChangeWriter(system, posterior, all, later, probable).run();
}

}  // namespace dyngen::runtime

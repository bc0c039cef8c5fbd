// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/reference.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/names/naming.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostChanges = 3;
constexpr double kTheorem = 1e-6;  // part of an effect's chi-square that the model leaves

EffectRecordings together(const EffectRecordings& reference, const EffectRecordings& train) {
  EffectRecordings all = reference;
  all.runs.insert(all.runs.end(), train.runs.begin(), train.runs.end());
  return all;
}

/// Columns of the later recordings as columns of both.
JointColumns later(const JointColumns& columns, Index before) {
  JointColumns result{columns.joints, {}};
  for (const MatrixXd& part : columns.parts) {
    MatrixXd longer = MatrixXd::Zero(before + part.rows(), part.cols());
    longer.bottomRows(part.rows()) = part;
    result.parts.push_back(std::move(longer));
  }
  return result;
}

/// One effect of the later recordings.
struct Change {
  std::size_t hypothesis = 0;
  TrialScore trial;
  MatrixXd covariance;  // of its linear parameters
  double net = 0;
};

/// Beside both recordings, the effects that each of them has, and changes found before.
class Changes {
 public:
  Changes(const EffectRecordings& reference, const EffectRecordings& train,
          const std::vector<Hypothesis>& hypotheses, const CompetitionResult& result)
      : train_(train),
        hypotheses_(hypotheses),
        result_(result),
        all_(together(reference, train)),
        before_(reference.equations()),
        signals_(train),
        scales_(train),
        system_(make_system(reference)) {
    signals_.set_beta(result.fit.point.beta);
    signals_.set_tangent_beta(result.fit.point.beta);
  }

  /// The best of all, strongest first.
  std::vector<Change> ranked() {
    std::vector<Change> changes;
    for (const NamedResult& named : result_.first.named) {
      if (!(named.part_left < kTheorem) || named.typical.size() == 0) continue;
      const Hypothesis& hypothesis = hypotheses_[named.hypothesis];
      if (!hypothesis.shapes.empty()) continue;
      changes.push_back(change(named.hypothesis));
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.net > b.net; });
    return changes;
  }

  void add(const Change& change) {
    system_.add(system_.whitened(columns_of(hypotheses_[change.hypothesis])));
  }

 private:
  EvidenceSystem make_system(const EffectRecordings& reference) {
    EffectPoint point = result_.fit.point;
    point.initial.clear();
    RunResiduals residuals = residuals_of(reference, point);
    for (MatrixXd& rest : residuals_of(train_, point)) residuals.push_back(std::move(rest));
    EvidenceSystem::Options options;
    options.surrogates = 0;
    return {all_, residuals, result_.noise, options};
  }

  JointColumns columns_of(const Hypothesis& hypothesis) {
    std::vector<int> wanted;
    for (const int p : hypothesis.linear) wanted.push_back(1 + p);
    return later(effect_columns(train_, signals_, hypothesis.effect, wanted, hypothesis.held),
                 before_);
  }

  Change change(std::size_t place) {
    const Hypothesis& hypothesis = hypotheses_[place];
    Change change;
    change.hypothesis = place;
    const Products products = system_.products(system_.whitened(columns_of(hypothesis)), false);
    change.trial.score = score_of(products, false);
    change.trial.effect = hypothesis.effect;
    for (std::size_t i = 0; i < hypothesis.linear.size(); ++i) {
      change.trial.effect.parameters[hypothesis.linear[i]] =
          change.trial.score.coefficients[static_cast<Index>(i)];
    }
    change.covariance = products.left.completeOrthogonalDecomposition().pseudoInverse();
    change.net = change.trial.score.delta_chi2 - price_of(hypothesis, change.trial, result_.noise);
    return change;
  }

  const EffectRecordings& train_;
  const std::vector<Hypothesis>& hypotheses_;
  const CompetitionResult& result_;
  EffectRecordings all_;
  Index before_;
  EffectSignals signals_;
  ScaleTable scales_;
  EvidenceSystem system_;
};

Finding finding_of(const Change& change, const std::vector<Change>& ranked,
                   const std::vector<Hypothesis>& hypotheses) {
  const Hypothesis& hypothesis = hypotheses[change.hypothesis];
  Finding finding;
  finding.effect = change.trial.effect;
  finding.since_reference = true;
  finding.aliases = {hypothesis.effect.law.family};
  double rest = 0;
  for (const Change& other : ranked) {
    const std::string& family = hypotheses[other.hypothesis].effect.law.family;
    if (family == finding.aliases.front()) continue;
    const double distance = change.net - other.net;
    rest += std::exp(-std::clamp(distance, 0.0, 200.0) / 4);
    if (distance < kApart && std::find(finding.aliases.begin(), finding.aliases.end(), family) ==
                                 finding.aliases.end()) {
      finding.aliases.push_back(family);
    }
  }
  finding.probability = 1 / (1 + rest);
  finding.evidence.lambda =
      std::max(0.0, change.trial.score.delta_chi2 - change.trial.score.degrees);
  finding.evidence.delta_bic = -change.net;
  finding.parameters.resize(static_cast<std::size_t>(hypothesis.effect.law.size()));
  for (int p = 0; p < hypothesis.effect.law.size(); ++p) {
    EffectParameterFit& parameter = finding.parameters[static_cast<std::size_t>(p)];
    parameter.value = change.trial.effect.parameters[p];
    parameter.held = true;
  }
  for (std::size_t i = 0; i < hypothesis.linear.size(); ++i) {
    EffectParameterFit& parameter =
        finding.parameters[static_cast<std::size_t>(hypothesis.linear[i])];
    const auto place = static_cast<Index>(i);
    parameter.held = false;
    parameter.stddev = std::sqrt(std::max(0.0, change.covariance(place, place)));
  }
  finding.where.share = std::numeric_limits<double>::quiet_NaN();
  finding.why = fmt::format(
      "the parameters of the reference recordings do not fit the others: a change by {} lowers "
      "chi-square by {:.0f}",
      hypothesis.effect.law.family, finding.evidence.lambda);
  return finding;
}

}  // namespace

std::vector<Finding> changes_since(const EffectRecordings& reference, const EffectRecordings& train,
                                   const std::vector<Hypothesis>& hypotheses,
                                   const CompetitionResult& result, double false_alarm) {
  Changes changes(reference, train, hypotheses, result);
  std::vector<Finding> findings;
  for (int round = 0; round < kMostChanges; ++round) {
    const std::vector<Change> ranked = changes.ranked();
    if (ranked.empty()) break;
    const Change& best = ranked.front();
    const double surprise = surprise_of(best.trial.score.delta_chi2, best.trial.score.degrees);
    if (best.net <= 0 || static_cast<double>(ranked.size()) * std::exp(-surprise) > false_alarm) {
      break;
    }
    findings.push_back(finding_of(best, ranked, hypotheses));
    changes.add(best);
  }
  return findings;
}

}  // namespace dyngen::runtime

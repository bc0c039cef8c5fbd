// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/nameless_proof.h"

#include <algorithm>
#include <vector>

#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {

using Eigen::VectorXd;

namespace {

using Form = GenericStructure::Form;

/// Equations of a joint that count.
double counted_of(const EffectRecordings& data, int joint) {
  double sum = 0;
  for (const EffectRun& run : data.runs) sum += run.rows.counted.col(joint).sum();
  return sum;
}

/// A sinusoid that goes on by itself has a phase of its own in held-out recordings too: its
/// chi-square there is as much as it has in as many fitted equations. By Akaike (1974) its cosine
/// and sine of each run cost twice their number.
HeldoutProof line_proof(const CompetitionData& data, const Nameless& nameless,
                        const Products& products) {
  const int joint = nameless.structure.joint;
  const Score there = score_of(products, false);
  HeldoutProof proof;
  const double part =
      counted_of(data.heldout, joint) / std::max(1.0, counted_of(data.evidence, joint));
  proof.change = std::max(0.0, nameless.score.delta_chi2 - nameless.score.degrees) * part;
  proof.before = there.delta_chi2;
  proof.after = 2.0 * there.degrees;
  return proof;
}

}  // namespace

bool is_provable(const Nameless& nameless) {
  if (nameless.ruled_out) return nameless.ruled_out->recording < 0;
  const GenericStructure& structure = nameless.structure;
  if (structure.form == Form::kWave || structure.form == Form::kLine) return true;
  if (!is_function(structure)) return false;
  return std::none_of(structure.variables.begin(), structure.variables.end(),
                      [](const StructureVariable& variable) {
                        return variable.kind == StructureVariable::Kind::kTime;
                      });
}

HeldoutProof nameless_proof(const CompetitionData& data, const std::vector<Hypothesis>& hypotheses,
                            const CompetitionResult& result, const TorqueNoiseModel& noise,
                            const Nameless& nameless, EvidenceSystem::Options options) {
  options.surrogates = 0;
  EffectPoint point = result.fit.point;
  point.initial.clear();
  EffectSignals own(data.heldout);
  const EvidenceSystem system =
      system_beside(data.heldout, own, hypotheses, result, point, noise, options);
  const auto products = [&](const JointColumns& columns) {
    return system.products(system.whitened(columns), false);
  };
  if (!nameless.ruled_out && nameless.structure.form == Form::kLine) {
    return line_proof(data, nameless, products(nameless_columns(data.heldout, own, nameless)));
  }
  const Products there =
      nameless.ruled_out ? products(nameless_columns(data.heldout, own, nameless))
                         : products(generic_columns(
                               data.heldout, own, nameless.structure,
                               structure_knots(data.evidence, data.signals, nameless.structure)));
  const VectorXd& size = nameless.score.coefficients;
  HeldoutProof proof;
  proof.change = size.dot(there.left * size);
  proof.before = 2 * size.dot(there.rest);  // more than what it does not change
  proof.after = proof.change;
  proof.parameters = nameless.score.degrees;
  proof.fitted = nameless.score.delta_chi2;
  return proof;
}

bool is_supported(const HeldoutProof& proof, bool beyond_doubt) {
  if (!beyond_doubt) return proof.informs() && proof.helps();
  return !proof.informs() || proof.agrees() || proof.helps();
}

}  // namespace dyngen::runtime

// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/nameless_proof.h"

#include <algorithm>

#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {

using Eigen::VectorXd;

bool is_provable(const Nameless& nameless) {
  const GenericStructure& structure = nameless.structure;
  if (nameless.ruled_out) return false;
  if (structure.form == GenericStructure::Form::kWave) return true;
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
  const StructureKnots knots = structure_knots(data.evidence, data.signals, nameless.structure);
  const Products products = system.products(
      system.whitened(generic_columns(data.heldout, own, nameless.structure, knots)), false);
  const VectorXd& size = nameless.score.coefficients;
  HeldoutProof proof;
  proof.change = size.dot(products.left * size);
  proof.before = 2 * size.dot(products.rest);  // more than what it does not change
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

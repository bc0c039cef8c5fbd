// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/nameless_proof.h"

#include <algorithm>
#include <vector>

#include "runtime/diagnosis/equation_sets/sufficiency.h"
#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {

using Eigen::VectorXd;

namespace {

using Form = GenericStructure::Form;

/// A sinusoid that goes on by itself has a phase of its own in held-out recordings too: its
/// chi-square there is as much as it has in as many fitted equations. By Akaike (1974) its cosine
/// and sine of each run cost twice their number.
HeldoutProof line_proof(const ProofData& data, const Nameless& nameless, const Products& products) {
  const int joint = nameless.structure.joint;
  const Score there = score_of(products, false);
  HeldoutProof proof;
  const double part = equations_of_joint(data.heldout, joint) /
                      std::max(1.0, equations_of_joint(data.evidence, joint));
  proof.change = std::max(0.0, nameless.score.delta_chi2 - nameless.score.degrees) * part;
  proof.before = there.delta_chi2;
  proof.after = 2.0 * there.degrees;
  return proof;
}

/// The model and what was found, on the held-out recordings.
EvidenceSystem heldout_system(const ProofData& data, EffectSignals& signals,
                              const std::vector<Hypothesis>& hypotheses,
                              const CompetitionResult& result, const TorqueNoiseModel& noise,
                              EvidenceSystem::Options options) {
  options.surrogates = 0;
  EffectPoint point = result.fit.point;
  point.initial.clear();
  return system_beside(data.heldout, signals, hypotheses, result, point, noise, options);
}

/// @param size  of the columns
HeldoutProof proof_of_size(const Products& products, const VectorXd& size) {
  HeldoutProof proof;
  proof.change = size.dot(products.left * size);
  proof.before = 2 * size.dot(products.rest);  // more than what it does not change
  proof.after = proof.change;
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

HeldoutProof nameless_proof(const ProofData& data, const std::vector<Hypothesis>& hypotheses,
                            const CompetitionResult& result, const TorqueNoiseModel& noise,
                            const Nameless& nameless, EvidenceSystem::Options options) {
  EffectSignals own(data.heldout);
  const EvidenceSystem system = heldout_system(data, own, hypotheses, result, noise, options);
  const bool is_line = !nameless.ruled_out && nameless.structure.form == Form::kLine;
  const JointColumns columns =
      nameless.ruled_out || is_line
          ? nameless_columns(data.heldout, own, nameless)
          : generic_columns(data.heldout, own, nameless.structure,
                            structure_knots(data.evidence, data.signals, nameless.structure));
  const Products products = system.products(system.whitened(columns), false);
  if (is_line) return line_proof(data, nameless, products);
  HeldoutProof proof = proof_of_size(products, nameless.score.coefficients);
  proof.parameters = nameless.score.degrees;
  proof.fitted = nameless.score.delta_chi2;
  return proof;
}

HeldoutProof effect_proof(const ProofData& data, const std::vector<Hypothesis>& hypotheses,
                          const CompetitionResult& result, const TorqueNoiseModel& noise,
                          const EffectInstance& effect, EvidenceSystem::Options options) {
  EffectSignals own(data.heldout);
  const EvidenceSystem system = heldout_system(data, own, hypotheses, result, noise, options);
  const JointColumns torque = effect_columns(data.heldout, own, effect, {0});
  return proof_of_size(system.products(system.whitened(torque), false), VectorXd::Ones(1));
}

bool is_supported(const HeldoutProof& proof, bool beyond_doubt) {
  if (!beyond_doubt) return proof.informs() && proof.helps();
  return !proof.informs() || proof.agrees() || proof.helps();
}

}  // namespace dyngen::runtime
